"""Motions that were answered wrongly once, replayed as a user types it; and what each refusal advises, followed."""

import json
import shutil

import numpy as np
import pytest

from shaking import needs_shared
from slipwise.record import read_record

NOTHING_DRAWN = ("--no-pictures", "--no-recording")
BY_RULER = ("--motion-dt", "0.01 s")

#: folder: files, options, step of the record [s], peak along each axis [m/s^2], words that must be said.
READ = {
    "header": ("01_header_states_unit_and_step", ("ZQ01.HNE.asc", "ZQ01.HNN.asc", "ZQ01.HNZ.asc"), (), 0.005,
               {"x": 1.23456, "y": 0.987, "z": 0.555}, ("HNE drives the table in x", "HNZ drives the table in z")),
    "bridge": ("02_csmip_bridge_one_channel_a_file", ("chan001.v2", "chan002.v2", "chan003.v2"), (), 0.005,
               {"x": 0.617, "y": 0.444, "z": 0.333}, ("Long at Pier Cap 2", "Up drives the table in z")),
    "one channel": ("02_csmip_bridge_one_channel_a_file", ("chan002.v2",), (), 0.005, {"x": 0.617}, ("Long",)),
    "count": ("06_count_in_the_first_line", ("q.txt",), ("--unit", "gal", *BY_RULER), 0.01, {"x": 1.5}, ()),
    "wrapped": ("07_wrapped_values", ("NOW_360.g3",), ("--unit", "g", "--motion-dt", "0.02 s"), 0.02, {"x": 3.0401},
                ("8 values a line, read line by line as one series",)),
    "time": ("08_time_column_without_unit", ("st.csv",), (), 0.01, {"x": 2.1, "y": 2.7, "z": 0.6},
             ("column 'time' has no unit: taken in seconds",)),
    "velocity": ("09_acceleration_velocity_displacement", ("ss.txt",), (), 0.01, {"x": 2.942},
                 ("left out: Velocity (velocity), Displacement (displacement)",)),
    "latin-1": ("10_latin1_square", ("l.txt",), (), 0.01, {"x": 2.942}, ()),
    "DT first": ("11_at2_layouts", ("a_dt_first090.AT2",), (), 0.01, {"x": 2.0594}, ("component 090",)),
    "unit behind": ("11_at2_layouts", ("b_unit_behind090.AT2",), (), 0.01, {"x": 2.0594}, ("component 090",)),
    "D exponents": ("11_at2_layouts", ("c_exponent_D090.AT2",), (), 0.01, {"x": 2.0594}, ("component 090",)),
    "end mark": ("11_at2_layouts", ("d_end_mark090.AT2",), (), 0.01, {"x": 2.0594}, ("component 090",)),
    "NUL tail": ("13_nul_tail", ("ZZZ0013102030902.EW",), (), 0.01, {"x": 0.8}, ("EW drives the table in x",)),
    "KiK-net names": ("18_component_names",
                      ("RSN9_NOW_ZZZH09EW2.AT2", "RSN9_NOW_ZZZH09NS2.AT2", "RSN9_NOW_ZZZH09UD2.AT2"), (), 0.01, {},
                      ("EW2 drives the table in x", "NS2 drives the table in y", "UD2 drives the table in z")),
}  # fmt: skip

#: folder, files, options, words of the refusal, then the options that it advises.
REFUSED = {
    "another step": ("01_header_states_unit_and_step", ("ZQ01.HNE.asc", "ZQ01.HNN.asc", "ZQ01.HNZ.asc"),
                     BY_RULER, ("states a step of 0.005 s, 0.01 s was given", "leave --motion-dt out"), ()),
    "another unit": ("01_header_states_unit_and_step", ("ZQ01.HNE.asc", "ZQ01.HNN.asc", "ZQ01.HNZ.asc"),
                     ("--unit", "g"), ("states 'cm/s^2' as its unit, 'g' was given", "leave --unit out"), ()),
    "two stations": ("03_knet_components_of_two_stations",
                     ("ZZZ0013102030902.EW", "ZZZ0013102030902.UD", "ZZZ0023102030902.NS"), (),
                     ("ZZZ001 and ZZZ002", "2031-02-03 09:02:18 and 2031-02-03 09:02:24", "--join-anyway"),
                     ("--join-anyway",)),
    "gravity": ("04_vertical_gauge_reads_gravity", ("table.csv",), (),
                ("mean of table_az", "+1 g", "--baseline mean takes it out"), ("--baseline", "mean")),
    "gravity shaken": ("04_vertical_gauge_reads_gravity", ("table.csv",), (), ("--baseline none",),
                       ("--baseline", "none")),
}  # fmt: skip


def shaken(slipwise, monkeypatch, tmp_path, folder: str, files: tuple[str, ...], options: tuple[str, ...], step: float):
    monkeypatch.chdir(needs_shared("faulty_inputs", folder))
    code, out, err = slipwise(
        "replay", *files, *options, *NOTHING_DRAWN, "--output-step", f"{step} s", "--out", tmp_path
    )
    assert "Traceback" not in err
    return code, " ".join(out.split()), err


@pytest.mark.parametrize("kind", READ)
def test_it_is_read_with_the_peaks_of_its_header(slipwise, monkeypatch, tmp_path, kind):
    folder, files, options, step, peaks, words = READ[kind]
    code, out, err = shaken(slipwise, monkeypatch, tmp_path, folder, files, options, step)
    assert (code, err) == (0, "")
    assert all(said in out for said in words)
    record = read_record(tmp_path / "record.parquet")
    for axis, peak in peaks.items():
        found = np.abs(record[f"table_a{axis}"]).max()
        digits = len(str(peak).partition(".")[2])
        assert found == pytest.approx(peak, abs=0.5 * 10.0**-digits)


def test_a_count_in_the_first_line_is_no_sample(slipwise, monkeypatch, tmp_path):
    folder, files, options, step, *_ = READ["count"]
    shaken(slipwise, monkeypatch, tmp_path, folder, files, options, step)
    record = read_record(tmp_path / "record.parquet")
    assert len(record.time) == 400 and abs(record["table_ax"][0]) < 1.0


@pytest.mark.parametrize("kind", REFUSED)
def test_the_refusal_is_true_and_its_advice_helps(slipwise, monkeypatch, tmp_path, kind):
    folder, files, options, words, advised = REFUSED[kind]
    code, _, err = shaken(slipwise, monkeypatch, tmp_path, folder, files, options, 0.01)
    assert code == 2 and err.startswith("error: ") and err.count("\n") == 1
    assert all(said in err for said in words)
    code, _, err = shaken(slipwise, monkeypatch, tmp_path, folder, files, advised, 0.01)
    assert code == 0 and "error" not in err


def test_gravity_that_was_taken_out_loads_no_pad(slipwise, monkeypatch, tmp_path):
    folder, files, *_, advised = REFUSED["gravity"]
    shaken(slipwise, monkeypatch, tmp_path, folder, files, advised, 0.01)
    pads = json.loads((tmp_path / "summary.json").read_text())["pads"]
    assert all(pad["N_max_kN"] < 35.0 for pad in pads.values())


def test_every_contradiction_is_refused_until_all_are_left_out(slipwise, monkeypatch, tmp_path):
    folder, files, *_ = REFUSED["another step"]
    given = {"--motion-dt": ("--motion-dt", "0.01 s"), "--unit": ("--unit", "g")}
    for _ in range(2):
        options = tuple(word for pair in given.values() for word in pair)
        code, _, err = shaken(slipwise, monkeypatch, tmp_path, folder, files, options, 0.005)
        assert code == 2
        given.pop(next(option for option in given if f"leave {option} out" in err))
    assert shaken(slipwise, monkeypatch, tmp_path, folder, files, (), 0.005)[0] == 0


def test_a_digitized_accelerogram_sends_to_the_v2_file_which_is_read(slipwise, monkeypatch, tmp_path):
    code, _, err = shaken(slipwise, monkeypatch, tmp_path, "12_csmip_volume_1", ("now.v1",), (), 0.01)
    assert code == 2
    assert "uncorrected accelerogram (Volume 1)" in err and "take the V2 file" in err
    assert "truncated" not in err and "damaged" not in err
    bridge = "02_csmip_bridge_one_channel_a_file"
    assert shaken(slipwise, monkeypatch, tmp_path, bridge, ("chan002.v2",), (), 0.005)[0] == 0


def test_a_corrected_header_is_advice_that_works_too(slipwise, monkeypatch, tmp_path):
    folder, files, *_ = REFUSED["another step"]
    for name in files:
        source = needs_shared("faulty_inputs", folder) / name
        shutil.copy(source, tmp_path / name)
        text = source.read_text().replace("0.005", "0.010", 1)
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    code, _, err = slipwise("replay", *files, *BY_RULER, *NOTHING_DRAWN, "--out", tmp_path / "out")
    assert code == 0
    assert "states the peak of HNE at 0.62 s, the data reach it at 1.24 s; look at the step of 0.01 s" in err
