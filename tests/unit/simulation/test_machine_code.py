"""No fault of the disk on which machine code is kept reaches a result, and two processes do not do the same work."""

import os
import shutil
import subprocess
import sys
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from slipwise.cache import spare_folder
from slipwise.errors import CacheWarning
from slipwise.simulation.kernel import machine_code

#: A law that prints its answer, and how often it was compiled.
LAW = """
from slipwise.simulation.kernel.machine_code import kept
compiled = []
@kept()
def law(x):
    return 2.0 * x
numba = law._compiler.compile
law._compiler.compile = lambda *types: (compiled.append(types), numba(*types))[1]
print(law(21.0), len(compiled))
"""
Run = Callable[[], tuple[float, int, list[str]]]


def twice(x: float) -> float:
    return 2.0 * x


@pytest.fixture
def cache(tmp_path: Path) -> Path:
    return tmp_path / "cache"


@pytest.fixture
def run(cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run a law as a new process would; gives its answer, how often it was compiled, and what was warned of."""
    (tmp_path / "temporary").mkdir()
    monkeypatch.setenv("SLIPWISE_CACHE", str(cache))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))

    def result() -> tuple[float, int, list[str]]:
        machine_code._tell.cache_clear()
        law = machine_code.kept()(twice)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            answer = law(21.0)
        return answer, sum(law.stats.cache_misses.values()), [str(each.message) for each in said]

    return result


@pytest.fixture
def small_disk(cache: Path) -> Iterator[Path]:
    cache.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(cache)], capture_output=True)
    if mounted.returncode:
        pytest.skip(f"a small disk needs root: {mounted.stderr.decode().strip()}")
    yield cache
    subprocess.run(["umount", str(cache)], check=True)


@pytest.fixture
def full_disk(small_disk: Path) -> Path:
    with pytest.raises(OSError, match="No space"), (small_disk / "filled").open("wb", buffering=0) as stream:
        while True:
            stream.write(bytes(1024))
    return small_disk


def files(folder: Path) -> list[Path]:
    return [path for path in folder.rglob("*") if path.is_file()]


def test_what_one_process_compiles_the_next_one_loads(run: Run, cache: Path) -> None:
    assert run() == (42.0, 1, [])
    assert run() == (42.0, 0, [])
    assert [path.suffix for path in files(cache)] == [".code"]


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:100])


def emptied(path: Path) -> None:
    path.write_bytes(b"")


def one_bit_turned(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)


def garbled(path: Path) -> None:
    path.write_bytes(os.urandom(5000))


def made_a_folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


@pytest.mark.parametrize("damage", [cut, emptied, one_bit_turned, garbled])
def test_a_damaged_file_is_thrown_away_and_made_again_and_said_once(run: Run, cache: Path, damage: Callable) -> None:
    run()
    damage(files(cache)[0])
    answer, compiled, said = run()
    assert (answer, compiled) == (42.0, 1)
    assert len(said) == 1 and "damaged" in said[0] and str(cache) in said[0]
    assert run() == (42.0, 0, [])


def test_a_file_that_cannot_be_read_is_made_again_elsewhere(run: Run, cache: Path) -> None:
    run()
    made_a_folder(files(cache)[0])
    assert run()[:2] == (42.0, 1)
    assert run()[:2] == (42.0, 0)


def test_on_a_full_disk_machine_code_goes_elsewhere_for_the_next_process_too(run: Run, full_disk: Path) -> None:
    answer, compiled, said = run()
    assert (answer, compiled) == (42.0, 1)
    assert len(said) == 1 and "No space left" in said[0] and "instead" in said[0]
    assert run() == (42.0, 0, [])
    assert [path.name for path in files(full_disk)] == ["filled"]


def test_a_folder_that_cannot_be_made_stops_nothing(run: Run, cache: Path) -> None:
    cache.write_text("a file")
    answer, compiled, said = run()
    assert (answer, compiled) == (42.0, 1) and len(said) == 1 and "instead" in said[0]
    assert run() == (42.0, 0, [])


def test_a_disk_that_is_only_read_serves_all_the_same_and_what_it_lacks_goes_elsewhere(
    run: Run, small_disk: Path
) -> None:
    subprocess.run(["mount", "-o", "remount,ro", str(small_disk)], check=True)
    answer, compiled, said = run()
    assert (answer, compiled, len(said)) == (42.0, 1, 1) and "Read-only" in said[0]
    assert run() == (42.0, 0, [])
    subprocess.run(["mount", "-o", "remount,rw", str(small_disk)], check=True)
    shutil.copytree(spare_folder() or "", small_disk, dirs_exist_ok=True)
    shutil.rmtree(spare_folder() or "")
    subprocess.run(["mount", "-o", "remount,ro", str(small_disk)], check=True)
    assert run() == (42.0, 0, [])


def test_two_cold_processes_compile_once(cache: Path, tmp_path: Path) -> None:
    """The law of this test takes two seconds to compile, and the processes start together."""
    slow = LAW.replace("numba(*types))[1]", "__import__('time').sleep(2.0), numba(*types))[2]")
    (tmp_path / "law.py").write_text(slow)
    environment = {**os.environ, "SLIPWISE_CACHE": str(cache)}
    command = [sys.executable, str(tmp_path / "law.py")]
    pair = [
        subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for _ in range(2)
    ]
    ended = [process.communicate() for process in pair]
    assert sorted(out.strip() for out, _ in ended) == ["42.0 0", "42.0 1"]
    assert sorted(said.count("Warning: another process compiles the law") for _, said in ended) == [0, 1]
    assert [path.suffix for path in files(cache)] == [".code"]


def test_a_process_that_was_killed_while_it_compiled_blocks_nobody(cache: Path, tmp_path: Path) -> None:
    law, slow = tmp_path / "law.py", tmp_path / "slow.py"
    law.write_text(LAW)
    slow.write_text(
        LAW.replace("(compiled.append(types)", "(print('begun', flush=True), __import__('time').sleep(600)")
    )
    environment = {**os.environ, "SLIPWISE_CACHE": str(cache)}
    process = subprocess.Popen([sys.executable, str(slow)], env=environment, stdout=subprocess.PIPE)
    assert process.stdout is not None and process.stdout.readline() == b"begun\n"
    assert [path.suffix for path in files(cache)] == [".lock"]
    process.kill()
    process.communicate()
    done = subprocess.run([sys.executable, str(law)], env=environment, capture_output=True, timeout=60, check=True)
    assert done.stdout == b"42.0 1\n" and done.stderr == b""
    assert [path.suffix for path in files(cache)] == [".code"]


def test_a_law_that_cannot_be_compiled_holds_no_lock(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SLIPWISE_CACHE", str(cache))

    @machine_code.kept()
    def wrong(x: float) -> float:
        return x.nothing  # type: ignore[attr-defined]

    with pytest.raises(Exception, match="nothing"):
        wrong(1.0)
    assert files(cache) == []


def test_a_spare_folder_is_nobody_elses(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What lies in it is run: in a folder that others can write to they could put what they like."""
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    folder = spare_folder()
    assert folder is not None and folder.is_dir()
    folder.chmod(0o777)
    assert spare_folder() is None
    folder.rmdir()
    folder.symlink_to(tmp_path)
    assert spare_folder() is None


def test_what_is_said_is_a_warning_of_its_own_kind() -> None:
    machine_code._tell.cache_clear()
    with pytest.warns(CacheWarning, match="once"):
        machine_code._tell("said once")
