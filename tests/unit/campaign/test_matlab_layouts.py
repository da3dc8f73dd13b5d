"""MATLAB as people save it: cells, arrays of structures, Simulink's structures, channels in rows; hostile files."""

import struct
import zlib

import numpy as np
import pytest
from scipy.io import savemat

from slipwise.data_files.table import open_table
from slipwise.errors import InputError

TIME = 0.01 * np.arange(300)
SLIP = np.sin(TIME)


def read(tmp_path, **variables):
    savemat(tmp_path / "run.mat", variables, do_compression=True)
    table = open_table(tmp_path / "run.mat")
    return dict(zip(table.headers, table.columns(range(len(table.headers))).values, strict=True))


def test_cells_and_arrays_of_structures_are_numbered(tmp_path):
    cell = np.empty(2, dtype=object)
    cell[:] = [TIME, SLIP]
    channels = np.array([(TIME,), (SLIP,)], dtype=[("data", object)])
    found = read(tmp_path, c=cell, ch=channels)
    np.testing.assert_allclose(found["c{2}"], SLIP)
    np.testing.assert_allclose(found["ch(2).data"], SLIP)


def test_simulinks_structure_with_time(tmp_path):
    found = read(tmp_path, out={"time": TIME, "signals": {"values": np.stack([SLIP, -SLIP], axis=1), "label": "x"}})
    np.testing.assert_allclose(found["out.time"], TIME)
    np.testing.assert_allclose(found["out.signals.values(:,2)"], -SLIP)


def test_channels_in_rows_are_turned_into_columns(tmp_path):
    found = read(tmp_path, data=np.stack([TIME, SLIP]))
    np.testing.assert_allclose(found["data(2,:)"], SLIP)


def compressed(payload: bytes) -> bytes:
    head = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01" + b"IM"
    return head + struct.pack("<II", 15, len(payload)) + payload


def test_a_file_of_a_few_bytes_that_unpacks_to_gigabytes_is_refused(tmp_path):
    packer = zlib.compressobj(9)
    packed = b"".join(packer.compress(b"\x00" * (1 << 24)) for _ in range(60)) + packer.flush()
    (tmp_path / "bomb.mat").write_bytes(compressed(packed))
    with pytest.raises(InputError, match="unpacks to more than 800 MB"):
        open_table(tmp_path / "bomb.mat")


def test_a_wrong_checksum_is_one_clear_error(tmp_path):
    savemat(tmp_path / "run.mat", {"t": TIME}, do_compression=True)
    data = bytearray((tmp_path / "run.mat").read_bytes())
    data[-1] ^= 0xFF
    (tmp_path / "run.mat").write_bytes(bytes(data))
    with pytest.raises(InputError, match="not a readable MATLAB file"):
        open_table(tmp_path / "run.mat")


def test_version_73_with_cells(tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "run.mat", "w", userblock_size=512) as file:
        file["t"] = TIME[None, :]
        refs = file.create_group("#refs#")
        refs["a"] = SLIP[None, :]
        file.create_dataset("c", data=np.array([[refs["a"].ref]], dtype=h5py.ref_dtype))
    data = bytearray((tmp_path / "run.mat").read_bytes())
    data[:128] = b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02" + b"IM"
    (tmp_path / "run.mat").write_bytes(bytes(data))
    table = open_table(tmp_path / "run.mat")
    assert "c{1}" in table.headers and "t" in table.headers
