"""The pictures and the recording of a replay, drawn on every core."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from slipwise.jobs.parallel import on_every_core
from slipwise.record import Record
from slipwise.view.geometry import RigGeometry


def draw_replay(
    record: Record, geometry: RigGeometry, folder: Path, title: str, *, pictures: bool, recording: bool
) -> list[Path]:
    """Write loops.png, loads.png, modes.png, histories.png and replay.rrd, or what of them is wanted.

    Args:
        record: of the replay.
        geometry: of its rig.
        folder: made if absent.
        title: of the recording.
        pictures: whether to draw the four pictures.
        recording: whether to write the recording.

    Returns:
        The files, each there whole or not at all.
    """
    # What draws is loaded here, once for all cores and only where it is wanted: it takes a second.
    # What takes longest comes first, so that the cores end together.
    jobs: list[Callable[[], Path]] = []
    if recording:
        from slipwise.view.recordings.recording import write_recording

        jobs.append(partial(write_recording, record, geometry, folder / "replay.rrd", title))
    if pictures:
        from slipwise.view.figures.pictures import PICTURES, save_picture

        jobs += [partial(save_picture, name, record, geometry, folder) for name in PICTURES]
    return list(on_every_core(lambda place: jobs[place](), len(jobs), "the pictures"))
