"""A command that cannot go on says so in one line, with the exit code that a shell expects, and leaves no rubbish."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from importlib import resources
from pathlib import Path

import pytest

from slipwise.record import read_record

#: Nobody waits so long unless something is wrong [s].
LONG = 240.0
#: A motion whose replay lasts some seconds, and one that lasts as long as the test likes.
SHORT, ENDLESS = "sine:2Hz,0.3g,cycles=12", "sine:2Hz,0.2g,cycles=4000"


def hears() -> None:
    """Hear signals, also where the tests run in the background of a shell: there Ctrl-C is ignored."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def begin(*words: object, **options: object) -> subprocess.Popen[str]:
    """Start the command line in a session of its own, as a terminal does."""
    return subprocess.Popen(
        [sys.executable, "-m", "slipwise", *map(str, words)],
        text=True,
        start_new_session=True,
        preexec_fn=hears,
        **{"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, **options},  # type: ignore[arg-type]
    )


def error_of(process: subprocess.Popen[str]) -> list[str]:
    """Give the lines of a command's error output, but what it says while another test compiles the same law."""
    lines = process.communicate(timeout=LONG)[1].splitlines()
    return [line for line in lines if "another process compiles" not in line]


def nobody_is_left(process: subprocess.Popen[str]) -> bool:
    """Tell whether no child of the command lives; one that is asked to end may take a moment."""
    for _ in range(20):
        if not lives(process.pid):
            return True
        time.sleep(0.1)
    return False


def lives(group: int) -> bool:
    """Tell whether a process of this group runs.

    One that has ended and that the system's first process has not collected yet counts as gone; some of those collect
    every few seconds only.
    """
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):  # it is gone by now
            state, _, of = stat.read_text().rpartition(")")[2].split()[:3]
            if int(of) == group and state != "Z":
                return True
    return not Path("/proc").is_dir()


def rubbish(folder: Path) -> list[Path]:
    return [path for path in folder.rglob("*") if path.name.startswith(".") or ".tmp" in path.name]


@pytest.mark.parametrize("words", ["channels", "channels --json", "--help", "effects", "--version"])
def test_where_nobody_reads_the_output_a_command_ends_well_and_says_nothing(words: str) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    process = begin(*words.split(), stdout=writing)
    os.close(writing)
    assert (error_of(process), process.returncode) == ([], 0)


def test_where_nobody_reads_the_output_the_files_are_written_all_the_same(tmp_path: Path) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    process = begin("replay", SHORT, "--out", tmp_path, "--no-pictures", "--no-recording", stdout=writing)
    os.close(writing)
    assert (error_of(process), process.returncode) == ([], 0)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["record.parquet", "summary.json"]


@pytest.mark.parametrize("closed", ["<&-", ">&-", "2>&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize(
    ("words", "code"), [("channels", 0), ("effects nosuch --json", 2), ("init .", 2), ("--help", 0)]
)
def test_a_stream_that_the_shell_has_closed_is_no_fault(words: str, code: int, closed: str, tmp_path: Path) -> None:
    command = f"{sys.executable} -m slipwise {words} {closed}"
    ended = subprocess.run(["sh", "-c", command], capture_output=True, text=True, cwd=tmp_path)
    assert ended.returncode == code and "Traceback" not in ended.stdout + ended.stderr
    assert not list(tmp_path.iterdir())


def test_an_encoding_without_the_characters_is_no_fault(tmp_path: Path) -> None:
    process = begin("motions", stdout=subprocess.PIPE, env={**os.environ, "PYTHONIOENCODING": "ascii"})
    out, err = process.communicate(timeout=LONG)
    assert (process.returncode, err) == (0, "") and out.isascii()


@pytest.mark.parametrize("words", ["effects nosuch --json", "audit nowhere --json", "compare . --nosuch --json"])
def test_an_error_is_json_too_where_json_was_asked_for(words: str, tmp_path: Path) -> None:
    process = begin(*words.split(), stdout=subprocess.PIPE, cwd=tmp_path)
    out, err = process.communicate(timeout=LONG)
    assert process.returncode == 2
    assert err == f"error: {json.loads(out)['error']}\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize("words", ["channels", "channels --json", "--version"])
def test_an_output_without_room_is_one_line(words: str) -> None:
    with open("/dev/full", "w") as full:
        process = begin(*words.split(), stdout=full)
        [line] = error_of(process)
    assert process.returncode == 2
    assert line.startswith("error: cannot write the output: no space left on device; free some space")


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """Lend a disk that has room for a record and not for the pictures of it."""
    size = ["mount", "-t", "tmpfs", "-o", "size=1500k", "tmpfs", str(tmp_path)]
    mounted = subprocess.run(size, capture_output=True)
    if mounted.returncode:
        pytest.skip(f"a small disk needs root: {mounted.stderr.decode().strip()}")
    yield tmp_path
    subprocess.run(["umount", str(tmp_path)], check=True)


def test_a_disk_that_becomes_full_keeps_what_was_finished(small_disk: Path) -> None:
    process = begin("replay", SHORT, "--out", small_disk)
    lines = error_of(process)
    assert process.returncode == 2 and len(lines) == 1, lines
    [line] = lines
    assert line.startswith(f"error: cannot write {small_disk}") and "no space left on device" in line
    assert len(read_record(small_disk / "record.parquet")) > 1000
    assert not rubbish(small_disk) and nobody_is_left(process)


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGHUP, 129)])
def test_a_replay_that_is_interrupted_says_so_and_leaves_nothing(number: int, code: int, tmp_path: Path) -> None:
    process = begin("replay", ENDLESS, "--out", tmp_path / "out")
    while not (tmp_path / "out").exists() and process.poll() is None:
        time.sleep(0.05)
    time.sleep(1.0)
    os.killpg(process.pid, number)
    assert error_of(process) == [interrupted(number)]
    assert process.returncode == code
    assert list((tmp_path / "out").iterdir()) == [] and nobody_is_left(process)


def test_an_interruption_while_pictures_are_drawn_leaves_none_half_drawn(tmp_path: Path) -> None:
    """Only the command itself hears `kill`: it ends its children, who remove what they have half written."""
    process = begin("replay", SHORT, "--out", tmp_path)
    while not (tmp_path / "record.parquet").exists() and process.poll() is None:
        time.sleep(0.02)
    while not rubbish(tmp_path) and process.poll() is None:
        time.sleep(0.001)
    process.send_signal(signal.SIGTERM)
    assert error_of(process) == [interrupted(signal.SIGTERM)]
    assert process.returncode == 143
    assert not rubbish(tmp_path) and nobody_is_left(process)
    assert len(read_record(tmp_path / "record.parquet")) > 1000


def test_an_interruption_while_the_command_line_is_loaded_is_no_traceback() -> None:
    for wait in (0.1, 0.2, 0.4, 0.8):
        process = begin("channels")
        time.sleep(wait)
        process.send_signal(signal.SIGTERM)
        assert error_of(process) in ([], [interrupted(signal.SIGTERM)])
        assert process.returncode in (0, 143, -signal.SIGTERM)


def test_the_python_engine_can_be_interrupted_too(tmp_path: Path) -> None:
    """Its law runs inside MuJoCo, where an exception of Python is not heard."""
    process = begin("replay", ENDLESS, "--out", tmp_path / "out", "--engine", "python")
    while not (tmp_path / "out").exists() and process.poll() is None:
        time.sleep(0.05)
    time.sleep(3.0)
    process.send_signal(signal.SIGTERM)
    assert error_of(process) == [interrupted(signal.SIGTERM)]
    assert process.returncode == 128 + signal.SIGTERM


@pytest.mark.slow
@pytest.mark.parametrize("words", ["compare", "diagnose", "ladder", "next", "demo", "paper --quick"])
@pytest.mark.parametrize(
    ("number", "wait"), [(signal.SIGINT, 5.5), pytest.param(signal.SIGTERM, 12.0, marks=pytest.mark.long)]
)
def test_long_work_that_is_interrupted_says_so_and_leaves_nothing(
    words: str, wait: float, number: int, tmp_path: Path
) -> None:
    """`kill` reaches the command itself, Ctrl-C its children too."""
    verb, *options = words.split()
    if verb not in ("demo", "paper"):
        options.append(str(resources.files("slipwise") / "demo_data"))
    process = begin(verb, *options, "--out", tmp_path)
    time.sleep(wait)
    assert process.poll() is None, "it was done before it could be interrupted"
    (os.killpg if number == signal.SIGINT else os.kill)(process.pid, number)
    *progress, last = error_of(process)
    assert last == interrupted(number) and all(re.match(r" *\d+ s +\d+ %", line) for line in progress)
    assert process.returncode == 128 + number
    assert not rubbish(tmp_path) and nobody_is_left(process)


def interrupted(number: int) -> str:
    name = signal.Signals(number).name
    return f"interrupted ({name}): finished files are kept, and nothing half-written is left"
