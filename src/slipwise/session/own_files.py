"""Files of a session are their user's alone: plain files in a private folder; no link, pipe or device is opened."""

import os
import stat
from contextlib import suppress
from pathlib import Path

from slipwise.errors import InputError, cannot_write
from slipwise.session.place import is_foreign

#: No file of a session is larger [bytes].
_LARGEST = 250_000_000
_KINDS = (
    (stat.S_ISLNK, "a link"),
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (lambda mode: stat.S_ISCHR(mode) or stat.S_ISBLK(mode), "a device"),
)
#: Follow no link, wait for no writer of a pipe; both are missing on Windows.
_CAREFULLY = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


def make_private(folder: Path) -> Path:
    """Make a folder that only this user may enter, or close one that is there to others; gives it back.

    Raises:
        InputError: a link, a file or another user's folder has its name.
        OutputError: it cannot be made.
    """
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except FileExistsError:  # told below
        pass
    except OSError as error:
        raise cannot_write(folder, error) from error
    mode = folder.lstat().st_mode
    if not stat.S_ISDIR(mode):
        raise InputError(f"{folder} is {_kind(mode)}, and no folder for a session; move it away, then open again")
    if is_foreign(folder):
        raise InputError(f"{folder} belongs to another user, who could read the session; move it away, then open again")
    if stat.S_IMODE(mode) != 0o700:
        with suppress(OSError):  # a disk without permissions
            folder.chmod(0o700)
    return folder


def open_own(path: Path, flags: int) -> int:
    """Open a file of a session and give its descriptor; one that is made is this user's alone.

    Args:
        path: of the file.
        flags: as for `os.open`.

    Raises:
        FileNotFoundError: there is none.
        InputError: it is no plain file, or another user's.
        OSError: as the system says it.
    """
    with suppress(FileNotFoundError):
        _check(path, path.lstat())
    handle = os.open(path, flags | _CAREFULLY, 0o600)
    try:
        found = os.fstat(handle)
        _check(path, found)
        if hasattr(os, "fchmod") and found.st_mode & 0o077:
            with suppress(OSError):  # a disk without permissions
                os.fchmod(handle, 0o600)
    except BaseException:
        os.close(handle)
        raise
    return handle


def read_own(path: Path) -> bytes | None:
    """Read a file of a session; None where there is none.

    Raises:
        InputError: it is no plain file, another user's, too large, or cannot be read.
    """
    try:
        with open(open_own(path, os.O_RDONLY), "rb") as stream:
            size = os.fstat(stream.fileno()).st_size
            if size <= _LARGEST:
                return stream.read()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise InputError(f"{path} cannot be read ({os.strerror(error.errno or 0).lower()})") from None
    raise InputError(f"{path} has {size / 1e6:.0f} MB; no file of a session has more than {_LARGEST / 1e6:.0f}")


def move_aside(path: Path) -> Path:
    """Return a file, or whatever has its name, another name beside: "session-1.json"; gives that path.

    Raises:
        OutputError: it cannot be renamed.
    """
    number = 1
    while os.path.lexists(aside := path.with_name(f"{path.stem}-{number}{path.suffix}")):
        number += 1
    try:
        path.rename(aside)
    except OSError as error:
        raise cannot_write(aside, error) from error
    return aside


def _check(path: Path, found: os.stat_result) -> None:
    if not stat.S_ISREG(found.st_mode):
        raise InputError(f"{path} is {_kind(found.st_mode)}, and no file of a session")
    if hasattr(os, "getuid") and found.st_uid != os.getuid():
        raise InputError(f"{path} belongs to another user")


def _kind(mode: int) -> str:
    return next((words for is_kind, words in _KINDS if is_kind(mode)), "a file")
