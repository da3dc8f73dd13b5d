"""The viewer opens what is there, on this machine only."""

import os
import subprocess

import pytest

from slipwise.errors import InputError, SlipwiseError
from slipwise.view.recordings import viewer
from slipwise.view.recordings.viewer import find_recording, open_viewer, viewer_command


def test_a_folder_without_a_recording_says_what_makes_one(tmp_path):
    with pytest.raises(InputError, match=r"no recording \(\.rrd\).*slipwise replay"):
        open_viewer(tmp_path)
    with pytest.raises(InputError, match="no recording"):
        open_viewer(tmp_path / "nowhere")
    (tmp_path / "record.parquet").touch()
    with pytest.raises(InputError, match="no recording"):
        find_recording(tmp_path / "record.parquet")


def test_the_newest_recording_of_a_folder_is_opened_or_the_file_that_is_named(tmp_path):
    for age, name in enumerate(("new.rrd", "old.rrd")):
        (tmp_path / name).touch()
        os.utime(tmp_path / name, (1e9 - age, 1e9 - age))
    assert find_recording(tmp_path).name == "new.rrd"
    assert find_recording(tmp_path / "old.rrd").name == "old.rrd"


def test_the_viewer_listens_on_the_loopback_address_only(tmp_path):
    command = viewer_command(tmp_path / "a.rrd")
    assert command[command.index("--bind") + 1] == "127.0.0.1"
    assert command[-1] == str(tmp_path / "a.rrd")


def test_the_installed_viewer_knows_the_option_that_binds_it(tmp_path):
    command = [*viewer_command(tmp_path / "a.rrd")[:-1], "--version"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0 and "rerun" in done.stdout


def test_a_viewer_that_cannot_run_says_how_to_look_elsewhere(tmp_path, monkeypatch):
    (tmp_path / "a.rrd").touch()
    monkeypatch.setattr(viewer, "viewer_command", lambda recording: ["false"])
    with pytest.raises(SlipwiseError, match=r"display.*a\.rrd.*--bind 127\.0\.0\.1"):
        open_viewer(tmp_path)
