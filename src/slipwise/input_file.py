"""The door for files from outside: devices, pipes where they cannot work, and more than memory holds are refused."""

import math
import os
import stat
from pathlib import Path

from slipwise.errors import InputError

#: A file takes so many times its size while it is read: its bytes, its text, its lines or columns; assumed.
_TIMES = 3
#: What a pipe may hold where the system does not say how much memory is free [bytes].
_LARGEST_PIPE = 2**32
#: Where Linux says how much memory a container may take, and takes [bytes].
_OF_CONTAINER = (
    ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
    ("/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes"),
)


def read_input(path: Path, *, pipe: bool = False) -> bytes:
    """Read a file whole.

    Args:
        path: of the file.
        pipe: it may be a pipe, which is read once, from its begin to its end.

    Raises:
        InputError: no file, or one that memory does not hold.
        OSError: it is not there or cannot be read.
    """
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    with os.fdopen(handle, "rb") as stream:
        found = os.fstat(handle)
        if not (pipe and stat.S_ISFIFO(found.st_mode)):
            _check(path, found)
            return stream.read()
        os.set_blocking(handle, True)
        most = int(min(free_memory() / _TIMES, _LARGEST_PIPE))
        content = stream.read(most + 1)
        if len(content) > most:
            raise InputError(f"{path}: the pipe gives more than {_size(most)}, all that can be read here; give less")
        return content


def check_input(path: Path) -> Path:
    """Refuse what `read_input` refuses, before a library opens it by its name; gives the path.

    Raises:
        InputError: no file, or one that memory does not hold.
        OSError: it is not there.
    """
    _check(path, path.stat())
    return path


def free_memory() -> float:
    """Return memory that this process may still take [bytes]: of the machine, of its container, of its own limit."""
    free = [math.inf]
    for line in _lines("/proc/meminfo"):
        if line.startswith("MemAvailable:"):
            free.append(1024.0 * float(line.split()[1]))
    for largest, taken in _OF_CONTAINER:
        allowed, used = _lines(largest), _lines(taken)
        if allowed and used and allowed[0].isdigit():
            free.append(float(allowed[0]) - float(used[0]))
    taken = _lines("/proc/self/statm")
    if taken:
        import resource  # not every system has it; this one does

        allowed = resource.getrlimit(resource.RLIMIT_AS)[0]
        if allowed != resource.RLIM_INFINITY:
            free.append(allowed - float(taken[0].split()[0]) * resource.getpagesize())
    return max(min(free), 0.0)


def _check(path: Path, found: os.stat_result) -> None:
    if stat.S_ISDIR(found.st_mode):
        raise InputError(f"{path}: this is a folder; give a file")
    if stat.S_ISFIFO(found.st_mode) or stat.S_ISSOCK(found.st_mode):
        raise InputError(f"{path}: this is a pipe, and the file is read more than once; save it as a file, and name it")
    if not stat.S_ISREG(found.st_mode):
        raise InputError(f"{path}: this is a device or a terminal; give a file")
    if found.st_size * _TIMES > (free := free_memory()):
        raise InputError(
            f"{path}: it holds {_size(found.st_size)}, and {_size(free)} of memory are free, of which reading takes "
            f"{_TIMES} times its size; cut it, close other programs, or read it on a larger machine"
        )


def _size(count: float) -> str:
    return f"{count / 1e9:.1f} GB" if count >= 1e9 else f"{count / 1e6:.1f} MB"


def _lines(path: str) -> list[str]:
    try:
        return Path(path).read_text(encoding="ascii").splitlines()
    except (OSError, ValueError):
        return []
