"""Keeps the law's machine code on disk, and lets no fault of that disk reach a result.

numba's own cache trusts its files: one that is cut off, or a disk that is full, stopped every command. Here each
function is one file that begins with its checksum. What does not agree with it is thrown away and compiled again; what
the cache cannot take goes to a spare folder; of processes that lack the same function one compiles it.
"""

import hashlib
import pickle
import warnings
from collections.abc import Callable
from contextlib import ExitStack, suppress
from functools import cache
from pathlib import Path
from typing import Any

from numba import njit
from numba.core.caching import NullCache
from numba.core.ccallback import CFunc
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps
from numba.core.sigutils import normalize_signature

from slipwise.cache import cache_folder, spare_folder
from slipwise.errors import CacheWarning
from slipwise.one_at_a_time import one_at_a_time
from slipwise.whole_file import written_beside

#: A process that waits for another one's machine code compiles it itself after this time [s]: five times what the
#: longest function takes on a slow core; assumed.
_PATIENCE = 120.0
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
        self._name = f"{function.__module__}/{function.__name__}"
        self._alone = ExitStack()

    def by_one_process(self, compile: Callable[..., Any]) -> Callable[..., Any]:
        """Let go of the lock that `load_overload` takes when numba has compiled and saved, or has failed to."""

        def compiled(*arguments: Any) -> Any:
            with self._alone:
                return compile(*arguments)

        return compiled

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Give what is kept, or None: then numba compiles, and no other process does so meanwhile."""
        target_context.refresh()
        name = self._file(sig, target_context.codegen())
        found = _read(name, target_context)
        if found is None:
            locks = [folder / f"{name}.lock" for folder in _folders()]
            self._alone.enter_context(one_at_a_time(locks, _PATIENCE, _tell_of_waiting))
            found = _read(name, target_context)
        return found

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep what numba has compiled, in the first folder that takes it."""
        if data.library.has_dynamic_globals:  # addresses of this process
            return
        code = dumps(data._reduce())
        name = self._file(sig, data.codegen)
        folders = _folders()
        for place, folder in enumerate(folders):
            path = folder / name
            try:
                _remove_torn(path)
                with written_beside(path) as stream:
                    stream.write(hashlib.sha256(code).digest())
                    stream.write(code)
            except OSError as error:
                elsewhere = folders[place + 1 :]
                kept = f"it is kept in {elsewhere[0]} instead" if elsewhere else "every command compiles it again"
                _tell(f"{folder}: the compiled law cannot be kept there ({error.strerror}); {kept}")
            else:
                return

    def _file(self, sig: Any, codegen: Any) -> str:
        """Name the file by all that decides its content and is not in the module's name: types and processor."""
        decides = f"{sig} {codegen.magic_tuple()}"
        return f"{self._name}-{hashlib.sha256(decides.encode()).hexdigest()[:16]}.code"


def _folders() -> list[Path]:
    """Give the folders in which machine code may be, the first one first."""
    spare = spare_folder()
    return [cache_folder(), *([spare] if spare is not None else [])]


def _read(name: str, target_context: Any) -> Any:
    """Give the machine code of a file, or None; a file that is damaged is thrown away."""
    for folder in _folders():
        path = folder / name
        try:
            content = path.read_bytes()
        except (FileNotFoundError, NotADirectoryError):
            continue
        except OSError as error:
            _tell(f"{folder}: the compiled law cannot be read there ({error.strerror}) and is compiled again")
            continue
        code = content[_SUM:]
        if hashlib.sha256(code).digest() == content[:_SUM]:
            return CompileResult._rebuild(target_context, *pickle.loads(code))
        _tell(f"{folder}: the compiled law was damaged there and is compiled again")
        with suppress(OSError):
            path.unlink()
    return None


def _remove_torn(path: Path) -> None:
    """Remove what a process that was killed has left of this file."""
    for torn in path.parent.glob(f".{path.name}.*"):
        torn.unlink(missing_ok=True)


@cache
def _tell(words: str) -> None:
    """Say something once in a process."""
    warnings.warn(words, CacheWarning, stacklevel=2)


def _tell_of_waiting() -> None:
    _tell("another process compiles the law: waiting for it, so that the work is not done twice")
