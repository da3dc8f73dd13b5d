"""Open a recording in the rerun viewer, which then listens on this machine only."""

import subprocess
import sys
from pathlib import Path

from slipwise.errors import InputError, SlipwiseError
from slipwise.jobs.child_processes import on_a_safe_path
from slipwise.view.recordings import WITHOUT_RERUN, is_rerun_installed

#: The viewer's own default is every interface of the machine.
_LOOPBACK = "127.0.0.1"
#: `python -m rerun_cli` ends with 0 whatever the viewer ends with.
_VIEWER = "import sys; from rerun_cli.__main__ import main; sys.exit(main())"


def find_recording(place: Path) -> Path:
    """Find the recording in a folder, or take the file itself; of several the newest.

    Raises:
        InputError: no .rrd file there.
    """
    if place.is_file() and place.suffix == ".rrd":
        return place
    found = sorted(place.glob("*.rrd"), key=lambda path: path.stat().st_mtime) if place.is_dir() else []
    if not found:
        raise InputError(
            f"{place}: no recording (.rrd) there; `slipwise replay MOTION --out {place if place.is_dir() else 'DIR'}` "
            "writes one"
        )
    return found[-1]


def viewer_command(recording: Path) -> list[str]:
    """Return the command that opens a recording in the viewer of the installed rerun, bound to the loopback address."""
    return [sys.executable, "-c", _VIEWER, "--bind", _LOOPBACK, str(recording)]


def open_viewer(place: Path) -> None:
    """Open the recording of a folder in the viewer and wait until it is closed.

    Args:
        place: a folder with a recording, or the .rrd file.

    Raises:
        InputError: no .rrd file there, or rerun is not installed.
        SlipwiseError: the viewer could not run, for example without a display.
    """
    recording = find_recording(place)
    if not is_rerun_installed():
        raise InputError(f"{recording} cannot be shown: {WITHOUT_RERUN}")
    with on_a_safe_path():
        viewer = subprocess.Popen(viewer_command(recording))
    try:
        code = viewer.wait()
    except KeyboardInterrupt:
        return
    except BaseException:
        viewer.kill()
        raise
    if code != 0:
        raise SlipwiseError(
            f"the rerun viewer ended with code {code}; it needs a display. On a machine without one, copy {recording} "
            f"to yours and open it there: rerun --bind {_LOOPBACK} {recording.name}"
        )
