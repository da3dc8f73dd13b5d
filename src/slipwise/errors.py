"""The one family of errors that a user can cause.

Every message says what was given, what is possible, and what to do. The command line prints it and exits 2.
"""

import errno
import os
import re
from collections.abc import Iterable
from difflib import get_close_matches
from pathlib import Path

#: Characters that steer a terminal, or turn the direction of writing, instead of being seen.
_UNSEEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")

#: What the system says where there is no room: on the disk, in the user's share of it, in the largest file allowed.
FULL = frozenset({errno.ENOSPC, errno.EFBIG, getattr(errno, "EDQUOT", errno.ENOSPC)})


class SlipwiseError(Exception):
    """Base of every error that Slipwise raises on purpose."""


class InputError(SlipwiseError):
    """A file, a motion or a campaign that cannot be used as it is."""


class UnitError(SlipwiseError):
    """A unit that is missing, unknown or of the wrong dimension."""


class UnknownNameError(SlipwiseError):
    """A name that does not exist: the message offers the nearest ones."""


class SettingError(SlipwiseError):
    """A value that is out of bounds, or settings that cannot go together."""


class SimulationError(SlipwiseError):
    """A simulation that left the range in which it means anything."""


class OutputError(SlipwiseError):
    """A file that cannot be written: the disk is full, or is not ours to write to."""


class SlipwiseWarning(UserWarning):
    """Something a user should know although work goes on."""


class CacheWarning(SlipwiseWarning):
    """What is kept to save time could not be used, or not be kept."""


def unknown_name(kind: str, given: str, known: Iterable[str], where: str = "") -> UnknownNameError:
    """Make the error for a name that does not exist.

    Args:
        kind: what the name should have named, e.g. "effect".
        given: what was given.
        known: the names that exist.
        where: what to do to see them all, e.g. "slipwise effects lists them".

    Returns:
        The error, to be raised by the caller.
    """
    names = sorted(known)
    near = get_close_matches(given, names, n=3, cutoff=0.5)
    hint = f"did you mean {' or '.join(near)}?" if near else f"possible: {', '.join(names[:40])}."
    return UnknownNameError(f"no {kind} is called {given!r}: {hint}{' ' + where if where else ''}")


def cannot_write(path: Path | str, error: OSError) -> OutputError:
    """Make the error for a file that cannot be written.

    Args:
        path: of the file.
        error: what the system said.

    Returns:
        The error, to be raised by the caller.
    """
    reason = os.strerror(error.errno) if error.errno else str(error)
    todo = (
        "free some space there, or write to another disk"
        if error.errno in FULL
        else "give a folder that can be written to"
    )
    return OutputError(f"cannot write {path}: {reason[:1].lower()}{reason[1:]}; {todo}. What was finished is kept")


def missing_library(place: object, what: str, library: str, extra: str, instead: str) -> InputError:
    """Make the error for a file whose format is read by a library that is not installed.

    Args:
        place: the file, as messages name it.
        what: the files of that format, e.g. "MDF files".
        library: that reads them.
        extra: of slipwise, that brings the library.
        instead: what can be done without it, e.g. "export the file as CSV".

    Returns:
        The error, to be raised by the caller.
    """
    return InputError(
        f"{place}: {what} are read by {library}; install it with `pip install 'slipwise[{extra}]'`, or {instead}"
    )


def visible(text: str) -> str:
    """Return a text whose control characters are written as escapes: names from files must not steer a terminal."""
    return _UNSEEN.sub(lambda found: found[0].encode("unicode_escape").decode("ascii"), text)
