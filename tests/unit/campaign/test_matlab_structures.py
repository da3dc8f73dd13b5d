"""MATLAB structures that name their channels, in both versions of the file; and objects that only MATLAB can read."""

import struct
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from slipwise.campaign import load_campaign
from slipwise.campaign.draft import draft_campaign
from slipwise.data_files.table import open_table
from slipwise.errors import InputError

TIME = 0.02 * np.arange(120)
SLIP = np.sin(TIME)
LOAD = 500.0 + 0.1 * np.cos(9.0 * TIME)


def dspace() -> dict:
    y = [{"Name": f"Model Root/{n}", "Data": d, "Unit": u} for n, d, u in (("slip", SLIP, "mm"), ("load", LOAD, "N"))]
    return {"run": {"X": {"Name": "time", "Data": TIME, "Unit": "s"}, "Y": y, "Capture": {"SamplingPeriod": 0.01}}}


def simulink() -> dict:
    signals = [{"values": SLIP, "label": "slip (mm)"}, {"values": LOAD, "label": "load (N)"}]
    return {"ScopeData": {"time": TIME, "signals": signals, "blockName": "m/Scope"}}


def lms(increments=(0.02, 0.02)) -> dict:
    return {
        f"Signal_{k}": {
            "x_values": {"start_value": 0.0, "increment": step, "number_of_values": 120.0, "quantity": {"label": "s"}},
            "y_values": {"values": values, "quantity": {"label": unit}},
            "function_record": {"name": name},
        }
        for k, (name, values, unit, step) in enumerate(
            (("slip", SLIP, "mm", increments[0]), ("load", LOAD, "N", increments[1]))
        )
    }


def imported() -> dict:
    return {"A": {"data": np.stack([SLIP, LOAD], axis=1), "colheaders": ["slip", "load"], "textdata": ["slip", "load"]}}


def beside() -> dict:
    return {"data": np.stack([SLIP, LOAD], axis=1), "names": ["slip", "load"], "units": ["mm", "N"], "fs": 50.0}


def catman() -> dict:
    out: dict = {}
    for k, (name, values, unit) in enumerate((("slip", SLIP, "mm"), ("load", LOAD, "N")), 1):
        out[f"Channel_{k}_Data"] = values
        out[f"Channel_{k}_Header"] = {"SignalName": name, "Unit": unit, "SampleFrequency": 50.0}
    return out


def exported() -> dict:
    return {
        name: {"Name": name, "Time": TIME, "Data": values, "DataInfo": {"Units": unit}}
        for name, values, unit in (("slip", SLIP, "mm"), ("load", LOAD, "N"))
    }


def save_hdf5(path: Path, variables: dict) -> None:
    """Write structures as MATLAB does in version 7.3."""
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w", userblock_size=512) as file:
        refs = file.create_group("#refs#")

        def put(group, name, value):
            if isinstance(value, dict):
                inner = group.create_group(name)
                inner.attrs["MATLAB_class"] = np.bytes_("struct")
                for key, content in value.items():
                    put(inner, key, content)
            elif isinstance(value, str):
                codes = np.array([[ord(c)] for c in value], dtype="u2")
                group.create_dataset(name, data=codes).attrs["MATLAB_class"] = np.bytes_("char")
            elif isinstance(value, list) and isinstance(value[0], dict):
                inner = group.create_group(name)
                inner.attrs["MATLAB_class"] = np.bytes_("struct")
                for key in value[0]:
                    inner.create_dataset(key, data=references(f"{name}{key}", [v[key] for v in value]))
            elif isinstance(value, list):
                cell = group.create_dataset(name, data=references(name, value))
                cell.attrs["MATLAB_class"] = np.bytes_("cell")
            else:
                array = np.atleast_2d(np.asarray(value, dtype=float))
                data = array.T if array.shape[0] > 1 else array
                group.create_dataset(name, data=data).attrs["MATLAB_class"] = np.bytes_("double")

        def references(name, values):
            made = []
            for k, value in enumerate(values):
                put(refs, f"{name}{k}", value)
                made.append(refs[f"{name}{k}"].ref)
            return np.array([made], dtype=h5py.ref_dtype)

        for key, content in variables.items():
            put(file, key, content)
    stamp(path)


def stamp(path: Path) -> None:
    data = bytearray(path.read_bytes())
    data[:128] = b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02" + b"IM"
    path.write_bytes(bytes(data))


def saved(tmp_path: Path, variables: dict, version: str) -> Path:
    path = tmp_path / "run.mat"
    save_hdf5(path, variables) if version == "7.3" else savemat(path, variables)
    return path


@pytest.mark.parametrize("version", ["5", "7.3"])
@pytest.mark.parametrize(
    ("content", "time", "step", "units"),
    [
        (dspace, "time [s]", None, True), (simulink, "ScopeData.time", None, True), (lms, None, 0.02, True),
        (imported, None, None, False), (beside, None, 0.02, True), (catman, None, 0.02, True),
        (exported, "slip.Time", None, True),
    ],
)  # fmt: skip
def test_names_units_and_times_are_found_beside_the_data(tmp_path, content, time, step, units, version):
    table = open_table(saved(tmp_path, content(), version))
    headers = [h.replace("(", "[").replace(")", "]") for h in table.headers]
    slip, load = ("slip [mm]", "load [N]") if units else ("slip", "load")
    assert slip in headers and load in headers
    wanted = [headers.index(slip), headers.index(load)]
    np.testing.assert_allclose(np.stack(table.columns(wanted).values), np.stack([SLIP, LOAD]))
    assert table.step == (None if step is None else pytest.approx(step))
    if time is not None:
        np.testing.assert_allclose(table.columns([table.headers.index(time)]).values[0], TIME)


def test_two_channels_of_one_name_keep_their_paths(tmp_path):
    y = [{"Name": "force", "Data": SLIP, "Unit": "N"}, {"Name": "force", "Data": LOAD, "Unit": "N"}]
    table = open_table(saved(tmp_path, {"run": {"Y": y}}, "5"))
    assert table.headers == ("force [N]", "run.Y(2).Data")


def test_a_matrix_without_names_has_no_units(tmp_path):
    table = open_table(saved(tmp_path, {"data": np.stack([TIME, SLIP], axis=1)}, "5"))
    assert table.headers == ("data(:,1)", "data(:,2)")


OBJECTS = [
    ("timeseries", "t = v.Time; x = squeeze(v.Data);"),
    ("timetable", "t = seconds(v.Properties.RowTimes - v.Properties.RowTimes(1)); x = v.Variables;"),
    ("table", "x = v.Variables;"),
    ("datetime", "t = seconds(v - v(1));"),
    ("duration", "t = seconds(v);"),
    ("containers.Map", "save their numbers as vectors"),
]


def opaque(name: str, kind: str) -> bytes:
    """An element of a version 5 file that holds an object."""

    def text(value: str) -> bytes:
        body = value.encode()
        return struct.pack("<II", 1, len(body)) + body + b"\x00" * (-len(body) % 8)

    inner = struct.pack("<IIII", 6, 8, 17, 0) + text(name) + text("MCOS") + text(kind)
    array = struct.pack("<IIII", 6, 8, 6, 0) + struct.pack("<IIii", 5, 8, 1, 1) + struct.pack("<II", 1, 0)
    array += struct.pack("<IId", 9, 8, 1.0)
    inner += struct.pack("<II", 14, len(array)) + array
    return struct.pack("<II", 14, len(inner)) + inner


def with_objects(path: Path, version: str, objects: dict[str, str], **vectors) -> Path:
    if version == "5":
        savemat(path, vectors)
        path.write_bytes(path.read_bytes() + b"".join(opaque(name, kind) for name, kind in objects.items()))
        return path
    save_hdf5(path, vectors)
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "r+") as file:
        for name, kind in objects.items():
            item = file.create_dataset(name, data=np.array([[3707764736, 2, 1, 1, 1, 1]], dtype="u4"))
            item.attrs["MATLAB_class"] = np.bytes_(kind)
            item.attrs["MATLAB_object_decode"] = np.int32(3)
    stamp(path)
    return path


@pytest.mark.parametrize("version", ["5", "7.3"])
@pytest.mark.parametrize(("kind", "instead"), OBJECTS)
def test_an_object_is_left_out_by_name_with_what_to_write_instead(tmp_path, kind, instead, version, recwarn):
    table = open_table(with_objects(tmp_path / "run.mat", version, {"v": kind}, Fx=SLIP))
    assert table.headers == ("Fx",)
    assert table.notes[0].startswith(f"run.mat: v ({kind}) is an object of MATLAB and left out; ")
    assert instead in table.notes[0]
    assert not recwarn.list


@pytest.mark.parametrize("version", ["5", "7.3"])
def test_a_file_of_objects_alone_is_refused_with_all_their_names(tmp_path, version):
    path = with_objects(tmp_path / "run.mat", version, {"log": "timetable", "ts": "timeseries"})
    with pytest.raises(InputError, match=r"no vector or matrix.*log \(timetable\) and ts \(timeseries\) are objects"):
        open_table(path)


@pytest.mark.parametrize("version", ["5", "7.3"])
@pytest.mark.parametrize("kept", [0.1, 0.5, 0.9])
def test_a_file_that_was_cut_is_refused_in_a_sentence(tmp_path, version, kept):
    path = saved(tmp_path, dspace(), version)
    data = path.read_bytes()
    path.write_bytes(data[: int(kept * len(data))])
    with pytest.raises(InputError, match="not a readable MATLAB file"):
        open_table(path)


@pytest.mark.parametrize("version", ["5", "7.3"])
def test_channels_of_different_steps_are_refused_with_both(tmp_path, version):
    with pytest.raises(InputError, match=r"state different steps, 0\.01 s, 0\.02 s"):
        open_table(saved(tmp_path, lms((0.02, 0.01)), version))


def test_a_spectrum_states_no_step(tmp_path):
    content = lms()
    for signal in content.values():
        signal["x_values"]["quantity"]["label"] = "Hz"
    assert open_table(saved(tmp_path, content, "5")).step is None


@pytest.mark.parametrize("version", ["5", "7.3"])
@pytest.mark.parametrize("content", [dspace, simulink, lms, beside, catman, exported])
def test_what_is_drafted_from_such_a_file_reads_as_what_was_measured(tmp_path, content, version):
    saved(tmp_path, content(), version)
    draft, _ = draft_campaign(tmp_path)
    (tmp_path / "campaign.toml").write_text(draft, encoding="utf-8")
    record = load_campaign(tmp_path).runs[0].record
    np.testing.assert_allclose(record["slip_x"], 1e-3 * SLIP, atol=1e-9)
    np.testing.assert_allclose(record["pad_A_N"], LOAD)
    np.testing.assert_allclose(record.time, TIME, atol=1e-9)


def test_objects_that_are_left_out_are_told_in_the_draft(tmp_path):
    with_objects(tmp_path / "run.mat", "7.3", {"log": "timetable", "ts": "timeseries"}, Fx=SLIP)
    draft, _ = draft_campaign(tmp_path)
    assert "# note: run.mat: log (timetable) and ts (timeseries) are objects of MATLAB and left out" in draft
    assert "# note: run.mat shows no time: no column is called time or rises evenly" in draft
    assert '"Fx" = { channel = "pad_A_Fx", unit = "?" }' in draft
