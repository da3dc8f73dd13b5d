"""`slipwise bearing`: what a laboratory hands in of a bearing, in the words of the standards."""

from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import out_folder, print_json, say, say_corrections, say_next, steps
from slipwise.cli.options import Allowed, CampaignFolder, Figures, Json, ModelFile, Trusted, refuse_unnamed, start_model


def bearing(
    campaign: CampaignFolder,
    out: Annotated[
        Path, typer.Option(help="Folder for bearing.html, bearing.csv, bearing.xlsx and bearing.json.")
    ] = Path("out/bearing"),
    model: ModelFile = None,
    effect: Allowed = None,
    trust: Trusted = False,
    figures: Figures = False,
    json: Json = False,
) -> None:
    """Report friction, energy, stiffness, damping, degradation and modification factors, as standards name them.

    By cycle and by run, of each pad and of their sum, from the measured loops and beside them from the fitted law.

    Example: `slipwise bearing campaigns/march --out out/march`
    """
    from slipwise.view.figures.figure_files import figures_into
    from slipwise.view.files import save_json, save_page, save_rows
    from slipwise.view.pages.bearing_page import bearing_page
    from slipwise.view.words.bearing_tables import BearingTables
    from slipwise.view.workbook import save_workbook

    measured = sw.load_campaign(campaign)
    start = start_model(campaign, model, trust, effect)
    refuse_unnamed(effect, start)
    folder = out_folder(out)
    without_workbook = ""
    with steps() as tell:
        found = sw.bearing(measured, start, progress=tell)
        tell("writing the report", 0.97)
        content, tables = found.as_json(), BearingTables(found)
        with figures_into(folder / "figures" if figures else None) as drawn:
            page = save_page(bearing_page(found), folder / "bearing.html")
        files = [page, save_rows(tables.wide(found.rows), folder / "bearing.csv"), *drawn]
        try:
            files.append(save_workbook(tables.sheets(), folder / "bearing.xlsx"))
        except sw.SlipwiseError as error:
            without_workbook = str(error)
        files.append(save_json(content, folder / "bearing.json"))
    if json:
        print_json(content)
        return
    _tell(found)
    for words in (without_workbook, *(f"wrote {path}" for path in files)):
        if words:
            say(words)
    say_next(f"open {page}")


def _tell(found: "sw.BearingReport") -> None:
    """Print the tables of the total, and what could not be given."""
    from slipwise.view.words.bearing_tables import FRICTION, LOOP, OF_RUN, BearingTables, name_of_total
    from slipwise.view.words.terminal import print_table

    tables, total = BearingTables(found), name_of_total(found)
    say_corrections(found.corrections)
    print_table(f"Whole runs, {total}", tables.short(found.of("run", found.total), (*OF_RUN[:3], "energy")))
    series = tables.by_series(found.of("mean of cycles", found.total), (*FRICTION, *LOOP))
    for name, rows in series.items():
        print_table(f"{name}, {total}", rows)
    if degradation := tables.degradation(found.total):
        print_table("Each cycle against the first and the third one of its series", degradation)
    for standard, rows in tables.standards().items():
        print_table(f"As {standard} names them", rows)
    for one in found.not_held:
        say(f"{one.standard}: {one.words}")
    for words in found.cannot:
        say(f"could not be given: {words}")
