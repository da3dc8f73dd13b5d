"""The check of a screenshot refuses pictures on which there is nothing to see."""

import importlib.util
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from slipwise.record import Record
from slipwise.view.figures.style import PAD_COLOURS, rgb
from slipwise.view.recordings.recording import write_recording

SCRIPT = Path(__file__).parents[3] / "scripts" / "screenshot.py"


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("screenshot", SCRIPT)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def noise() -> np.ndarray:
    return np.random.default_rng(4).uniform(0.0, 0.3, (100, 160, 4))


def test_an_empty_window_is_blank(script):
    assert "blank" in script.what_is_wrong(np.full((100, 160, 4), 0.07), "ABCD")


def test_a_picture_without_the_pads_is_not_one_of_a_recording(script):
    assert "pad A is not on it" in script.what_is_wrong(noise(), "ABCD")


def test_a_picture_with_every_pad_passes(script):
    picture = noise()
    for i, colour in enumerate(PAD_COLOURS.values()):
        picture[10 * i : 10 * i + 8, :20, :3] = np.array(rgb(colour)) / 255.0
    assert script.what_is_wrong(picture, "ABCD") == ""
    assert "pad E is not on it" in script.what_is_wrong(picture, "ABCDE")


def test_a_recording_says_which_pads_it_shows(script, record, geometry, tmp_path):
    three = Record(record.time, {n: v for n, v in record.channels.items() if not n.startswith("pad_D")})
    assert script.pads_of(write_recording(three, geometry, tmp_path / "r.rrd", "t")) == ("A", "B", "C")


def test_without_a_virtual_display_it_is_skipped_with_a_reason(script, monkeypatch, tmp_path, capsys):
    (tmp_path / "a.rrd").touch()
    monkeypatch.setattr(shutil, "which", lambda name: None)
    monkeypatch.setattr(sys, "argv", ["screenshot.py", str(tmp_path / "a.rrd"), "--out", str(tmp_path / "a.png")])
    assert script.main() == 0
    assert "skipped: xvfb-run is not installed" in capsys.readouterr().out


def test_a_missing_recording_is_an_error(script, monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(sys, "argv", ["screenshot.py", str(tmp_path / "a.rrd"), "--out", str(tmp_path / "a.png")])
    assert script.main() == 1
    assert "no such recording" in capsys.readouterr().out
