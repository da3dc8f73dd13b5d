"""The files of a diagnosis: its JSON, its page, its recording and its figures."""

from collections.abc import Callable
from pathlib import Path

import slipwise as sw
from slipwise.cli.console import ERR, say
from slipwise.errors import InputError


def write_diagnosis(
    found: "sw.Diagnosis",
    folder: Path,
    recording: bool,
    figures: bool = False,
    tell: Callable[[str, float], None] | None = None,
) -> list[Path]:
    """Write the diagnosis, its page and, if asked for, its recording and figures; gives the files."""
    tell = tell or (lambda words, share: None)
    tell("drawing the page", 0.0)
    from slipwise.view.figures.figure_files import figures_into
    from slipwise.view.files import save_json, save_page
    from slipwise.view.pages.diagnosis_page import diagnosis_page

    files = [save_json(found.as_json(), folder / "diagnosis.json")]
    with figures_into(folder / "figures" if figures else None) as drawn:
        files.append(save_page(diagnosis_page(found, found.ladder()), folder / "report.html"))
    tell("replaying for the recording", 0.5)
    recorded = _record(found, folder) if recording else []
    tell("done", 1.0)
    return [*files, *drawn, *recorded]


def _record(found: "sw.Diagnosis", folder: Path) -> list[Path]:
    from slipwise.view.geometry import geometry_of
    from slipwise.view.recordings.comparison import write_comparison

    try:
        measured, simulated = found.replays()
    except InputError as error:
        say(f"no recording: {error}", ERR)
        return []
    geometry = geometry_of(found.final.campaign.specimen)
    return [write_comparison(measured, simulated, geometry, folder / "before_and_after.rrd", found.sentence)]
