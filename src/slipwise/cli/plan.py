"""`slipwise plan`: before a test, what its gauges and motions would show."""

from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import out_folder, print_json, say, say_next, steps
from slipwise.cli.options import Figures, Json, ModelFile, Own, Trusted, own_effects, start_model


def plan(
    test: Annotated[
        str,
        typer.Argument(
            help="A name of `slipwise rigs`, the file of a rig, or a campaign's folder.", metavar="RIG|CAMPAIGN"
        ),
    ],
    motions: Annotated[
        list[str] | None,
        typer.Option(help="A motion of the table, a file or synthetic (`slipwise motions`); once for each."),
    ] = None,
    gauges: Annotated[
        list[str] | None,
        typer.Option(help="Planned channels, e.g. `'pad_*_N,pad_*_Fx,slip_x'`; the rig's usual ones if not given."),
    ] = None,
    budget: Annotated[int | None, typer.Option(help="Give the best set of gauges within so many channels.")] = None,
    rate: Annotated[str | None, typer.Option(help="Rate of the samples [500 Hz].")] = None,
    corner: Annotated[str | None, typer.Option("--filter", help="Corner of the low-pass filter [100 Hz].")] = None,
    out: Annotated[Path, typer.Option(help="Folder for plan.html, plan.csv and plan.json.")] = Path("out/plan"),
    model: ModelFile = None,
    effect: Own = None,
    trust: Trusted = False,
    figures: Figures = False,
    json: Json = False,
) -> None:
    """Say before a test which effects its gauges and motions would show, name and tell apart, and what to add.

    Example: `slipwise plan bridge1 --budget 10 --motions quake:seed=2,peak=0.7g,vertical=0.3g`
    """
    from slipwise.view.figures.figure_files import figures_into
    from slipwise.view.files import save_json, save_page, save_rows
    from slipwise.view.pages.plan_page import plan_page

    start = start_model(Path(test), model, trust, effect)
    folder = out_folder(out)
    with steps() as tell:
        found = sw.plan(
            test,
            motions or (),
            gauges or (),
            budget=budget,
            model=start,
            own=own_effects(effect, start),
            rate=None if rate is None else sw.quantity(rate, "Hz", "--rate"),
            corner=None if corner is None else sw.quantity(corner, "Hz", "--filter"),
            progress=tell,
        )
        content = found.as_json()
        with figures_into(folder / "figures" if figures else None) as drawn:
            page = save_page(plan_page(found), folder / "plan.html")
        chances = folder / "plan.csv"
        chances.unlink(missing_ok=True)  # of an earlier plan: without motions there are none
        table = [save_rows(found.rows, chances)] if found.rows else []
        files = [page, *table, *drawn, save_json(content, folder / "plan.json")]
    if json:
        print_json(content)
        return
    _tell(found)
    for path in files:
        say(f"wrote {path}")
    say_next(f"open {page}", "record the motions, and `slipwise init` their folder")


def _tell(found: "sw.PlannedTest") -> None:
    """Print the sentence, what to add, and the tables."""
    from slipwise.view.words.plan_tables import list_advice, list_effect_rows, list_motion_lines, list_set_rows
    from slipwise.view.words.terminal import print_table

    say(found.sentence)
    for words in (*found.notes, *list_advice(found)):
        say(words)
    if found.unused:
        say(f"No balance of {found.rig} uses {', '.join(found.unused)}: nothing is said of them.")
    for name, why in found.failed.items():
        say(f"{name} was not replayed: {why}")
    if found.hardly:
        say(f"The specimen hardly slides in {', '.join(found.hardly)}: such motions say little of friction.")
    if found.planned.unsized:
        say(f"No chances with the planned gauges: {found.planned.unsized}")
    print_table("Sets of gauges; effects that each can show and tell apart", list_set_rows(found))
    if rows := list_effect_rows(found.planned, others=False):
        print_table("Effects at their limit of materiality, planned gauges", rows)
    if found.motions:
        say("What to make first, by the mean chance to name an effect:")
        for line in list_motion_lines(found):
            say(line)
