"""The folder in which matplotlib keeps its list of fonts, where it has none of its own."""

import os
import sys
from pathlib import Path

from slipwise.cache import code_folders


def give_matplotlib_a_folder() -> None:
    """Let matplotlib keep its list where this program keeps what it can make again, if no home can be written to.

    Otherwise it makes the list anew for every command, and says so in three lines. To be called before it is imported.
    """
    if os.environ.get("MPLCONFIGDIR") or not sys.platform.startswith("linux"):
        return
    if all(map(_can_be_written, (("XDG_CONFIG_HOME", ".config"), ("XDG_CACHE_HOME", ".cache")))):
        return
    for folder in code_folders()[:1]:
        os.environ["MPLCONFIGDIR"] = str(folder / "matplotlib")


def _can_be_written(place: tuple[str, str]) -> bool:
    variable, name = place
    given = os.environ.get(variable)
    try:
        folder = (Path(given) if given else Path.home() / name) / "matplotlib"
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return False
    return folder.is_absolute() and os.access(folder, os.W_OK)
