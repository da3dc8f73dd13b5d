"""Motions in workbooks, MATLAB and Parquet files: read as tables of a campaign; damaged ones are refused in words."""

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from scipy.io import savemat

from slipwise.errors import InputError, SlipwiseError, UnitError
from slipwise.motion import load_motion
from unit.motion.samples import wave

TIME = 0.01 * np.arange(80)
THREE = np.stack([wave(80), 0.6 * wave(80, phase=1.0), 0.3 * wave(80, phase=2.0)], axis=1) / 100


def workbook(path, rows):
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    for row in rows:
        book.active.append([value.item() if isinstance(value, np.generic) else value for value in row])
    book.save(path)
    return path


ROWS = [[t, *row] for t, row in zip(TIME, THREE, strict=True)]


@pytest.mark.parametrize(
    "head",
    [
        [["Time (s)", "EW (m/s^2)", "NS (m/s^2)", "UD (m/s^2)"]],
        [["time", "ax", "ay", "az"], ["s", "m/s^2", "m/s^2", "m/s^2"]],
        [["Shaking table test 7"], ["Acceleration in m/s^2"], [], ["time", "x", "y", "z"]],
        [["Sampling rate", "100 Hz"], ["Time [s]", "acc_x [m/s²]", "acc_y [m/s²]", "acc_z [m/s²]"]],
        [["t", "EW m/s2", "NS m/s2", "UD m/s2"]],
    ],
)
def test_a_workbook_is_a_motion(tmp_path, head):
    motion = load_motion(workbook(tmp_path / "m.xlsx", [*head, *ROWS]))
    assert motion.dt == pytest.approx(0.01)
    np.testing.assert_allclose(motion.acceleration, THREE, rtol=1e-12)


def test_a_motion_tells_which_rows_below_the_table_of_its_workbook_are_left_out(tmp_path):
    rows = [["time (s)", "EW (g)"], *[r[:2] for r in ROWS], [], ["Peak", 0.1]]
    motion = load_motion(workbook(tmp_path / "m.xlsx", rows))
    assert len(motion) == len(ROWS)
    assert any("1 line below the table is left out, beginning 'Peak 0.1'" in words for words in motion.treatment)


def test_what_a_workbook_states_binds(tmp_path):
    path = workbook(tmp_path / "m.xlsx", [["Sampling rate: 50 Hz"], ["time (s)", "EW (g)"], *[r[:2] for r in ROWS]])
    with pytest.raises(InputError, match=r"the header states a step of 0\.02 s, its time column 0\.01 s"):
        load_motion(path)
    path = workbook(tmp_path / "n.xlsx", [["time (s)", "EW (g)"], *[r[:2] for r in ROWS]])
    with pytest.raises(UnitError, match="states 'g' as its unit, 'gal' was given"):
        load_motion(path, unit="gal")


@pytest.mark.parametrize(
    ("variables", "settings"),
    [
        ({"time": TIME, "acc": THREE[:, 0]}, {"unit": "m/s^2"}),
        ({"t": TIME, "acc_g": THREE[:, 0] / 9.80665}, {}),
        ({"acc": THREE[:, 0]}, {"unit": "m/s^2", "dt": "0.01 s"}),
        ({"data": np.stack([TIME, THREE[:, 0]], axis=1)}, {"unit": "m/s^2", "dt": "0.01 s"}),
        ({"acc": THREE[:, 0], "dt": 0.01}, {"unit": "m/s^2"}),
        ({"rec": {"time": TIME, "ax": THREE[:, 0]}}, {"unit": "m/s^2"}),
        ({"time": TIME, "EW": THREE[:, 0], "gains": np.arange(3.0)}, {"unit": "m/s^2"}),
    ],
)
def test_a_matlab_file_is_a_motion(tmp_path, variables, settings):
    savemat(tmp_path / "m.mat", variables)
    motion = load_motion(tmp_path / "m.mat", **settings)
    assert motion.dt == pytest.approx(0.01)
    np.testing.assert_allclose(motion.acceleration[:, 0], THREE[:, 0], rtol=1e-9)


def test_a_parquet_file_is_a_motion(tmp_path):
    table = pa.table({"time [s]": TIME, "table_ax [m/s^2]": THREE[:, 0], "note": ["x"] * len(TIME)})
    pq.write_table(table, tmp_path / "m.parquet")
    motion = load_motion(tmp_path / "m.parquet")
    np.testing.assert_allclose(motion.acceleration[:, 0], THREE[:, 0])
    assert "left out, for they are shorter or hold no numbers: note" in " ".join(motion.treatment)


def test_damaged_data_files_are_refused_in_one_sentence(tmp_path):
    book = workbook(tmp_path / "m.xlsx", [["time (s)", "EW (g)"], *[r[:2] for r in ROWS]])
    (tmp_path / "cut.xlsx").write_bytes(book.read_bytes()[:2000])
    savemat(tmp_path / "m.mat", {"time": TIME, "acc_g": THREE[:, 0]})
    (tmp_path / "cut.mat").write_bytes((tmp_path / "m.mat").read_bytes()[:700])
    doubled = [["time (s)", "EW (g)"], *[r[:2] for r in ROWS], *[r[:2] for r in ROWS]]
    workbook(tmp_path / "doubled.xlsx", doubled)
    hole = [list(r[:2]) for r in ROWS]
    hole[30][1] = None
    workbook(tmp_path / "hole.xlsx", [["time (s)", "EW (g)"], *hole])
    for name, words in (
        ("cut.xlsx", "not a readable workbook"),
        ("cut.mat", "not a readable MATLAB file"),
        ("doubled.xlsx", "row 81: the time runs backwards"),
        ("hole.xlsx", "row 31: the value nan is missing"),
    ):
        with pytest.raises(SlipwiseError, match=words):
            load_motion(tmp_path / name)


def test_of_a_measured_run_the_tables_channels_are_the_motion_in_any_file(tmp_path):
    columns = {"time [s]": TIME, "table_ax [m/s^2]": THREE[:, 0], "girder_ax [m/s^2]": THREE[:, 1], "slip_x [mm]": TIME}
    pq.write_table(pa.table(columns), tmp_path / "run.parquet")
    (tmp_path / "run.csv").write_text(
        ",".join(columns)
        + "\n"
        + "".join(",".join(f"{v:.17g}" for v in row) + "\n" for row in zip(*columns.values(), strict=True))
    )
    for name in ("run.parquet", "run.csv"):
        motion = load_motion(tmp_path / name)
        np.testing.assert_allclose(motion.acceleration[:, 0], THREE[:, 0])
        assert motion.components == ("table_ax", "", "")
