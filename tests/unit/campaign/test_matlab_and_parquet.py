"""MATLAB files and Parquet files as tables; what cannot be read names the cure."""

import builtins
import struct

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from scipy.io import savemat

from slipwise.campaign import load_campaign
from slipwise.data_files.matlab_file import read_matlab
from slipwise.data_files.table import open_table
from slipwise.errors import InputError

TIME = 0.01 * np.arange(50)
SLIP = np.sin(TIME)


def test_vectors_matrices_and_structures_of_matlab_become_columns(tmp_path):
    path = tmp_path / "run.mat"
    savemat(path, {"t": TIME[:, None], "data": np.stack([SLIP, 2 * SLIP], axis=1), "rig": {"force": SLIP}, "n": 3.0})
    columns = read_matlab(path).columns
    assert set(columns) == {"t", "data(:,1)", "data(:,2)", "rig.force"}
    assert columns["data(:,2)"] == pytest.approx(2 * SLIP)


def test_a_campaign_of_matlab_files_is_read_through_columns(campaign):
    folder = campaign(
        '[columns]\n"t" = {channel = "time", unit = "ms"}\n"data(:,1)" = {channel = "slip_x", unit = "cm"}\n'
        '"data(:,2)" = {channel = "pad_A_Fx", unit = "N", sign = -1}\n[constants]\npad_A_N = "1 kN"',
        runs='[[run]]\nfile = "run.mat"\nrole = "fit"\n',
    )
    savemat(folder / "run.mat", {"t": 1e3 * TIME, "data": np.stack([SLIP, 5 * SLIP], axis=1)})
    record = load_campaign(folder).runs[0].record
    assert record.time == pytest.approx(TIME)
    assert record["slip_x"] == pytest.approx(0.01 * SLIP)
    assert record["pad_A_Fx"] == pytest.approx(-5 * SLIP)
    assert record["pad_A_N"] == pytest.approx(1000.0)


def version_7_3(path):
    """Write the 128 bytes by which MATLAB marks a file of version 7.3."""
    path.write_bytes(b"MATLAB 7.3 MAT-file".ljust(116) + bytes(8) + struct.pack("<H", 0x0200) + b"IM" + bytes(512))


def test_version_7_3_without_its_extra_names_the_extra(tmp_path, monkeypatch):
    version_7_3(tmp_path / "run.mat")
    real = builtins.__import__

    def without(name, *rest, **more):
        if name == "h5py":
            raise ModuleNotFoundError(name)
        return real(name, *rest, **more)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(InputError, match=r"pip install 'slipwise\[matlab73\]'"):
        read_matlab(tmp_path / "run.mat")


def test_version_7_3_is_read_with_its_extra(tmp_path):
    h5py = pytest.importorskip("h5py", reason="h5py is not installed: MATLAB 7.3 is not read")
    path = tmp_path / "run.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        file["t"] = TIME[None, :]
        file["rig/force"] = SLIP[None, :]
    header = tmp_path / "header"
    version_7_3(header)
    with path.open("r+b") as stream:
        stream.write(header.read_bytes()[:128])
    assert read_matlab(path).columns["rig.force"] == pytest.approx(SLIP)


@pytest.mark.parametrize(
    ("content", "message"), [({"word": "hello", "n": 1.0}, "no vector or matrix"), (None, "not a readable MATLAB file")]
)
def test_a_matlab_file_without_numbers_is_refused(tmp_path, content, message):
    path = tmp_path / "run.mat"
    path.write_bytes(b"no such thing " * 40)
    if content is not None:
        savemat(path, content)
    with pytest.raises(InputError, match=message):
        read_matlab(path)


def test_parquet_keeps_its_unit_beside_the_column(tmp_path):
    path = tmp_path / "run.parquet"
    fields = [pa.field("time", pa.float64(), metadata={"unit": "s"}), pa.field("slip_x [mm]", pa.float32())]
    pq.write_table(pa.table([TIME, SLIP.astype(np.float32)], schema=pa.schema(fields)), path)
    table = open_table(path)
    assert table.headers == ("time [s]", "slip_x [mm]")
    assert table.columns([1]).values[0] == pytest.approx(SLIP, abs=1e-6)


def test_a_parquet_column_of_words_is_no_channel(tmp_path):
    path = tmp_path / "run.parquet"
    pq.write_table(pa.table({"time [s]": ["a", "b"]}), path)
    with pytest.raises(InputError, match="holds string, not numbers"):
        open_table(path).columns([0])


@pytest.mark.parametrize(
    ("name", "message"),
    [("run.docx", "no format of a data file; possible: .csv"), ("run.parquet", "not a readable parquet file")],
)
def test_a_format_that_cannot_be_read_says_which_ones_can(tmp_path, name, message):
    (tmp_path / name).write_bytes(b"PK\x03\x04 nothing")
    with pytest.raises(InputError, match=message):
        open_table(tmp_path / name)


@pytest.mark.parametrize("kind", ["xlsx", "parquet"])
def test_a_packed_file_that_is_damaged_anywhere_is_refused_in_words(tmp_path, kind):
    path = tmp_path / f"a.{kind}"
    values = np.random.default_rng(1).standard_normal(300)
    if kind == "parquet":
        pq.write_table(pa.table({"time [s]": 0.01 * np.arange(300), "slip_x [mm]": values}), path)
    else:
        book = pytest.importorskip("openpyxl").Workbook()
        for row in [["time [s]", "slip_x [mm]"], *zip(0.01 * np.arange(300), values, strict=True)]:
            book.active.append([cell if isinstance(cell, str) else float(cell) for cell in row])
        book.save(path)
    whole = path.read_bytes()
    refused = 0
    for at in range(20, len(whole), len(whole) // 60):
        path.write_bytes(whole[:at] + b"\xff\x00\xfe" + whole[at + 3 :])
        try:
            open_table(path).columns([0, 1])
        except InputError as error:
            assert "a." in str(error)
            refused += 1
    assert refused > 5


def test_a_parquet_column_that_stands_twice_is_refused(tmp_path):
    columns = [pa.array([0.0, 1.0]), pa.array([1.0, 2.0])]
    pq.write_table(pa.table(columns, names=["time [s]", "time [s]"]), tmp_path / "a.parquet")
    with pytest.raises(InputError, match=r"'time \[s\]' stands there twice"):
        open_table(tmp_path / "a.parquet").columns([0])
