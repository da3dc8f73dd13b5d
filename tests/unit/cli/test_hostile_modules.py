"""Nothing in the current folder is run, whatever its name: a campaign folder may come from a stranger."""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from contextlib import suppress
from importlib import resources
from importlib.util import find_spec
from pathlib import Path

import pytest

#: Modules that a command or one of its processes imports, and those that Python itself looks for when it starts.
TWINS = (
    "multiprocessing", "rerun_cli", "numpy", "scipy", "numba", "mujoco", "slipwise", "json", "re", "pickle", "signal",
    "threading", "tempfile", "uvicorn", "matplotlib", "sitecustomize", "usercustomize",
)  # fmt: skip
#: A twin tells that it was run, without importing anything.
TWIN = "open(__file__ + '.was_run', 'w').close()\nraise ImportError('a twin was run')\n"
SLIPWISE = Path(sys.executable).with_name("slipwise")
MOTION = "sine:2Hz,0.3g,cycles=9"
#: Commands that start processes; and all others that do something.
STARTING = (
    f"ensemble {MOTION} --vary rig.mass=9..11t --members 2 --workers 2 --out e",
    "view .",
    "workbench . --no-show",
)
OTHERS = (
    "--version", "rigs", "channels", "motions", "effects", "effects heating --picture a.png", "effects --new mine",
    "init drafted --yes", f"replay {MOTION} --out o", "audit .", "compare . --out c", "diagnose . --out d",
    "ladder . --out l", "discover . --out f", "add run_in", "remove run_in", "next . --out n",
    "bench . --workers 2 --out b", "paper --quick --workers 2 --out p", "demo --out q",
)  # fmt: skip

OF_WORKBENCH = (
    pytest.mark.slow,
    pytest.mark.skipif(
        find_spec("websockets") is None, reason='needs the workbench: pip install "slipwise[workbench]"'
    ),
)
pytestmark = pytest.mark.skipif(not SLIPWISE.exists(), reason="the console script is not installed beside this Python")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Lend a campaign among twins of modules; its results can be drawn, its recording cannot be shown."""
    with resources.as_file(resources.files("slipwise") / "demo_data") as data:
        shutil.copytree(data, tmp_path / "campaign")
    (tmp_path / "campaign" / "truth.json").write_text('{"missing": ["run_in"]}')
    (tmp_path / "campaign" / "a.rrd").write_bytes(b"no recording")
    (tmp_path / "campaign" / "drafted").mkdir()
    shutil.copy(tmp_path / "campaign" / "quake_h.parquet", tmp_path / "campaign" / "drafted")
    for name in TWINS:
        (tmp_path / "campaign" / f"{name}.py").write_text(TWIN)
    # what matplotlib reads from the current folder must not choose a program or a module
    (tmp_path / "campaign" / "matplotlibrc").write_text("backend: module://rerun_cli\ntext.usetex: True\n")
    return tmp_path / "campaign"


def run(words: str, folder: Path) -> tuple[int, str]:
    """Run a command there; one that serves until it is told to end is told when its processes have begun."""
    environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "DISPLAY")}
    process = subprocess.Popen(
        [SLIPWISE, *words.split()],
        cwd=folder,
        env=environment,
        text=True,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    if words.startswith("workbench"):
        assert process.stdout is not None
        address = re.search(r"http\S+", process.stdout.readline())
        assert address, "the workbench said no address"
        look_until_processes_work(process.pid, address[0])
        process.send_signal(signal.SIGTERM)
    said = process.communicate(timeout=600)[0]
    return process.returncode, said


def look_until_processes_work(number: int, address: str) -> None:
    """Be a page of a workbench, which starts its processes for one, until they have imported what they need."""
    from websockets.sync.client import connect

    with connect(address.replace("http", "ws", 1) + "socket", max_size=None) as page:
        until = time.monotonic() + 120.0
        while len(children(number)) < 2:
            assert time.monotonic() < until, "a page was there, and the workbench started no process"
            with suppress(TimeoutError):
                page.recv(timeout=0.2)
        time.sleep(3.0)


def children(number: int) -> list[str]:
    return [
        child for task in Path(f"/proc/{number}/task").iterdir() for child in (task / "children").read_text().split()
    ]


def were_run(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.rglob("*.was_run"))


def test_a_twin_tells_that_it_was_run(folder: Path) -> None:
    # the error is kept from being printed, for which Python 3.13 would import more twins
    quiet = "try:\n    import json\nexcept ImportError:\n    pass"
    subprocess.run([sys.executable, "-c", quiet], cwd=folder, capture_output=True)
    assert were_run(folder) == ["json.py.was_run"]


@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="looks for processes in /proc")
@pytest.mark.parametrize("words", [*STARTING[:2], pytest.param(STARTING[2], marks=OF_WORKBENCH)])
def test_a_command_that_starts_processes_runs_no_module_of_the_current_folder(folder: Path, words: str) -> None:
    code, said = run(words, folder)
    assert were_run(folder) == []
    assert "Traceback" not in said and code == {"ens": 0, "vie": 2, "wor": 143}[words[:3]], said


def test_python_m_runs_no_module_of_the_current_folder_beside_those_that_start_it(folder: Path) -> None:
    # without -P Python looks here for slipwise itself, and for warnings and contextlib, before anything of ours is run
    (folder / "slipwise.py").unlink()
    (folder / "typing.py").write_text(TWIN)
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    command = [sys.executable, "-m", "slipwise", "channels"]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    assert were_run(folder) == [] and done.returncode == 0, done.stderr


@pytest.mark.long
def test_no_command_runs_a_module_of_the_current_folder(folder: Path) -> None:
    ended = {words: run(words, folder) for words in OTHERS}
    assert were_run(folder) == []
    assert {words: said for words, (code, said) in ended.items() if code or "Traceback" in said} == {}
