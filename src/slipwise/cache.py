"""The folders of what can be made again: compiled laws, the list of units."""

import os
import stat
import tempfile
from pathlib import Path


def cache_folder() -> Path:
    """Give the folder; SLIPWISE_CACHE overrides it. It may not exist yet, or be one that cannot be written."""
    chosen = os.environ.get("SLIPWISE_CACHE")
    if chosen:
        return Path(chosen)
    caches = os.environ.get("XDG_CACHE_HOME")
    try:
        return (Path(caches) if caches else Path.home() / ".cache") / "slipwise"
    except RuntimeError:  # a user without a home, as in some containers
        return Path(tempfile.gettempdir()) / _own_name()


def spare_folder() -> Path | None:
    """Make a folder among the temporary files for what the cache cannot take; it serves the next processes too.

    Returns:
        The folder, or None where there is none that is this user's alone: code from it is run.
    """
    try:
        folder = Path(tempfile.gettempdir()) / _own_name()
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
    except OSError:
        return None
    if not hasattr(os, "getuid"):  # Windows: temporary files are each user's own
        return folder
    private = stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and not found.st_mode & 0o077
    return folder if private else None


def _own_name() -> str:
    return f"slipwise-{os.getuid()}" if hasattr(os, "getuid") else "slipwise-cache"
