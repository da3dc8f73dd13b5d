"""An install without rerun, which weighs most of all: everything but recordings works."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import slipwise

#: Python without rerun: whatever asks for it is told that it is not installed.
WITHOUT = """
import sys

class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("rerun", "rerun_cli", "rerun_bindings", "rerun_sdk"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

sys.meta_path.insert(0, Missing())
from slipwise.cli import main
main()
"""


def run(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", WITHOUT, *words], capture_output=True, text=True)


def test_nothing_but_recordings_imports_rerun() -> None:
    package = Path(slipwise.__file__).parent
    importing = re.compile(r"^\s*(?:import|from) rerun", re.M)
    files = {p.relative_to(package) for p in package.rglob("*.py") if importing.search(p.read_text(encoding="utf-8"))}
    assert files and {file.parts[:2] for file in files} == {("view", "recordings")}


def test_a_replay_writes_its_record_and_says_that_there_is_no_recording(tmp_path: Path) -> None:
    done = run("replay", "sine:10Hz,0.4g,cycles=9", "--out", str(tmp_path), "--no-pictures")
    assert done.returncode == 0, done.stderr
    assert "rerun is not installed; `pip install" in done.stderr and "--no-recording" in done.stderr
    assert (tmp_path / "record.parquet").is_file()
    assert not list(tmp_path.glob("*.rrd"))


def test_without_a_recording_nothing_is_said_of_rerun(tmp_path: Path) -> None:
    done = run("replay", "sine:10Hz,0.4g,cycles=9", "--out", str(tmp_path), "--no-recording", "--no-pictures")
    assert (done.returncode, "rerun" in done.stderr) == (0, False)


def test_a_recording_of_somebody_else_cannot_be_shown_and_one_is_told_why(tmp_path: Path) -> None:
    (tmp_path / "replay.rrd").write_bytes(b"RRF2")
    done = run("view", str(tmp_path))
    assert done.returncode == 2 and "cannot be shown: rerun is not installed" in done.stderr


@pytest.mark.long
def test_a_diagnosis_needs_no_rerun(tmp_path: Path) -> None:
    campaign = Path(slipwise.__file__).parent / "demo_data"
    done = run("diagnose", str(campaign), "--no-system", "--out", str(tmp_path))
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "report.html").is_file() and not list(tmp_path.glob("*.rrd"))
