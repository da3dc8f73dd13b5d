"""The files of a diagnosis: its JSON, its page, its recording and its figures."""

import time
from pathlib import Path

import slipwise as sw
from slipwise.cli.console import ERR, say
from slipwise.errors import InputError


def write_diagnosis(
    found: "sw.Diagnosis",
    folder: Path,
    recording: bool,
    figures: bool = False,
    times: dict[str, float] | None = None,
    prediction: "sw.PredictionReport | None" = None,
) -> list[Path]:
    """Write the diagnosis, its page and, if asked for, its recording and figures; gives the files.

    Args:
        found: the diagnosis.
        folder: that exists.
        recording: replay one run and write it for the viewer.
        figures: write every figure of the page by itself too.
        times: gets what was done -> how long it took [s], if given.
        prediction: what was found of a model that predicted the runs, if one did.
    """
    from slipwise.view.figures.figure_files import figures_into
    from slipwise.view.files import save_json, save_page
    from slipwise.view.pages.diagnosis_page import diagnosis_page

    began = time.perf_counter()
    files = [save_json(found.as_json(), folder / "diagnosis.json")]
    with figures_into(folder / "figures" if figures else None) as drawn:
        files.append(save_page(diagnosis_page(found, found.ladder(), prediction), folder / "report.html"))
    if prediction is not None:
        files.append(save_json(prediction.as_json(), folder / "predicted.json"))
    drawn_at = time.perf_counter()
    recorded = _record(found, folder) if recording else []
    if times is not None:
        times |= {"drawing the page": drawn_at - began, "replaying for the viewer": time.perf_counter() - drawn_at}
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
