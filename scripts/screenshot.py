"""Make a picture of a recording in the rerun viewer and check that the rig, loops and series are on it.

    python scripts/screenshot.py out/replay/replay.rrd --out shot.png
    python scripts/screenshot.py out/replay/replay.rrd --out shot.png --at 12.5

Without --at the viewer runs on a virtual display (xvfb-run) and shows the start of the recording. With --at it runs
without a display and shows that time. Both need a Vulkan driver; Debian's mesa-vulkan-drivers draws in software.
Ends with 0 and says so where the viewer or xvfb is not installed, with 1 where the picture is blank.
"""

import argparse
import importlib.util
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.image import imread
from rerun.chunk import RrdReader

from slipwise.channels import pads_in
from slipwise.view.figures.style import pad_colour, rgb

VIEWER = [
    sys.executable,
    "-m",
    "rerun_cli",
    "--bind",
    "127.0.0.1",
    "--renderer",
    "vulkan",
    "--window-size",
    "1600x1000",
]
SECONDS = 180.0
#: A pad's colour counts as shown when so many pixels have it.
PIXELS = 40


def main() -> int:
    """Make the picture; give the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("recording", type=Path)
    parser.add_argument("--out", type=Path, required=True, help="PNG file to write")
    parser.add_argument("--at", type=float, help="time to show [s]")
    given = parser.parse_args()
    if not given.recording.is_file():
        print(f"{given.recording}: no such recording")
        return 1
    if importlib.util.find_spec("rerun_cli") is None:
        print("skipped: the rerun viewer is not installed (pip install rerun-sdk)")
        return 0
    if given.at is None and shutil.which("xvfb-run") is None:
        print("skipped: xvfb-run is not installed (Debian: apt-get install xvfb mesa-vulkan-drivers)")
        return 0
    given.out.parent.mkdir(parents=True, exist_ok=True)
    given.out.unlink(missing_ok=True)
    if given.at is None:
        said = picture_of_the_start(given.recording, given.out)
    else:
        said = picture_at(given.recording, given.out, given.at)
    if not given.out.is_file():
        print(f"the viewer made no picture; it said:\n{said[-2000:]}")
        return 1
    fault = what_is_wrong(imread(given.out), pads_of(given.recording))
    print(f"{given.out}: {fault or 'a true picture'}")
    return 1 if fault else 0


def picture_of_the_start(recording: Path, out: Path) -> str:
    """Let the viewer take its own picture on a virtual display; give what it said."""
    command = ["xvfb-run", "-a", *VIEWER, "--port", "auto", "--screenshot-to", str(out), str(recording)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return f"nothing within {SECONDS:g} s"
    return done.stderr


def picture_at(recording: Path, out: Path, seconds: float) -> str:
    """Run the viewer without a display, go to a time, take a picture; give what went wrong."""
    from rerun.experimental import ViewerClient

    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    # A session of its own: what starts here is a small program that starts the viewer, and both have to end.
    viewer = subprocess.Popen(
        [*VIEWER, "--headless", "--port", str(port), str(recording)],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
    )  # fmt: skip
    client, last = None, "the viewer did not answer"
    try:
        for _ in range(60):
            time.sleep(1.0)
            try:
                client = ViewerClient.connect(f"rerun+http://127.0.0.1:{port}/proxy")
                if client.get_state().recordings:
                    client.set_time("time", duration=seconds, play_state="paused")
                    time.sleep(5.0)
                    out.write_bytes(client.take_screenshot())
                    return ""
            except RuntimeError as error:
                last = str(error)
    finally:
        os.killpg(viewer.pid, signal.SIGTERM)
        viewer.wait()
    return last


def pads_of(recording: Path) -> tuple[str, ...]:
    """Give the names of the pads whose channels a recording shows."""
    reader = RrdReader(recording)
    entities = {chunk.entity_path for store in reader.recordings() for chunk in reader.stream(store=store)}
    return pads_in(entity.rpartition("/")[2] for entity in sorted(entities))


def what_is_wrong(picture: np.ndarray, pads: Sequence[str]) -> str:
    """Say why a picture cannot be one of a recording; nothing if all is well.

    Args:
        picture: (height, width, 3 or 4), 0 to 1.
        pads: names of the pads that it has to show.
    """
    pixels = np.rint(255.0 * picture[..., :3]).astype(np.int32)
    colours = len(np.unique(pixels @ np.array([65536, 256, 1])))
    if colours < 200:
        return f"it is blank: {colours} colours"
    for pad in pads:
        colour = pad_colour(pad)
        found = int(np.sum(np.all(np.abs(pixels - np.array(rgb(colour))) <= 12, axis=-1)))
        if found < PIXELS:
            return f"pad {pad} is not on it: {found} pixels of its colour {colour}"
    return ""


if __name__ == "__main__":
    sys.exit(main())
