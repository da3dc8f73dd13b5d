"""Keeps compiled functions on disk, and lets no fault of that disk, and nobody else, reach a result.

numba's own cache trusts its files: one that is cut off, a disk that is full or a folder that cannot be written stopped
every command. Here each function is one file that begins with its checksum, in a folder of this user's alone; it is
named by all that decides its content. What does not agree is thrown away and compiled again; what the cache cannot take
goes to a spare folder, or is compiled by each process; of processes that lack the same function one compiles it.

Trap: numba has no public way to do so. Replaced are `_cache` and `compile` of a dispatcher and of a `CFunc`; used are
`CompileResult._reduce` and `_rebuild`, `has_dynamic_globals` of a library and `magic_tuple` of its codegen. Therefore
pyproject.toml bounds numba, and a test names what a version has no more.
"""

import hashlib
import pickle
import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np
from filelock import FileLock, Timeout
from numba import njit
from numba.core.caching import NullCache
from numba.core.ccallback import CFunc
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps
from numba.core.sigutils import normalize_signature

from slipwise.jobs.atomic_write import written_beside
from slipwise.jobs.cache import code_folders, own_file, tell_once

#: A process that waits for another one's machine code compiles it itself after this time [s]: five times what the
#: longest function takes on a slow core; assumed.
_PATIENCE = 120.0
#: A process that waits longer than this says why [s].
_LONG = 1.0
#: Bytes of the checksum with which a file begins.
_SUM = hashlib.sha256().digest_size


def kept(**options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Compile a function with numba's `njit(**options)`, and keep its machine code."""

    def decorate(function: Callable[..., Any]) -> Any:
        law: Any = njit(**options)(function)
        law._cache = code = _MachineCode(function)
        law.compile = code.by_one_process(law.compile)
        return law

    return decorate


def kept_callback(signature: Any) -> Callable[[Callable[..., Any]], Any]:
    """Compile a C callback as numba's `cfunc(signature)`, and keep its machine code."""

    def decorate(function: Callable[..., Any]) -> Any:
        callback: Any = CFunc(function, normalize_signature(signature), locals={}, options={})
        callback._cache = code = _MachineCode(function)
        code.by_one_process(callback.compile)()
        return callback

    return decorate


class _MachineCode(NullCache):
    """What numba asks for the machine code of one function."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self._name = f"{function.__module__}.{function.__name__}"
        self._function = function
        self._alone = ExitStack()

    def by_one_process(self, compile: Callable[..., Any]) -> Callable[..., Any]:
        """Let go of the lock that `load_overload` takes when numba has compiled and saved, or has failed to."""

        def compiled(*arguments: Any) -> Any:
            with self._alone:
                return compile(*arguments)

        return compiled

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return what is kept, or None: then numba compiles, and no other process does so meanwhile."""
        target_context.refresh()
        name = self._file(sig, target_context.codegen())
        found = _read(name, target_context)
        if found is None:
            self._alone.enter_context(_one_process(name))
            found = _read(name, target_context)
        return found

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep what numba has compiled, in the first folder that takes it."""
        if data.library.has_dynamic_globals:  # addresses of this process
            return
        code = dumps(data._reduce())
        name = self._file(sig, data.codegen)
        folders = code_folders()
        for place, folder in enumerate(folders):
            try:
                with written_beside(folder / name) as stream:
                    stream.write(hashlib.sha256(code).digest())
                    stream.write(code)
            except OSError as error:
                elsewhere = folders[place + 1 :]
                kept = f"it is kept in {elsewhere[0]} instead" if elsewhere else "every command compiles it again"
                tell_once(f"{folder}: compiled code cannot be kept there ({error.strerror}); {kept}")
            else:
                return

    def _file(self, sig: Any, codegen: Any) -> str:
        """Name the file by all that decides its content: the text, the types, the versions and the processor."""
        decides = f"{sig} {codegen.magic_tuple()} {_versions()} {content_key(self._function)}"
        return f"{self._name}-{hashlib.sha256(decides.encode()).hexdigest()[:24]}.code"


def content_key(function: Callable[..., Any]) -> str:
    """Return a hash of what is compiled into a function: the files of all functions that it calls, and constants.

    A function without a file is known by the name of its module, whose writer has put a hash of its text there.
    """
    files: set[str] = set()
    constants: list[str] = []
    for name, value in sorted(_compiled_in(function), key=lambda found: found[0]):
        if isinstance(value, FunctionType):
            files.add(value.__code__.co_filename)
        else:
            constants.append(f"{name} {value.tobytes() if isinstance(value, np.ndarray) else value!r}")
    texts = [_hash_of(name) for name in sorted(files)]
    return hashlib.sha256("\n".join([*texts, *constants]).encode()).hexdigest()


def _compiled_in(function: Callable[..., Any]) -> Iterator[tuple[str, Any]]:
    """Yield a function, the functions that it calls and theirs, and the constants that they use, each with its name."""
    seen: set[FunctionType] = set()
    left: list[Any] = [function]
    while left:
        one = left.pop()
        one = getattr(one, "py_func", one)
        if not isinstance(one, FunctionType) or one in seen:
            continue
        seen.add(one)
        yield f"{one.__module__}.{one.__qualname__}", one
        codes = [one.__code__]
        while codes:
            code = codes.pop()
            codes += [const for const in code.co_consts if isinstance(const, type(code))]
            for name in code.co_names:
                value = one.__globals__.get(name)
                if isinstance(value, bool | int | float | complex | str | tuple | np.ndarray):
                    yield f"{one.__module__}.{name}", value
                else:
                    left.append(value)


@cache
def _hash_of(file: str) -> str:
    path = Path(file)
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else file


@cache
def _versions() -> str:
    return " ".join([sys.version, *(version(name) for name in ("numba", "llvmlite", "numpy"))])


def _read(name: str, target_context: Any) -> Any:
    """Return the machine code of a file, or None; a file that is damaged is thrown away."""
    for folder in code_folders():
        path = folder / name
        try:
            content = own_file(path)
        except OSError as error:
            tell_once(f"{folder}: compiled code cannot be read there ({error.strerror}) and is compiled again")
            continue
        if content is None:
            continue
        code = content[_SUM:]
        if hashlib.sha256(code).digest() == content[:_SUM]:
            return CompileResult._rebuild(target_context, *pickle.loads(code))
        with suppress(OSError):
            path.unlink()
    return None


@contextmanager
def _one_process(name: str) -> Iterator[None]:
    """Hold the lock of a function; where none can be had, go on without: work is then done twice, and not wrongly."""
    lock = _lock_of(name)
    try:
        yield
    finally:
        if lock is not None:
            with suppress(OSError):  # Windows removes no file that another one has open
                Path(lock.lock_file).unlink()
            lock.release()


def _lock_of(name: str) -> FileLock | None:
    """Take the lock of a function in the first folder that knows locks; the system gives it back for who is killed."""
    for folder in code_folders():
        lock = FileLock(folder / f"{name}.lock", mode=0o600, fallback_to_soft=False)
        try:
            lock.acquire(timeout=_LONG)
        except Timeout:
            tell_once("another process compiles the law: waiting for it, so that the work is not done twice")
            with suppress(OSError):
                lock.acquire(timeout=_PATIENCE - _LONG)
        except OSError:
            continue
        return lock if lock.is_locked else None
    return None
