"""Files that are there whole or not at all: written beside their place, moved when everything is on the disk.

A process that is killed leaves the hidden file that it was writing; who next writes the file beside it takes that away.
"""

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from glob import escape
from pathlib import Path
from typing import IO, Any

from slipwise.errors import cannot_write

if sys.platform == "win32":

    def _is_free(handle: int) -> bool:
        return False
else:
    import fcntl

    def _is_free(handle: int) -> bool:
        """Take a file's lock, which its writer holds for as long as it lives; two threads of a process are two."""
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:  # it is held, or this disk knows no locks
            return False
        return True


@contextmanager
def atomic(path: Path, mode: str = "wb", *, private: bool = False) -> Iterator[IO[Any]]:
    """Open a file that appears under its name only when everything is written; its folder is made.

    Args:
        path: of the file.
        mode: as for `open`.
        private: let no other user read it, whatever the umask says.

    Raises:
        OutputError: the disk or its owner does not allow it; what stood there before still stands there.
    """
    try:
        with written_beside(path, mode, private=private) as stream:
            yield stream
    except OSError as error:
        raise cannot_write(path, error) from error


@contextmanager
def written_beside(path: Path, mode: str = "wb", *, private: bool = False) -> Iterator[IO[Any]]:
    """Open a file that appears under its name only when everything is written.

    Args:
        path: of the file.
        mode: as for `open`.
        private: let no other user read it, whatever the umask says.

    Raises:
        OSError: as the system says it.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    _take_away_left_behind(path)
    handle, name = _begun(path)
    try:
        with os.fdopen(handle, mode, encoding=None if "b" in mode else "utf-8") as stream:
            yield stream
        if not private:  # as a temporary file is by itself
            umask = os.umask(0)
            os.umask(umask)
            os.chmod(name, 0o666 & ~umask)
        os.replace(name, path)
    except BaseException:  # an interruption too: nothing half-written stays
        Path(name).unlink(missing_ok=True)
        raise


def _begun(path: Path) -> tuple[int, str]:
    """Return the handle and name of a new hidden file beside a path, locked if the disk knows locks."""
    while True:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        _is_free(handle)
        if sys.platform == "win32" or os.fstat(handle).st_nlink:
            return handle, name
        os.close(handle)  # somebody took it for one left behind, before it was locked


def _take_away_left_behind(path: Path) -> None:
    """Remove hidden files of a path whose writers were killed; what cannot be removed stays."""
    for left in path.parent.glob(f".{escape(path.name)}.????????"):
        with suppress(OSError):
            if not left.is_file():  # a pipe would be waited for
                continue
            with left.open("rb") as stream:
                if _is_free(stream.fileno()):
                    left.unlink()
