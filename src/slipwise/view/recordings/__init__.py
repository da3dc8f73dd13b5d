"""Recordings for the rerun viewer; all else works without rerun.

This file loads nothing of it, so that a command can ask whether it is there.
"""

from importlib.util import find_spec

#: What to do where rerun is missing.
WITHOUT_RERUN = 'rerun is not installed; `pip install "rerun-sdk>=0.41,<0.42"` installs it'


def is_rerun_installed() -> bool:
    """Return whether recordings can be written and opened here."""
    try:
        return find_spec("rerun") is not None
    except (ModuleNotFoundError, ValueError):  # an environment that hides it
        return False
