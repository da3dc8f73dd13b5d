"""Run a script of OpenSeesPy in a process of its own, and read what it has written."""

import importlib.util
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from slipwise.arrays import Array

#: The line with which a script ends.
LAST_LINE = "peak slip x [mm]:"
#: Longer than this a script is not waited for [s].
_LONGEST = 3600.0


def is_installed() -> bool:
    """Return whether OpenSeesPy is there; whether it can be loaded shows when a script is run."""
    return importlib.util.find_spec("openseespy") is not None


def run_script(script: Path) -> tuple[Mapping[str, Array], str]:
    """Run a script of `export_opensees`.

    Returns:
        Channel -> values (n,) [SI] with "time", and why there are none: "" where it ran to its end.
    """
    try:
        done = subprocess.run(
            [sys.executable, "-P", str(script)], capture_output=True, text=True, timeout=_LONGEST, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return {}, f"OpenSeesPy could not be run: {error}"
    if done.returncode or LAST_LINE not in done.stdout:
        said = [line for line in done.stderr.splitlines() if line.strip() and "Terminating" not in line]
        return {}, f"the script did not end: {_reason(said)}"
    return read_history(script.with_name(f"{script.stem}_history.csv")), ""


def read_history(path: Path) -> dict[str, Array]:
    """Read the history that a script has written: channel -> values (n,) [SI], "time" among them."""
    with path.open(encoding="utf-8") as stream:
        names = [header.split(" [")[0] for header in stream.readline().strip().split(",")]
        values = np.loadtxt(stream, delimiter=",", ndmin=2)
    return {name: np.ascontiguousarray(values[:, i]) for i, name in enumerate(names)}


def _reason(said: list[str]) -> str:
    """Return the first error that is the cause of the others, or the last line."""
    missing = [line for line in said if "cannot open shared object" in line]
    if missing:
        return f"{missing[0].strip()} (a system library is missing; on Debian: apt-get install libblas3)"
    return said[-1].strip() if said else "it said nothing"
