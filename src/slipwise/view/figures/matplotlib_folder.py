"""Where matplotlib reads and keeps files: not in the current folder, and where it can write."""

import os
import sys
from contextlib import chdir
from importlib import import_module
from pathlib import Path

from slipwise.jobs.cache import code_folders


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


def pass_over_a_matplotlibrc_here() -> None:
    """Keep matplotlib from reading a matplotlibrc of the current folder, which no setting of its own prevents.

    It may come from a stranger, and where it is damaged nothing can be drawn. To be called before it is imported.
    """
    if os.path.lexists("matplotlibrc"):
        with chdir(Path(__file__).parent):
            import_module("matplotlib")


def _can_be_written(place: tuple[str, str]) -> bool:
    variable, name = place
    given = os.environ.get(variable)
    try:
        folder = (Path(given) if given else Path.home() / name) / "matplotlib"
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return False
    return folder.is_absolute() and os.access(folder, os.W_OK)
