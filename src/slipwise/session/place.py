"""Where the session of a campaign lies: asked before anything that takes long to load."""

import os
from hashlib import sha256
from pathlib import Path

from slipwise.cache import cache_folder


def session_folder(campaign: Path) -> Path:
    """Give the folder of a campaign's session: beside its files, or in the cache where nothing may be written there.

    Args:
        campaign: folder of the campaign.
    """
    folder = campaign.resolve()
    if os.access(folder, os.W_OK):
        return folder / ".slipwise"
    return cache_folder() / "sessions" / f"{folder.name}-{sha256(str(folder).encode()).hexdigest()[:12]}"


def snapshot_file(campaign: Path) -> Path:
    """Give the file that holds every step of it."""
    return session_folder(campaign) / "session.json"
