"""`slipwise watch` is ended at any time: what was known is on disk, and the same command goes on."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from slipwise.cli import main
from unit.campaign.slider import HEADER, slider, text


def watching(folder: Path) -> subprocess.Popen:
    command = [sys.executable, "-m", "slipwise", "watch", str(folder), "--out", str(folder / "out")]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, preexec_fn=_hearing)


def _hearing() -> None:
    """Let Ctrl-C end the child: what runs in the background of a shell ignores it, and so would its children."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def steps_when(folder: Path, true, process: subprocess.Popen) -> list[dict]:
    """Wait until something is true of the steps that are on disk; whatever stands there can always be read."""
    kept = folder / "out" / "watch.json"
    while process.poll() is None:
        if kept.is_file() and true(steps := json.loads(kept.read_text())["steps"]):
            return steps
        time.sleep(0.05)
    raise AssertionError(process.communicate()[0])


@pytest.mark.slow
@pytest.mark.long
def test_a_killed_watch_goes_on_and_one_that_is_interrupted_leaves_a_page_that_says_so(tmp_path):
    (tmp_path / "campaign.toml").write_text('name = "slider"\nrig = "pad"\n[[run]]\nfile = "one.csv"\nrole = "fit"\n')
    (tmp_path / "one.csv").write_text(text(slider(1, 600), HEADER))
    first = watching(tmp_path)
    steps_when(tmp_path, lambda steps: steps[-1]["gauges"], first)
    first.kill()
    first.wait()
    assert 'http-equiv="refresh"' in (tmp_path / "out" / "watch.html").read_text()
    second = watching(tmp_path)
    (step,) = steps_when(tmp_path, lambda steps: steps[-1]["finished"], second)
    assert step["runs"] == ["one"] and step["verdict"]["verdict"]
    assert "no table motion" in step["next_words"]
    assert (tmp_path / "out" / step["report"] / "report.html").is_file()
    second.send_signal(signal.SIGINT)
    said = second.communicate()[0]
    assert second.returncode == 130
    assert "What is missing?" in said and "Traceback" not in said
    assert "The watch has ended" in (tmp_path / "out" / "watch.html").read_text()


def test_a_folder_without_a_campaign_ends_the_command_with_the_cure(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["slipwise", "watch", str(tmp_path), "--out", str(tmp_path / "out")])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 2
    assert "slipwise init" in capsys.readouterr().err
    assert not (tmp_path / "out" / "watch.html").exists()
