"""Campaigns that were answered wrongly once, through the command line; and what each answer advises, followed."""

import json
import re
import runpy
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

import slipwise as package
from shaking import needs_shared
from slipwise.campaign import load_campaign

DEMO = Path(package.__file__).parent / "demo_data"


@pytest.fixture
def folder(monkeypatch, tmp_path):
    """Copy a folder of ../shared/faulty_inputs, or make it with its make.py, and stand in it."""

    def of(name: str) -> Path:
        source, here = needs_shared("faulty_inputs", name), tmp_path / "campaign"
        if (source / "make.py").exists():
            monkeypatch.setattr(sys, "argv", ["make.py", str(DEMO), str(here)])
            runpy.run_path(str(source / "make.py"), run_name="__main__")
        else:
            shutil.copytree(source, here)
            (here / "answer.json").unlink()
        monkeypatch.chdir(here)
        return here

    return of


def refused(answer: tuple[int, str, str], *words: str) -> str:
    code, _, err = answer
    assert code == 2 and err.startswith("error: ") and "Traceback" not in err
    assert all(said in err for said in words), err
    return err


def test_a_ton_is_refused_and_t_is_1000_kg(slipwise, folder):
    here = folder("05_ton_is_a_short_ton")
    err = refused(slipwise("audit", "."), "'ton' may be of 1000, 907 or 1016 kg", "write t for 1000 kg")
    advised = re.search(r"write (\w+) for 1000 kg", err)
    assert advised
    text = (here / "campaign.toml").read_text()
    (here / "campaign.toml").write_text(text.replace("ton", advised[1]))
    assert load_campaign(here).specimen.mass == pytest.approx(10_000.0, rel=1e-12)
    assert slipwise("audit", ".")[0] == 0


#: folder and the columns of its table: time, slip, friction, load.
DRAFTED = {
    "keys above": ("14_key_value_lines_above_the_table", ("Time [s]", "Slip [mm]", "Force [kN]", "Load [kN]")),
    "TOA5": ("15_three_header_rows", ("TIMESTAMP [s]", "Slip [mm]", "Shear [kN]", "Load [kN]")),
    "MTS": ("16_repeated_blocks", ("Running Time [Sec]", "Axial Displacement [mm]", "Lateral Force [kN]",
                                   "Axial Force [kN]")),
}  # fmt: skip


@pytest.mark.parametrize("kind", DRAFTED)
def test_a_loggers_table_is_drafted_with_its_columns_and_compared(slipwise, folder, kind):
    name, columns = DRAFTED[kind]
    here = folder(name)
    assert slipwise("init", ".")[0] == 0
    text = (here / "campaign.toml").read_text()
    mapped = dict(re.findall(r'^"(.+?)" = \{ channel = "(\w+)"', text, re.MULTILINE))
    assert mapped == dict(zip(columns, ("time", "slip_x", "pad_A_Fx", "pad_A_N"), strict=True))
    code, _, err = slipwise("compare", ".", "--no-recording", "--out", here.parent / "out")
    assert code == 0 and "Traceback" not in err
    run = load_campaign(here).runs[0]
    assert np.median(run.record["pad_A_N"]) == pytest.approx(150e3)
    assert np.abs(run.record["pad_A_Fx"]).max() == pytest.approx(15e3, rel=0.01)


def test_repeated_blocks_are_one_run_of_all_rows(slipwise, folder):
    here = folder("16_repeated_blocks")
    slipwise("init", ".")
    record = load_campaign(here).runs[0].record
    assert len(record.time) == 180 and np.all(np.diff(record.time) > 0.0)


def test_a_note_in_the_folder_is_passed_over_and_listed(slipwise, folder):
    here = folder("14c_notes_in_the_folder")
    code, out, _ = slipwise("init", ".")
    assert code == 0 and "not read: notes.txt" in out
    assert [run.file for run in load_campaign(here).runs] == ["run.csv"]


def test_a_mat_with_a_wrong_checksum_is_to_be_saved_again_and_then_read(slipwise, folder):
    here = folder("17_mat_checksum")
    refused(slipwise("init", "."), "run.mat", "not a readable MATLAB file", "save it again")
    time = 0.01 * np.arange(200.0)
    savemat(here / "run.mat", {"time": time, "slip_x": np.sin(time)}, do_compression=True)
    assert slipwise("init", ".")[0] == 0


#: folder -> the findings that an audit must name, all of them, and none besides.
ACCUSED = {
    "19_all_loads_compression_negative": {"channel_sign:pad_*_N": "pad_*_N has the wrong sign"},
    "20_gravity_in_both_vertical_gauges": {
        f"channel_offset:{name}": f"gravity is in {name}: it reads +9.81 m/s^2 at rest"
        for name in ("table_az", "girder_az")
    },
    "21_both_vertical_gauges_down": {
        f"channel_sign:{name}": f"{name} has the wrong sign" for name in ("table_az", "girder_az")
    },
}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.long] * (not name.startswith("21"))) for name in ACCUSED]
)
def test_the_audit_names_each_fault_once_and_correcting_it_leaves_none(slipwise, folder, name):
    folder(name)
    code, out, _ = slipwise("audit", ".")
    first = out.splitlines()[0]
    assert code == 0
    assert first == f"No: {'; '.join(ACCUSED[name].values())}. No law of friction was needed to see it."
    corrections = [word for finding in ACCUSED[name] for word in ("--correct", finding)]
    code, out, _ = slipwise("audit", ".", *corrections)
    assert code == 0 and "no gauge is accused" in out


@pytest.mark.slow
@pytest.mark.long
def test_loads_that_count_compression_negative_are_mended_and_told_as_those_whose_sign_is_stated(slipwise, folder):
    here = folder("19_all_loads_compression_negative")
    plain = ("compare", ".", "--no-recording", "--no-system", "--out", here.parent / "out", "--json")
    mended = json.loads(slipwise(*plain)[1])
    assert any("wrong sign; reversed before any fit" in one["words"] for one in mended["corrections"])
    text = (here / "campaign.toml").read_text()
    lines = "".join(f'"pad_{pad}_N [kN]" = {{ channel = "pad_{pad}_N", unit = "kN", sign = -1 }}\n' for pad in "ABCD")
    before, mark, after = text.partition("[columns]\n")
    text = before + mark + lines + after if mark else text.replace("[[run]]", f"[columns]\n{lines}\n[[run]]", 1)
    (here / "campaign.toml").write_text(text)
    code, out, _ = slipwise("audit", ".")
    assert code == 0 and "no gauge is accused" in out
    stated = json.loads(slipwise(*plain)[1])
    assert not stated["corrections"]
    for relation, error in stated["components"].items():
        assert mended["components"][relation]["fit"] == pytest.approx(error["fit"], rel=1e-9)


@pytest.mark.slow
@pytest.mark.long
def test_a_pendulum_bearing_under_a_load_that_stays_is_a_curved_face(slipwise, folder):
    """A sphere of 2.2 m under 900 kN was called a restrainer of 410 kN/m without a gap."""
    here = folder("31_pendulum_bearing_at_constant_load")
    code, printed, _ = slipwise("diagnose", ".")
    said = json.loads((here / "out" / "diagnosis" / "diagnosis.json").read_text())
    assert code == 0 and "Confirmed on runs that no fit has seen: h." in printed
    assert (said["verdict"], said["effects"], said["confirmed"]) == ("named", ["slide_curvature"], True)
    curvature = said["candidates"][0]["parameters"]["slide_curvature.curvature"]
    assert curvature["value"] == pytest.approx(1.0 / 2.2, rel=0.02)
