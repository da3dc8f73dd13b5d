"""The promise, as a newcomer types it: demo, then add and remove on the same data."""

import json
import re
import shutil
from contextlib import closing
from importlib.resources import files
from pathlib import Path

import pytest

from slipwise.model.file import load_model
from slipwise.session.session import Session


@pytest.mark.long  # CI runs the command with the lowest versions, and looks for the name
def test_the_demo_names_the_hidden_effect_and_the_error_falls_to_the_floor(slipwise, tmp_path):
    code, out, err = slipwise("demo", "--out", tmp_path)
    assert code == 0 and all(re.fullmatch(r" *\d+ s +\d+ %  .+", line) for line in err.splitlines())
    written = json.loads((tmp_path / "diagnosis.json").read_text())
    assert (written["verdict"], written["effects"]) == ("named", ["run_in"])
    assert written["base_error"] > 2.0
    assert written["final_error"] < 1.15
    assert written["system"]["final"] < written["system"]["base"]
    steps = json.loads((tmp_path / "ladder.json").read_text())
    assert steps[0]["effects"] == []
    assert steps[-1]["effects"] == ["run_in"]
    page = (tmp_path / "report.html").read_text()
    assert "run_in" in page
    assert not re.search(r"""(src|href)=["']https?:""", page)
    assert (tmp_path / "before_and_after.rrd").stat().st_size > 100_000
    assert "run_in" in load_model(tmp_path / "campaign" / "model.toml")
    printed = " ".join(out.split())
    assert "nothing above the noise floor is left" in printed and "nothing is left above the noise" in printed
    assert "five runs" in printed and "fitted to four runs" in printed and "slipwise effects run_in" in printed


@pytest.mark.slow
def test_add_and_remove_edit_the_model_and_print_the_error_before_and_after(slipwise, tmp_path):
    campaign = tmp_path / "campaign"
    shutil.copytree(Path(str(files("slipwise"))) / "demo_data", campaign)
    code, out, _ = slipwise("add", "run_in", "--campaign", campaign)
    assert code == 0
    pads = next(line for line in out.splitlines() if line.strip().startswith("pads")).split()
    assert float(pads[1]) > 3.0 > 1.2 > float(pads[2])
    assert "run_in" in load_model(campaign / "model.toml")
    with closing(Session(campaign)) as session:  # what the workbench opens
        assert session.accepted and session.state.labels[-1] == "run_in" and session.history.before is not None
    code, out, _ = slipwise("remove", "run_in", "--campaign", campaign)
    assert code == 0
    pads = next(line for line in out.splitlines() if line.strip().startswith("pads")).split()
    assert float(pads[1]) < 1.2 < 3.0 < float(pads[2])
    assert "run_in" not in load_model(campaign / "model.toml")


@pytest.mark.slow
@pytest.mark.long
def test_a_file_of_ones_own_is_added_fitted_and_written_to_the_model(slipwise, tmp_path):
    campaign, own = tmp_path / "campaign", tmp_path / "my_run_in.py"
    shutil.copytree(Path(str(files("slipwise"))) / "demo_data", campaign)
    shutil.copy(Path(str(files("slipwise"))) / "effects" / "run_in.py", own)
    code, out, _ = slipwise("add", own, "--campaign", campaign)
    assert code == 0
    pads = next(line for line in out.splitlines() if line.strip().startswith("pads")).split()
    assert float(pads[1]) > 3.0 > 1.2 > float(pads[2])
    assert abs(load_model(campaign / "model.toml", trust=True)["my_run_in"].values["rise"]) > 0.1


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("add", "nowhere.py", "--campaign", "."), "campaign.toml"),
        (("add", "run_inn", "--campaign", "."), "campaign.toml"),
        (("diagnose", "nowhere"), "nowhere"),
        (("ladder", "nowhere"), "nowhere"),
    ],
)
def test_bad_input_is_one_clear_message_and_exit_2(slipwise, tmp_path, monkeypatch, words, message):
    monkeypatch.chdir(tmp_path)
    code, _, err = slipwise(*words)
    assert code == 2
    assert message in err
    assert "Traceback" not in err


def test_an_unknown_effect_is_answered_with_the_nearest(slipwise, tmp_path):
    campaign = tmp_path / "campaign"
    shutil.copytree(Path(str(files("slipwise"))) / "demo_data", campaign)
    code, _, err = slipwise("add", "run_inn", "--campaign", campaign)
    assert code == 2
    assert "run_in" in err
    assert not (campaign / "model.toml").exists()
