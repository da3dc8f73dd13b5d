"""A law that no catalogue holds, in the record of one slider: found, written, added, and the error told comes again."""

from pathlib import Path

import numpy as np
import pytest

import slipwise as sw
from slipwise.campaign import load_campaign
from slipwise.discovery.discover import discover

pytestmark = pytest.mark.slow
PLACE, WIDTH, SIZE = 15e3, 3e3, 0.3


def written(folder: Path, seed: int, size: float = SIZE) -> Path:
    """Write a campaign of a slider whose coefficient falls and rises again where the load is about 15 kN."""
    folder.mkdir(exist_ok=True)
    rng = np.random.default_rng(seed)
    runs = []
    for number in range(3):
        time = np.arange(1500) * 0.02
        sweep = np.abs(2.0 * np.mod(time / (11.0 + 3.0 * number) + 0.2 * number, 1.0) - 1.0)
        load = 5e3 + 20e3 * sweep
        speed = 0.02 * (1.0 + 0.5 * np.sin(2 * np.pi * time / (5.0 + number)))
        slip = np.cumsum(speed) * 0.02
        coefficient = 0.1 * (1.0 - size * np.exp(-(((load - PLACE) / WIDTH) ** 2)))
        force = coefficient * load * (1.0 + 0.002 * rng.standard_normal(len(time)))
        rows = np.stack([time, 1e3 * slip, 1e-3 * load, 1e-3 * force], axis=1)
        name = f"run{number}.csv"
        np.savetxt(folder / name, rows, delimiter=",", header="time,slip,load,force", comments="", fmt="%.6f")
        runs.append(f'[[run]]\nfile = "{name}"\nrole = "{"fit" if number < 2 else "holdout"}"\n')
    channels = {"time": ("time", "s"), "slip": ("slip_x", "mm"), "load": ("pad_A_N", "kN"), "force": ("pad_A_Fx", "kN")}
    columns = "".join(f'{c} = {{ channel = "{n}", unit = "{u}" }}\n' for c, (n, u) in channels.items())
    (folder / "campaign.toml").write_text(f'name = "made"\nrig = "pad"\n[columns]\n{columns}{"".join(runs)}')
    return folder


@pytest.mark.long
def test_a_dip_of_the_coefficient_over_the_load_is_found_written_and_added(tmp_path: Path) -> None:
    campaign = load_campaign(written(tmp_path, 351))
    found = discover(campaign)
    assert found.evidence in ("law", "state") and found.laws[0].states == ("load",)
    before, after = found.relations["pads"]
    assert before > 2.0 > 1.25 > after
    law = found.laws[0]
    assert len(law.alternatives) == len([*law.tied_forms, *law.rivals])
    (file,) = found.written(tmp_path / "out", "dip", "2026-11-27").files[:1]
    model = found.base.model
    for name in found.beside:
        model = sw.add(name, campaign, model).model
    (row,) = sw.add(str(file), campaign, model).rows()
    assert row["after"] == pytest.approx(after, rel=0.05)
    assert [listed.name for listed in sw.list_laws(tmp_path).laws] == []  # no answer was written beside it
    other = sw.diagnose(written(tmp_path / "other", 352, 0.5 * SIZE), law=False)
    (test,) = sw.hold_laws_against(other, [sw.effects.find_effect(str(file))]).tests
    assert test.holds == "with another size" and test.low < 0.5 < test.high
