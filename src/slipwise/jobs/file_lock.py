"""A lock between processes: of those that want the same work done, one does it and the others wait.

The system itself gives the lock back when its holder ends, however it ends.
"""

import os
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

if sys.platform == "win32":
    import msvcrt

    def _take(handle: int) -> None:
        msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
else:
    import fcntl

    def _take(handle: int) -> None:
        # Not `flock`: a child that is forked in the meantime would hold that one too.
        fcntl.lockf(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)


#: Time between two tries [s], and the time after which one who waits should know why [s].
_PAUSE, _LONG = 0.05, 1.0


@contextmanager
def one_at_a_time(paths: Sequence[Path], patience: float, waiting: Callable[[], None]) -> Iterator[None]:
    """Hold the lock of a name; where it cannot be had, go on without it: work is then done twice, and not wrongly.

    Args:
        paths: where the lock's file may be; it is made in the first folder that takes it, for as long as it is held.
        patience: time after which one who waits goes on without the lock [s].
        waiting: called once if it takes more than a moment.
    """
    found = next(_opened(paths), None)
    if found is None:
        yield
        return
    handle, path = found
    try:
        held = _wait(handle, patience, waiting)
        try:
            yield
        finally:
            if held:
                with suppress(OSError):  # Windows removes no file that another one has open
                    path.unlink()
    finally:
        os.close(handle)


def _opened(paths: Sequence[Path]) -> Iterator[tuple[int, Path]]:
    for path in paths:
        with suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            yield os.open(path, os.O_CREAT | os.O_RDWR, 0o600), path


def _wait(handle: int, patience: float, waiting: Callable[[], None]) -> bool:
    """Try until the lock is had; tell whether it is."""
    began, told = time.monotonic(), False
    while (gone := time.monotonic() - began) < patience:
        try:
            _take(handle)
            return True
        except (BlockingIOError, PermissionError):
            if gone > _LONG and not told:
                waiting()
                told = True
            time.sleep(_PAUSE)
        except OSError:  # a disk that knows no locks
            return False
    return False
