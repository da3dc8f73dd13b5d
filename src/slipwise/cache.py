"""The folder of what can be made again: compiled laws, the list of units."""

import os
from pathlib import Path


def cache_folder() -> Path:
    """Give the folder; SLIPWISE_CACHE overrides it. It may not exist yet."""
    chosen = os.environ.get("SLIPWISE_CACHE")
    if chosen:
        return Path(chosen)
    return Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "slipwise"
