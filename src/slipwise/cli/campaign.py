"""`slipwise init`, `audit` and `compare`: draft a campaign, check its instruments, hold a model against it."""

import sys
from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import can_record, out_folder, print_json, say, say_corrections, say_next, steps
from slipwise.cli.options import (
    Allowed,
    CampaignFolder,
    Figures,
    Json,
    ModelFile,
    Own,
    System,
    Trusted,
    own_effects,
    refuse_unnamed,
    start_model,
)

Correct = Annotated[
    list[str] | None,
    typer.Option(help="Correct the records by a finding of the audit, named as it prints it; may be repeated."),
]


def init(
    folder: Annotated[Path, typer.Argument(help="Folder with the files of the measured runs.")],
    yes: Annotated[bool, typer.Option("--yes", help="Take the guesses; ask nothing.")] = False,
) -> None:
    """Draft campaign.toml from the files of a folder; what only you can know is asked for, or marked in it.

    Example: `slipwise init campaigns/march`
    """
    ask = None if yes or not sys.stdin.isatty() else _ask
    specimen = folder / "specimen.toml"
    was_there = specimen.exists()
    path = sw.init_campaign(folder, ask=ask)
    say(f"wrote {path}")
    if specimen.exists() and not was_there:
        say(f"wrote {specimen}: no rig of the package fits; fill in its places, sizes and heights")
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith(("# not read: ", "# note: ")):
            say(line.removeprefix("# "))
    say_next(f"read {path} and decide what is marked in it, then `slipwise audit {quote(str(folder))}`")


def _ask(question: str, default: str) -> str:
    return str(typer.prompt(question, default=default, show_default=bool(default)))


def audit(campaign: CampaignFolder, effect: Own = None, correct: Correct = None, json: Json = False) -> None:
    """Check whether the instruments tell the truth, before any law of friction.

    Example: `slipwise audit campaigns/march`
    """
    from slipwise.view.words.terminal import print_table

    measured, own = sw.load_campaign(campaign), own_effects(effect)
    with steps() as tell:
        tell("auditing the instruments", 0.2)
        found = sw.audit(measured, own=own)
        notes: tuple[str, ...] = ()
        if correct:
            corrected = sw.corrected_campaign(measured, found, correct)
            notes = corrected.notes[len(measured.notes) :]
            tell("auditing once more", 0.6)
            found = sw.audit(corrected, own=own)
    if json:
        print_json({**found.as_json(), "notes": [*notes, *found.notes]})
        return
    for words in (*notes, found.words):
        say(words)
    if found.rows:
        print_table("Findings", found.rows)
    for words in found.notes:
        say(f"note: {words}")
    for words in found.cannot:
        say(f"could not be tested: {words}")
    say_next(f"`slipwise compare {quote(str(campaign))}`, which takes `--correct FINDING` for what is wrong")


def compare(
    campaign: CampaignFolder,
    out: Annotated[Path, typer.Option(help="Folder for compare.json, report.html and the recording.")] = Path(
        "out/compare"
    ),
    model: ModelFile = None,
    effect: Allowed = None,
    trust: Trusted = False,
    system: System = True,
    correct: Correct = None,
    recording: Annotated[bool, typer.Option(help="Write measured and simulated side by side for the viewer.")] = True,
    figures: Figures = False,
    json: Json = False,
) -> None:
    """Hold the model against the measurement: how well does it do, and exactly where does it fail.

    Example: `slipwise compare campaigns/march --out out/march`
    """
    from slipwise.view.figures.figure_files import figures_into
    from slipwise.view.files import save_json, save_page
    from slipwise.view.pages.compare_page import compare_page

    recording = can_record(recording)
    measured = sw.load_campaign(campaign)
    start = start_model(campaign, model, trust, effect)
    refuse_unnamed(effect, start)
    folder = out_folder(out)
    with steps() as tell:
        if correct:
            measured = sw.corrected_campaign(measured, sw.audit(measured), correct)
        found = sw.compare(measured, start, system=system, progress=tell)
        tell("writing the report", 0.97)
        content = found.as_json()
        with figures_into(folder / "figures" if figures else None) as drawn:
            page = save_page(compare_page(found), folder / "report.html")
        files = [save_json(content, folder / "compare.json"), page, *drawn]
        if recording:
            from slipwise.view.recordings.compare_recording import write_compare_recording

            files.append(write_compare_recording(found, folder / "compare.rrd"))
    if json:
        print_json(content)
        return
    from slipwise.view.words.compare_answers import error_rows, one_minute
    from slipwise.view.words.gauge_rows import gauge_rows
    from slipwise.view.words.terminal import print_table

    for question, answer in one_minute(found):
        say(f"{question} {answer}")
    say_corrections(found.corrections)
    print_table("Error in multiples of the noise floor", error_rows(found))
    print_table("Noise of every gauge, one sample", gauge_rows(found.gauges))
    for words in found.cannot:
        say(f"not told: {words}")
    for path in files:
        say(f"wrote {path}")
    shown = [f"`slipwise view {quote(str(folder))}`"] if recording else []
    say_next(f"open {page}", *shown, f"`slipwise diagnose {quote(str(campaign))}` names what is missing")
