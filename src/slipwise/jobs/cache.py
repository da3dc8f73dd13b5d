"""The folders of what is kept for a user: compiled code and the list of units, which are run as code, and sessions.

So nothing is read from a folder before it is known to be this user's alone: made by this user, closed to everybody
else, and in a place where nobody else can put another folder under its name.
"""

import os
import shutil
import stat
import tempfile
import warnings
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache
from pathlib import Path

from slipwise.errors import CacheWarning, OutputError

#: Within the folder of this user's caches, and within that of the temporary files.
_CODE, _SESSIONS = "code", "sessions"
#: On Windows homes and temporary files are each user's own.
_HAS_OWNERS = hasattr(os, "getuid")
#: Where temporary files are when nobody says otherwise. Python's last choice is the current folder: a stranger's folder
#: can hold one of the name that is made here.
_TEMPORARY = ("/tmp", "/var/tmp", "/usr/tmp")
_MEMORY = "/dev/shm"


def sessions_folder() -> Path:
    """Make the folder for sessions of campaigns that cannot be written to; SLIPWISE_CACHE overrides it.

    Raises:
        OutputError: no place is this user's alone.
    """
    places = [base / _SESSIONS for base in _bases()]
    reasons = [_why_not(place, lambda folder: folder.chmod(0o700)) if _HAS_OWNERS else "" for place in places]
    usable = [place for place, reason in zip(places, reasons, strict=True) if not reason]
    if usable:
        return usable[0]
    why = f"{places[0]}: no session is kept there, for {reasons[0]}" if places else "there is no place for a session"
    raise OutputError(f"{why}; SLIPWISE_CACHE=FOLDER names another place")


def code_folders() -> list[Path]:
    """Make the folders in which code may be kept, the first one first.

    Returns:
        Those that are this user's alone; none where there is no such place. A `CacheWarning` says once what cannot be
        used.
    """
    if not _HAS_OWNERS:
        return [base / _CODE for base in _bases()]
    usable, refused = [], []
    for base in _bases():
        reason = _why_not(base / _CODE, _make_anew)
        if reason:
            refused.append(f"{base / _CODE}: compiled code is not kept there, for {reason}")
        else:
            usable.append(base / _CODE)
    if refused or not usable:
        first = refused[0] if refused else "there is neither a home nor a folder for temporary files to keep code in"
        elsewhere = f"it is kept in {usable[0]}" if usable else "every command compiles it again, which takes longer"
        tell_once(f"{first}; {elsewhere}. SLIPWISE_CACHE=FOLDER names another place")
    return usable


def own_file(path: Path) -> bytes | None:
    """Read a file of a folder that `code_folders` gives.

    Returns:
        Its content; None where there is none. What is no file, or is somebody else's, is taken away.

    Raises:
        OSError: it cannot be read, or not be taken away.
    """
    try:
        found = path.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return None
    if _is_foreign(found):
        tell_once(f"{path} is somebody else's: it is not used, and is made anew")
    elif stat.S_ISREG(found.st_mode):
        return path.read_bytes()
    remove(path)
    return None


def remove(path: Path) -> None:
    """Remove a file, a link or a folder, if it is there.

    Raises:
        OSError: it cannot be removed.
    """
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


@cache
def tell_once(words: str) -> None:
    """Say something about what is kept, once in a process."""
    warnings.warn(words, CacheWarning, stacklevel=2)


def _bases() -> Iterator[Path]:
    """Yield the folders in which caches may be, the first one first; a relative path would lead into a stranger's."""
    chosen, caches = os.environ.get("SLIPWISE_CACHE"), os.environ.get("XDG_CACHE_HOME")
    if chosen and Path(chosen).is_absolute():
        yield Path(chosen)
    elif caches and Path(caches).is_absolute():
        yield Path(caches) / "slipwise"
    else:
        with suppress(RuntimeError):  # a user without a home, as in some containers
            home = Path.home()
            if home.is_absolute():
                yield home / ".cache" / "slipwise"
    yield from (folder / _own_name() for folder in _temporary())


def _temporary() -> Iterator[Path]:
    """Yield the folder for temporary files, or the memory that is one where no disk can be written to."""
    with suppress(FileNotFoundError):  # none can be
        temporary = tempfile.gettempdir()
        given = [os.environ.get(name) for name in ("TMPDIR", "TEMP", "TMP")]
        if Path(temporary) != Path.cwd() or temporary in (*_TEMPORARY, *given):
            yield Path(temporary)
            return
    if os.access(_MEMORY, os.W_OK):
        yield Path(_MEMORY)


def _own_name() -> str:
    return f"slipwise-{os.getuid()}" if _HAS_OWNERS else "slipwise-cache"


def _why_not(folder: Path, close: Callable[[Path], None]) -> str:
    """Make a folder that is this user's alone; say why what is in it would not be safe, or nothing.

    Args:
        folder: to be made.
        close: takes the folder from others, where they had access to it.
    """
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not folder.is_symlink() and not _is_foreign(folder.lstat()) and folder.lstat().st_mode & 0o077:
            close(folder)
        found = folder.lstat()
        if not stat.S_ISDIR(found.st_mode) or _is_foreign(found):
            return "it is somebody else's, or a link"
        if found.st_mode & 0o077:
            return "others have access to it"
        return next(filter(None, map(_why_not_within, {*folder.parents, *folder.resolve().parents})), "")
    except OSError as error:
        return f"it cannot be made there ({error.strerror})"


def _make_anew(folder: Path) -> None:
    """Make a folder again without what is in it: others may have put it there."""
    remove(folder)
    folder.mkdir(mode=0o700)


def _why_not_within(folder: Path) -> str:
    """Say who else can put another folder into the place of one in this folder, or nothing."""
    found = folder.stat()
    if found.st_uid not in {os.getuid(), 0, _overflow_user()}:
        return f"{folder} is somebody else's"
    by_group = found.st_mode & stat.S_IWGRP and found.st_gid != os.getegid()
    if (by_group or found.st_mode & stat.S_IWOTH) and not found.st_mode & stat.S_ISVTX:
        return f"others can write to {folder}"
    return ""


def _is_foreign(found: os.stat_result) -> bool:
    return _HAS_OWNERS and found.st_uid != os.getuid()


@cache
def _overflow_user() -> int:
    """Return the number that stands for users of whom this container knows nothing, as of the system's own folders."""
    try:
        return int(Path("/proc/sys/kernel/overflowuid").read_text(encoding="ascii"))
    except (OSError, ValueError):
        return 0
