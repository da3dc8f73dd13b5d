"""`slipwise replay` and the lists, as a first-time user types them."""

import json

import numpy as np
import pytest

from slipwise.record import read_record


def test_a_synthetic_motion_leaves_record_summary_pictures_and_recording(slipwise, tmp_path):
    code, out, _ = slipwise("replay", "sine:2Hz,0.3g,cycles=9", "--out", tmp_path)
    assert code == 0
    names = {p.name for p in tmp_path.iterdir()}
    assert {"record.parquet", "summary.json", "loops.png", "loads.png", "replay.rrd"} <= names
    assert "slip along x, largest" in out and "slip along y" not in out
    numbers = json.loads((tmp_path / "summary.json").read_text())
    record = read_record(tmp_path / "record.parquet")
    assert numbers["slip_x_max_mm"] == pytest.approx(abs(record["slip_x"]).max() * 1e3, rel=1e-3)
    assert record.provenance["rig"] == "bridge1"
    assert all(0.0 < numbers[key] < 60.0 for key in ("wall_s", "compile_s", "write_s", "draw_s"))
    assert f"{numbers['wall_s']:.4g}" in out


def test_slip_and_energy_are_told_along_both_directions(slipwise, tmp_path):
    time = np.arange(0.0, 6.0, 0.01)
    wave = 0.4 * np.sin(2 * np.pi * time) * np.clip(time / 2, 0, 1)
    lines = ["time [s],ax [g],ay [g]", *(f"{t},{a},{-1.5 * a}" for t, a in zip(time, wave, strict=True))]
    (tmp_path / "both.csv").write_text("\n".join(lines))
    code, out, err = slipwise(
        "replay", tmp_path / "both.csv", "--x", "ax", "--y", "ay", "--out", tmp_path / "o", "--no-recording"
    )
    assert code == 0, err
    numbers = json.loads((tmp_path / "o" / "summary.json").read_text())
    record = read_record(tmp_path / "o" / "record.parquet")
    vector = np.hypot(record["slip_x"], record["slip_y"])
    assert numbers["slip_y_max_mm"] == pytest.approx(1e3 * np.abs(record["slip_y"]).max(), rel=1e-3)
    assert numbers["slip_max_mm"] == pytest.approx(1e3 * vector.max(), rel=1e-3)
    assert numbers["slip_max_mm"] > max(numbers["slip_x_max_mm"], numbers["slip_y_max_mm"])
    assert numbers["energy_x_kN_cm"] + numbers["energy_y_kN_cm"] == pytest.approx(numbers["energy_kN_cm"])
    assert numbers["energy_y_kN_cm"] > 1.0
    assert "slip along y, largest" in out and "largest of the vector" in out


@pytest.mark.long
def test_a_model_that_was_fitted_is_replayed_with_its_own_numbers_and_laws(slipwise, tmp_path):
    assert slipwise("effects", "--new", "extra", "--out", tmp_path)[0] == 0
    file = tmp_path / "model.toml"
    file.write_text(
        'rig = "bridge2"\n[specimen]\nmass = "9 t"\n[[effect]]\nname = "shear_rate"\n[[effect]]\nfile = "extra.py"\n'
    )
    motion = ("replay", "sine:2Hz,0.3g,cycles=9", "--model", file, "--no-pictures", "--no-recording")
    code, _, err = slipwise(*motion, "--out", tmp_path / "o")
    assert code == 2 and "extra.py" in err and "--trust" in err and not (tmp_path / "o").exists()
    for allowed in (["--trust"], ["--effect", tmp_path / "extra.py"]):
        code, out, err = slipwise(*motion, *allowed, "--out", tmp_path / "o")
        assert code == 0 and "the model is that of" in out, err
        record = read_record(tmp_path / "o" / "record.parquet")
        assert record.provenance["rig"] == "bridge2" and "extra" in record.provenance["model"]
    assert sum(record[f"pad_{pad}_N"][0] for pad in "ABCD") == pytest.approx(9e3 * 9.81, rel=0.02)
    for option in (("--rig", "bridge1"), ("--law", "coulomb")):
        code, _, err = slipwise(*motion, *option, "--out", tmp_path / "o")
        assert code == 2 and "leave --rig and --law out" in err


@pytest.mark.slow
def test_the_same_input_gives_the_same_bytes_but_for_times_and_ids_of_rerun(slipwise, tmp_path):
    one, two = tmp_path / "one", tmp_path / "two"
    for folder in (one, two):
        assert slipwise("replay", "sine:2Hz,0.3g,cycles=9", "--out", folder)[0] == 0
    assert {p.name for p in one.iterdir()} == {p.name for p in two.iterdir()}
    for path in (p for p in one.iterdir() if p.suffix in (".parquet", ".png")):
        assert path.read_bytes() == (two / path.name).read_bytes(), path.name
    numbers = [json.loads((folder / "summary.json").read_text()) for folder in (one, two)]
    times = ("wall_s", "compile_s", "write_s", "draw_s")
    first, second = ({k: v for k, v in of.items() if k not in times} for of in numbers)
    assert first == second and {"slip_x_half_range_mm", "rig", "motion"} <= first.keys()


def test_json_is_for_a_program_to_read(slipwise, tmp_path):
    code, out, _ = slipwise(
        "replay", "sine:2Hz,0.3g,cycles=9", "--out", tmp_path, "--json", "--no-pictures", "--no-recording", "--csv"
    )
    assert code == 0
    assert json.loads(out)["rig"] == "bridge1"
    assert (tmp_path / "record.csv").read_text().startswith("time [s],table_ax [m/s^2]")


@pytest.mark.parametrize("rig", ["bridge2", "block", "pad"])
def test_every_rig_can_be_shaken_and_drawn(slipwise, tmp_path, rig):
    code, _, err = slipwise("replay", "sine:1Hz,0.2g,cycles=9", "--rig", rig, "--out", tmp_path)
    assert (code, err) == (0, "")
    assert (tmp_path / "loops.png").stat().st_size > 10_000


def test_an_effect_is_switched_on_by_name_and_by_file(slipwise, tmp_path):
    common = ("replay", "sine:2Hz,0.3g,cycles=9", "--no-pictures", "--no-recording", "--json")
    plain = json.loads(slipwise(*common, "--out", tmp_path / "a")[1])
    damped = json.loads(slipwise(*common, "--out", tmp_path / "b", "--effect", "buffer_damping")[1])
    assert damped["energy_kN_cm"] < plain["energy_kN_cm"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("replay", "nothing.at2"), "no such file"),
        (("replay", "sine:2Hz,0.3g", "--rig", "bridg1"), "bridge1"),
        (("replay", "sine:2Hz,0.3"), "no unit"),
        (("replay", "sine:2Hz,0.3kg"), "wrong dimension"),
        (("replay", "sine:2Hz,0.3g", "--step", "5 ms"), "at most"),
        (("replay", "sine:2Hz,0.3g", "--effect", "breakawy"), "breakaway"),
        (("replay", "sine:2Hz,0.3g", "--law", "stribeck"), "paper and coulomb"),
        (("replay", "sine:2Hz,0.3g", "--similarity", "bridge9"), "bridge1, bridge2"),
        (("replay", "sine:2Hz,0.3g", "--x", "EW"), "recorded motions"),
        (("replay",), "Missing argument"),
        (("view", "nowhere"), "nowhere"),
    ],
)
def test_bad_input_is_one_clear_message_and_exit_2(slipwise, tmp_path, monkeypatch, words, message):
    monkeypatch.chdir(tmp_path)
    code, _, err = slipwise(*words)
    assert code == 2
    assert message in err
    assert "Traceback" not in err
    assert not list(tmp_path.rglob("*.parquet"))


def test_a_folder_that_is_a_file_is_refused(slipwise, tmp_path):
    (tmp_path / "taken").write_text("mine")
    code, _, err = slipwise("replay", "sine:2Hz,0.3g", "--out", tmp_path / "taken")
    assert code == 2
    assert "a file of this name exists" in err
    assert (tmp_path / "taken").read_text() == "mine"


def test_a_motion_beyond_the_tables_stroke_is_warned_of(slipwise, tmp_path):
    code, _, err = slipwise(
        "replay", "sine:0.5Hz,0.2g,cycles=9", "--stroke", "100 mm", "--out", tmp_path, "--no-pictures", "--no-recording"
    )
    assert code == 0
    assert "stroke is 100.0 mm" in err


def test_a_simulation_that_runs_away_leaves_its_record(slipwise, tmp_path):
    code, _, err = slipwise("replay", "sine:0.2Hz,9g,cycles=9", "--rig", "block", "--out", tmp_path)
    assert code == 2
    assert "stopped at" in err
    assert len(read_record(tmp_path / "record.parquet")) > 10
    assert not (tmp_path / "summary.json").exists()


@pytest.mark.parametrize("what", ["rigs", "channels", "motions"])
def test_the_lists_are_printed_and_are_json_on_demand(slipwise, what):
    assert slipwise(what)[0] == 0
    assert json.loads(slipwise(what, "--json")[1])


def test_every_command_has_help_with_an_example(slipwise):
    code, out, _ = slipwise("--help")
    assert code == 0
    for command in ("replay", "rigs", "channels", "motions", "view"):
        assert command in out
        code, text, _ = slipwise(command, "--help")
        assert code == 0
        assert "Example" in text
