"""No fault of the disk on which machine code is kept reaches a result, and two processes do not do the same work."""

import importlib
import os
import shutil
import subprocess
import sys
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

import numba
import pytest
from numba import cfunc, njit
from numba.core.caching import NullCache

from slipwise.errors import CacheWarning
from slipwise.jobs import machine_code
from slipwise.jobs.cache import code_folders, tell_once

#: A law, and a program that prints its answer and how often it was compiled.
PLAIN = "def plain(x):\n    return 2.0 * x\n"
LAW = """
from plain import plain
from slipwise.jobs.machine_code import kept
compiled = []
law = kept()(plain)
numba = law._compiler.compile
law._compiler.compile = lambda *types: (compiled.append(types), numba(*types))[1]
print(law(21.0), len(compiled))
"""
Run = Callable[[], tuple[float, int, list[str]]]


def twice(x: float) -> float:
    return 2.0 * x


def test_numba_has_the_private_names_on_which_kept_code_rests() -> None:
    compiled, callback = njit(twice), cfunc("float64(float64)")(twice)
    compiled(1.0)
    (result,) = compiled.overloads.values()
    needed = [
        (compiled, "_cache compile"),
        (callback, "_cache compile"),
        (result, "_reduce _rebuild library"),
        (result.library, "has_dynamic_globals codegen"),
        (result.library.codegen, "magic_tuple"),
        (result.target_context, "refresh codegen"),
        (NullCache(), "load_overload save_overload"),
    ]
    gone = [
        f"{type(owner).__name__}.{name}"
        for owner, names in needed
        for name in names.split()
        if not hasattr(owner, name)
    ]
    assert not gone, f"numba {numba.__version__} lacks {gone}: bound it in pyproject.toml, or adapt machine_code.py"


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
        tell_once.cache_clear()
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
def test_a_damaged_file_is_thrown_away_and_made_again_without_a_word(run: Run, cache: Path, damage: Callable) -> None:
    run()
    damage(files(cache)[0])
    assert run() == (42.0, 1, [])
    assert run() == (42.0, 0, [])


def test_a_file_of_somebody_else_is_not_used_and_made_again_and_said(run: Run, cache: Path) -> None:
    run()
    try:
        os.chown(files(cache)[0], 12345, 12345)
    except PermissionError:
        pytest.skip("only root can give a file away")
    answer, compiled, said = run()
    assert (answer, compiled, len(said)) == (42.0, 1, 1) and "is somebody else's" in said[0]
    assert run() == (42.0, 0, [])


def test_a_folder_of_somebody_else_is_not_used(run: Run, cache: Path) -> None:
    run()
    try:
        os.chown(cache / "code", 12345, 12345)
    except PermissionError:
        pytest.skip("only root can give a folder away")
    answer, compiled, said = run()
    assert (answer, compiled, len(said)) == (42.0, 1, 1)
    assert str(cache / "code") in said[0] and "somebody else's" in said[0] and "it is kept in" in said[0]


def test_a_folder_that_others_could_write_to_is_emptied_and_closed(run: Run, cache: Path) -> None:
    run()
    (cache / "code").chmod(0o777)
    assert run() == (42.0, 1, [])
    assert (cache / "code").stat().st_mode & 0o777 == 0o700


def test_a_place_in_which_others_can_exchange_folders_is_not_used(run: Run, cache: Path) -> None:
    run()
    cache.chmod(0o777)
    answer, compiled, said = run()
    assert (answer, compiled, len(said)) == (42.0, 1, 1) and f"others can write to {cache}" in said[0]


def test_where_nothing_can_be_kept_code_is_compiled_in_memory_and_one_line_says_so(
    run: Run, cache: Path, tmp_path: Path
) -> None:
    cache.write_text("a file")
    (tmp_path / "temporary").rmdir()
    (tmp_path / "temporary").write_text("a file")
    for _ in range(2):
        answer, compiled, said = run()
        assert (answer, compiled, len(said)) == (42.0, 1, 1) and "every command compiles it again" in said[0]


@pytest.mark.parametrize("home", ["", "~", "somewhere"])
def test_no_cache_is_in_the_current_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, home: str) -> None:
    """A stranger's folder can hold what looks like a cache of this user."""
    for name in ("SLIPWISE_CACHE", "XDG_CACHE_HOME", "HOME"):
        monkeypatch.setenv(name, home)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.delenv("TMPDIR", raising=False)
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", CacheWarning)
        assert not [folder for folder in code_folders() if folder.is_relative_to(tmp_path)]
    assert not list(tmp_path.iterdir())


def test_a_function_is_known_by_the_text_of_all_that_is_compiled_into_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr("sys.dont_write_bytecode", True)

    def key(called: str, constant: str) -> str:
        (tmp_path / "called.py").write_text(f"FACTOR = {constant}\ndef inner(x):\n    return {called}\n")
        (tmp_path / "calling.py").write_text(
            "from called import FACTOR, inner\ndef outer(x):\n    return FACTOR * inner(x)\n"
        )
        for name in ("called", "calling"):
            sys.modules.pop(name, None)
        importlib.invalidate_caches()
        machine_code._hash_of.cache_clear()
        return machine_code.content_key(importlib.import_module("calling").outer)

    assert key("x", "2.0") == key("x", "2.0")
    assert len({key("x", "2.0"), key("x + 1", "2.0"), key("x", "3.0")}) == 3


def test_a_folder_in_the_place_of_a_file_is_replaced(run: Run, cache: Path) -> None:
    run()
    made_a_folder(files(cache)[0])
    assert run() == (42.0, 1, [])
    assert run() == (42.0, 0, [])


def test_on_a_full_disk_machine_code_goes_elsewhere_for_the_next_process_too(run: Run, full_disk: Path) -> None:
    answer, compiled, said = run()
    assert (answer, compiled) == (42.0, 1)
    assert len(said) == 1 and "No space left" in said[0] and "instead" in said[0]
    assert run() == (42.0, 0, [])
    assert [path.name for path in files(full_disk)] == ["filled"]


def test_a_folder_that_cannot_be_made_stops_nothing(run: Run, cache: Path) -> None:
    cache.write_text("a file")
    answer, compiled, said = run()
    assert (answer, compiled) == (42.0, 1) and len(said) == 1 and "it is kept in" in said[0]
    assert run()[:2] == (42.0, 0)


def test_a_disk_that_is_only_read_serves_all_the_same_and_what_it_lacks_goes_elsewhere(
    run: Run, small_disk: Path, tmp_path: Path
) -> None:
    subprocess.run(["mount", "-o", "remount,ro", str(small_disk)], check=True)
    answer, compiled, said = run()
    assert (answer, compiled, len(said)) == (42.0, 1, 1) and "Read-only" in said[0]
    assert run()[:2] == (42.0, 0)
    subprocess.run(["mount", "-o", "remount,rw", str(small_disk)], check=True)
    spare = tmp_path / "temporary" / f"slipwise-{os.getuid()}"
    shutil.copytree(spare, small_disk, dirs_exist_ok=True)
    shutil.rmtree(spare)
    subprocess.run(["mount", "-o", "remount,ro", str(small_disk)], check=True)
    assert run() == (42.0, 0, [])


def test_two_cold_processes_compile_once(cache: Path, tmp_path: Path) -> None:
    """The law of this test takes two seconds to compile, and the processes start together."""
    slow = LAW.replace("numba(*types))[1]", "__import__('time').sleep(2.0), numba(*types))[2]")
    (tmp_path / "plain.py").write_text(PLAIN)
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
    (tmp_path / "plain.py").write_text(PLAIN)
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


def test_what_is_said_is_a_warning_of_its_own_kind() -> None:
    tell_once.cache_clear()
    with pytest.warns(CacheWarning, match="once"):
        tell_once("said once")


@pytest.mark.parametrize("damage", [cut, emptied, one_bit_turned, garbled, made_a_folder])
def test_a_damaged_list_of_units_is_made_again_without_a_word(cache: Path, damage: Callable) -> None:
    environment = {**os.environ, "SLIPWISE_CACHE": str(cache)}
    command = [sys.executable, "-c", "from slipwise.units import parse_unit; print(parse_unit('kN', 'N', 'force'))"]

    def run() -> tuple[bytes, bytes]:
        done = subprocess.run(command, env=environment, capture_output=True, check=True)
        return done.stdout, done.stderr

    assert run() == (b"1000.0\n", b"")
    kept = {path.name: path for path in files(cache)}
    assert any(name.endswith(".pickle") for name in kept)
    for path in kept.values():
        damage(path)
        assert run() == (b"1000.0\n", b"")
        assert path.is_file()
