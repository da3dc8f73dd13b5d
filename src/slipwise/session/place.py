"""Where the session of a campaign lies: asked before anything that takes long to load."""

import os
from hashlib import sha256
from pathlib import Path

from slipwise.jobs.cache import sessions_folder

#: Folder of a session beside the files of its campaign.
BESIDE = ".slipwise"


def session_folder(campaign: Path) -> Path:
    """Return folder of a campaign's session: beside its files, or in the cache where this user may write none there.

    Args:
        campaign: folder of the campaign.

    Raises:
        OutputError: neither is a place for it.
    """
    folder = campaign.resolve()
    beside = folder / BESIDE
    if os.access(folder, os.W_OK) and not is_foreign(beside):
        return beside
    return sessions_folder() / f"{folder.name}-{sha256(str(folder).encode()).hexdigest()[:12]}"


def snapshot_file(campaign: Path) -> Path:
    """Return the file that holds every step of it."""
    return session_folder(campaign) / "session.json"


def is_foreign(path: Path) -> bool:
    """Return whether a file, folder or link is there and belongs to another user."""
    if not hasattr(os, "getuid"):  # Windows
        return False
    try:
        return path.lstat().st_uid != os.getuid()
    except OSError:
        return False
