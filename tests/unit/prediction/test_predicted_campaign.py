"""A prediction is read as the campaign was, driven by the measured table, in the noise of the campaign's gauges."""

from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import load_campaign
from slipwise.errors import InputError
from slipwise.prediction.predicted_campaign import load_predicted

TIME = np.arange(0.0, 8.0, 0.004)
SHAPE = np.clip(TIME - 1.0, 0.0, 1.0) * np.sin(9.0 * TIME)
LOADS = {f"pad_{pad}_N": 24.5 + 1.0 * SHAPE for pad in "ABCD"}
FORCES = {f"pad_{pad}_Fx": 2.4 * np.sign(np.gradient(SHAPE)) * (TIME > 1.0) for pad in "ABCD"}
RUNS = '[[run]]\nfile = "one.csv"\nrole = "fit"\n[[run]]\nfile = "again.csv"\nrole = "repeat"\n'
TOML = f'name = "test"\nrig = "bridge1"\n[logger]\nlowpass = "100 Hz"\n{RUNS}'


def write(path: Path, channels: dict, units: dict, seed: int | None = None) -> None:
    rng = np.random.default_rng(seed)
    noise = {"m/s^2": 0.02, "mm": 0.02, "kN": 0.03}
    columns = {"time [s]": TIME}
    for name, values in channels.items():
        of = units[name.split("_")[0]]
        columns[f"{name} [{of}]"] = values + (noise[of] * rng.standard_normal(len(TIME)) if seed is not None else 0.0)
    rows = "\n".join(",".join(f"{x:.9g}" for x in row) for row in np.stack(list(columns.values()), axis=1))
    path.parent.mkdir(exist_ok=True)
    path.write_text(",".join(columns) + "\n" + rows + "\n")


UNITS = {"table": "m/s^2", "girder": "m/s^2", "slip": "mm", "pad": "kN"}
RIG = {"slip_x": 12.0 * SHAPE, **LOADS, **FORCES}


@pytest.fixture
def measured(tmp_path):
    folder = tmp_path / "measured"
    every = {"table_ax": 3.0 * SHAPE, "girder_ax": 2.0 * SHAPE, **RIG}
    write(folder / "one.csv", every, UNITS, 1)
    write(folder / "again.csv", every, UNITS, 2)
    (folder / "campaign.toml").write_text(TOML)
    return load_campaign(folder)


def test_the_table_is_that_of_the_measured_run_and_a_repeat_is_predicted_once(measured, tmp_path):
    write(tmp_path / "office" / "one.csv", RIG, UNITS)
    given = load_predicted(tmp_path / "office", measured)
    assert [run.name for run in given.exact.runs] == ["one"]
    record = given.exact.runs[0].record
    assert record["table_ax"] == pytest.approx(measured.run("one").record["table_ax"])
    assert any("table_ax" in note and "drove it" in note for note in given.notes)
    assert any("girder_ax is not in the prediction" in note for note in given.notes)
    assert given.exact.known == {}


def test_the_noise_of_the_campaigns_gauges_is_added(measured, tmp_path):
    write(tmp_path / "office" / "one.csv", RIG, UNITS)
    given = load_predicted(tmp_path / "office", measured)
    for channel in ("slip_x", "pad_A_N"):
        added = given.recorded.runs[0].record[channel] - given.exact.runs[0].record[channel]
        assert added.std() == pytest.approx(measured.gauges[channel].level, rel=0.1)


def test_recorders_of_a_run_in_a_folder_are_mapped_by_a_campaign_file_of_their_own(measured, tmp_path):
    run = tmp_path / "office" / "one"
    run.mkdir(parents=True)
    np.savetxt(run / "slip.out", np.stack([TIME, 0.012 * SHAPE], axis=1))
    np.savetxt(run / "pads.out", np.stack([TIME, *(1e3 * v for v in (*LOADS.values(), *FORCES.values()))], axis=1))
    names = [
        '"slip: column 1" = { channel = "time", unit = "s" }',
        '"slip: column 2" = { channel = "slip_x", unit = "m" }',
    ]
    for k, channel in enumerate((*LOADS, *FORCES), 2):
        names.append(f'"pads: column {k}" = {{ channel = "{channel}", unit = "N" }}')
    lines = ['rig = "bridge1"', "[columns]", *names]
    (run.parent / "campaign.toml").write_text("\n".join(lines))
    record = load_predicted(run.parent, measured).exact.runs[0].record
    assert record["slip_x"] == pytest.approx(0.012 * SHAPE, abs=1e-9)
    assert record["pad_C_N"] == pytest.approx(1e3 * LOADS["pad_C_N"])


def test_a_folder_in_which_no_run_is_predicted_is_refused_with_the_names_it_needs(measured, tmp_path):
    write(tmp_path / "office" / "other.csv", RIG, UNITS)
    with pytest.raises(InputError, match=r"other.csv.*needs files named one"):
        load_predicted(tmp_path / "office", measured)
    with pytest.raises(InputError, match="no such folder"):
        load_predicted(tmp_path / "nowhere", measured)
