"""Friction that was recorded as a coefficient becomes a force."""

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.errors import InputError

HEADER = "time [s],slip_x [mm],mu,P [MPa]"
COLUMNS = '[columns]\n"mu" = { channel = "pad_A_Fx", unit = "UNIT" }\n'
PRESSURE = '"P [MPa]" = { channel = "pad_A_P", unit = "MPa" }\n'


def written(folder, columns: str, more: str = "") -> None:
    rows = "\n".join(f"{0.01 * i:g},{0.1 * i:g},{0.1 + 0.001 * i:g},{2.0 + 0.01 * i:g}" for i in range(40))
    (folder / "run.csv").write_text(f"{HEADER}\n{rows}\n")
    (folder / "campaign.toml").write_text(
        f'rig = "pad"\n[specimen]\npad_radius = "20 mm"\n{more}{columns}[[run]]\nfile = "run.csv"\nrole = "fit"\n'
    )


@pytest.mark.parametrize(("unit", "factor"), [("1", 1.0), ("%", 0.01), ("", 1.0)])
def test_a_coefficient_is_multiplied_by_pressure_and_area(tmp_path, unit, factor):
    written(tmp_path, COLUMNS.replace("UNIT", unit) + PRESSURE)
    record = load_campaign(tmp_path).runs[0].record
    i = np.arange(40)
    expected = factor * (0.1 + 0.001 * i) * (2.0 + 0.01 * i) * 1e6 * np.pi * 0.02**2
    np.testing.assert_allclose(record["pad_A_Fx"], expected, rtol=1e-9)


def test_a_coefficient_is_multiplied_by_a_load_that_is_a_constant(tmp_path):
    written(tmp_path, COLUMNS.replace("UNIT", "1"), '[constants]\npad_A_N = "10 kN"\n')
    record = load_campaign(tmp_path).runs[0].record
    np.testing.assert_allclose(record["pad_A_Fx"], 10e3 * (0.1 + 0.001 * np.arange(40)))


def test_a_coefficient_without_a_load_says_what_to_give(tmp_path):
    written(tmp_path, COLUMNS.replace("UNIT", "1"))
    with pytest.raises(InputError, match="give pad_A_N or pad_A_P") as caught:
        load_campaign(tmp_path)
    assert "run.csv" in str(caught.value)
