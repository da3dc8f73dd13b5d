"""Files from outside: what is no file, or more than memory holds, is refused in a sentence before it is read."""

import os
import threading
from pathlib import Path

import pytest

from slipwise import input_file
from slipwise.data_files.table import open_table
from slipwise.effects import load_effect
from slipwise.errors import InputError
from slipwise.input_file import check_input, free_memory, read_input
from slipwise.motion.source_file import open_source

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs pipes and devices with names")


@pytest.fixture
def pipe(tmp_path: Path) -> Path:
    os.mkfifo(tmp_path / "pipe.csv")
    return tmp_path / "pipe.csv"


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/null", "/dev/tty"])
def test_a_device_is_refused_and_not_read(device: str) -> None:
    if device == "/dev/tty" and not os.access(device, os.R_OK):
        pytest.skip("no terminal")
    for read in (check_input, open_table):
        with pytest.raises(InputError, match="this is a device or a terminal; give a file"):
            read(Path(device))


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/null"])
def test_a_motion_from_a_device_is_refused(device: str) -> None:
    for read in (open_source, load_effect, read_input):
        with pytest.raises(InputError, match="this is a device|an effect is a Python file"):
            read(Path(device))


def test_a_pipe_is_refused_where_a_file_is_read_twice(pipe: Path) -> None:
    for read in (check_input, read_input, open_table):
        with pytest.raises(InputError, match="pipe.csv: this is a pipe, and the file is read more than once"):
            read(pipe)


def test_a_pipe_gives_a_motion(pipe: Path) -> None:
    writer = threading.Thread(target=lambda: pipe.write_text("time [s],table_ax [g]\n0,1\n"))
    writer.start()
    handle = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)  # lets the writer begin, and keeps what it writes
    writer.join()
    source = open_source(pipe)
    os.close(handle)
    assert source.lines[0] == "time [s],table_ax [g]"


def test_a_pipe_that_nobody_fills_keeps_nobody_waiting(pipe: Path) -> None:
    with pytest.raises(InputError, match="the file is empty"):
        open_source(pipe)


def test_a_file_that_memory_does_not_hold_is_refused_with_its_size(tmp_path: Path) -> None:
    path = tmp_path / "large.csv"
    with path.open("wb") as stream:
        stream.truncate(1 << 43)  # it takes no room on the disk
    for read in (check_input, read_input, open_table, open_source):
        with pytest.raises(InputError, match=r"large.csv: it holds 8796.1 GB, and \d+\.\d [GM]B of memory are free"):
            read(path)


def test_a_pipe_that_gives_more_than_memory_holds_is_left(pipe: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(input_file, "free_memory", lambda: 3e3)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    writer = os.open(pipe, os.O_WRONLY)
    os.write(writer, bytes(2000))
    with pytest.raises(InputError, match="the pipe gives more than 0.0 MB"):
        read_input(pipe, pipe=True)
    os.close(writer)
    os.close(reader)


def test_a_folder_is_no_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="this is a folder; give a file"):
        check_input(tmp_path)


def test_free_memory_is_no_more_than_the_machine_has() -> None:
    if not Path("/proc/meminfo").exists():
        pytest.skip("the system does not say it")
    total = 1024.0 * float(Path("/proc/meminfo").read_text().split()[1])
    assert 0.0 < free_memory() <= total
