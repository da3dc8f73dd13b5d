"""A file is there whole or not at all, and one that cannot be written is one sentence."""

import resource
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from slipwise.errors import OutputError
from slipwise.jobs.atomic_write import atomic
from slipwise.record import Record, write_json, write_record
from slipwise.view.figures.canvas import new_figure, save_figure


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """Lend a disk of 200 kB, or a limit on the size of files where none can be mounted."""
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k", "tmpfs", str(tmp_path)], capture_output=True)
    if mounted.returncode:
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, before[1]))
        yield tmp_path
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        return
    yield tmp_path
    subprocess.run(["umount", str(tmp_path)], check=True)


def large_record() -> Record:
    noise = np.random.default_rng(1).normal(size=100_000)
    return Record(np.arange(100_000) * 0.01, {"slip_x": noise})


@pytest.mark.parametrize("name", ["record.parquet", "record.csv"])
def test_a_record_that_finds_no_room_leaves_what_was_there(small_disk: Path, name: str) -> None:
    write_json(small_disk / "summary.json", {"whole": True})
    (small_disk / name).write_text("the one before")
    with pytest.raises(OutputError, match=rf"cannot write .*{name}: (no space left|file too large).*free some space"):
        write_record(large_record(), small_disk / name)
    assert sorted(path.name for path in small_disk.iterdir()) == sorted([name, "summary.json"])
    assert (small_disk / name).read_text() == "the one before"


def test_a_picture_that_finds_no_room_leaves_nothing(small_disk: Path) -> None:
    (small_disk / "filled").write_bytes(bytes(195_000))
    figure = new_figure(10.0, 10.0)
    figure.subplots().plot(np.random.default_rng(1).normal(size=5000))
    with pytest.raises(OutputError, match="loops.png"):
        save_figure(figure, small_disk / "loops.png")
    assert [path.name for path in small_disk.iterdir()] == ["filled"]


def test_a_folder_that_is_a_file_is_said_so(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("a file")
    with pytest.raises(OutputError, match="cannot write .*give a folder that can be written to"):
        write_json(tmp_path / "out" / "summary.json", {})


def test_an_interruption_in_the_middle_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt), atomic(tmp_path / "page.html", "w") as stream:
        stream.write("half")
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == []


def test_what_a_killed_writer_left_is_taken_away_and_what_is_being_written_is_not(tmp_path: Path) -> None:
    words = "import os, sys, pathlib\nfrom slipwise.jobs.atomic_write import atomic\n"
    words += "with atomic(pathlib.Path(sys.argv[1])) as s:"
    writer = [sys.executable, "-c", f"{words}\n s.write(b'half'); s.flush(); os.kill(os.getpid(), 9)"]
    subprocess.run([*writer, str(tmp_path / "a.json")])
    (tmp_path / ".a.json.lock").touch()
    (left,) = tmp_path.glob(".a.json.????????")
    with atomic(tmp_path / "a.json") as first:
        assert not left.exists()
        with atomic(tmp_path / "a.json") as second:
            second.write(b"second")
        first.write(b"first")
    assert sorted(path.name for path in tmp_path.iterdir()) == [".a.json.lock", "a.json"]
    assert (tmp_path / "a.json").read_bytes() == b"first"
