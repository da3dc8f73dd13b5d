"""`slipwise diagnose` and `slipwise ladder`: name what is missing, and watch the error fall."""

from math import isfinite
from pathlib import Path
from shlex import quote
from typing import Annotated

import typer
from rich.console import Console

import slipwise as sw
from slipwise.cli.batch import Wanted, diagnose_many
from slipwise.cli.console import ERR, OUT, can_record, out_folder, print_json, say, say_corrections, say_next, steps
from slipwise.cli.diagnosis_files import write_diagnosis
from slipwise.cli.model_edit import tell_change
from slipwise.cli.options import (
    CampaignFolder,
    Figures,
    Json,
    ModelFile,
    Own,
    System,
    Trusted,
    own_effects,
    start_model,
)
from slipwise.cli.workers import Cluster, Workers
from slipwise.errors import InputError
from slipwise.jobs.interruption import Stopped

CampaignFolders = Annotated[
    list[Path], typer.Argument(help="Folders with campaign.toml and the measured runs; one, or several to compare.")
]


def diagnose(
    campaign: CampaignFolders,
    out: Annotated[
        Path,
        typer.Option(
            help="Folder for diagnosis.json, report.html and the recording; of several campaigns, for a folder of each "
            "with these, index.html, summary.json and summary.csv."
        ),
    ] = Path("out/diagnosis"),
    model: ModelFile = None,
    effect: Own = None,
    trust: Trusted = False,
    system: System = True,
    recording: Annotated[
        bool, typer.Option(help="Write the model before and after beside the measurement, for the viewer.")
    ] = True,
    figures: Figures = False,
    workers: Workers = None,
    cluster: Cluster = None,
    accept: Annotated[
        bool, typer.Option("--accept", help="Put what it names into the campaign's model.toml, and fit that.")
    ] = False,
    timings: Annotated[bool, typer.Option(help="Print how long each stage took.")] = False,
    json: Json = False,
) -> None:
    """Say which effect the model lacks, with a probability that means what it says.

    Of several campaigns (the same rig a year later), it also says what is common to all and what differs. Each is
    worked at on one core, with `--workers 1` one after another on all cores; one campaign alone always here, on all
    cores. One that cannot be used is told in its row, and the exit code is 2. Called again, only what is new or changed
    is diagnosed. The workers of a cluster must see the same folders.

    Example: `slipwise diagnose campaigns/march --out out/march`
    """
    recording = can_record(recording)
    if len(campaign) > 1:
        if accept:
            raise InputError("--accept writes the model.toml of one campaign; give one")
        own = tuple(str(Path(name).resolve()) if name.endswith(".py") else name for name in effect or [])
        wanted = Wanted(model.resolve() if model else None, own, trust, system, recording)
        diagnose_many(campaign, out, wanted, workers, cluster, json)
        return
    _diagnose_one(campaign[0], out, model, effect, trust, system, recording, figures, accept, json, timings)


def _diagnose_one(
    campaign: Path,
    out: Path,
    model: Path | None,
    effect: list[str] | None,
    trust: bool,
    system: bool,
    recording: bool,
    figures: bool,
    accept: bool,
    json: bool,
    timings: bool,
) -> None:
    measured = sw.load_campaign(campaign)
    folder = out_folder(out)
    start = start_model(campaign, model, trust, effect)
    # opened first: whoever has this campaign open elsewhere hears so before minutes have passed
    session = sw.Session(measured, start, trust=trust or effect or (), resume=False) if accept else None
    try:
        own = own_effects(effect, start)
        with steps() as tell:
            found = sw.diagnose(measured, start, own=own, system=system, law=False, progress=tell)
        _show(found, folder, recording and measured.specimen.free, figures, json, timings)
        if session is not None:
            _accept(found, session, ERR if json else OUT)
        if not json:
            say_next(f"open {folder / 'report.html'}", *_next_steps(found, campaign, accepted=accept))
    finally:
        if session is not None:
            session.close()


def _next_steps(found: "sw.Diagnosis", campaign: Path, accepted: bool) -> list[str]:
    """Return what a verdict suggests."""
    place, kind = quote(str(campaign)), found.verdict.kind
    if kind == "ambiguous":
        return [f"`slipwise next {place}` for a motion that tells them apart"]
    if kind == "unknown":
        return [f"`slipwise discover {place}` for its law"]
    if accepted or not found.verdict.effects:
        return [f"`slipwise bearing {place}` for what standards ask"]
    return [f"`slipwise add {found.verdict.effects[0]} --campaign {place}`"]


def _accept(found: "sw.Diagnosis", session: "sw.Session", console: Console) -> None:
    """Put what a diagnosis names into model.toml, fitted, as the workbench does."""
    if not found.verdict.effects:
        say("nothing is named that could be put into the model; model.toml is as it was", console)
        return
    with steps() as tell:
        changed = sw.add(found, session, progress=tell)
    tell_change(changed, held_out=bool(session.campaign.with_role("holdout")), console=console)
    say(f"wrote {session.accept()}", console)


def _show(
    found: "sw.Diagnosis",
    folder: Path,
    recording: bool,
    figures: bool,
    json: bool,
    timings: bool,
) -> None:
    try:
        if not json:  # before a law is looked for and anything is drawn: who waits, waits for this
            _tell(found)
    finally:  # who listened may have left after some lines, as `head` does
        found = _with_law(found, ERR if json else OUT)
        times: dict[str, float] = {}
        files = write_diagnosis(found, folder, recording, figures, times)
    if json:
        print_json(found.as_json())
    else:
        _wrote(files)
    if timings:
        for words, seconds in {**found.stages, **times}.items():
            say(f"{seconds:6.1f} s  {words}", ERR if json else OUT)


def _with_law(found: "sw.Diagnosis", console: Console) -> "sw.Diagnosis":
    """Look for the law of an unknown force; who stops that keeps the verdict."""
    if found.verdict.kind != "unknown" and not found.verdict.unknown_beside:
        return found
    try:
        with steps() as tell:
            found = sw.add_law(found, tell)
    except Stopped:
        say("the law was not looked for to the end; `slipwise discover` looks for it", console)
        return found
    if found.law:
        say(f"{found.law['words']} `slipwise discover` writes it as an effect.", console)
    return found


def _tell(found: "sw.Diagnosis") -> None:
    """Print the verdict, what each effect changes, its rivals and what it rests on."""
    from slipwise.view.words.diagnosis_words import cannot_tell_words, error_name, floors, four_answers
    from slipwise.view.words.terminal import print_table

    for question, answer in four_answers(found):
        say(f"{question} {answer}")
    say_corrections(found.corrections)
    print_effects(found)
    for words in found.discriminating_tests[1:]:
        say(f"to tell apart: {words}")
    rows = [
        {"hypothesis": c.effect, "probability": f"{100 * c.probability:.1f} %", "before": floors(c.holdout_before),
         "after": floors(c.holdout_after)}
        for c in found.candidates
    ]  # fmt: skip
    if rows:
        print_table(f"Hypotheses; {error_name(found)} before and after, in noise floors", rows)
    for run in found.predicted_friction:
        say(run.words)
    for words in cannot_tell_words(found):
        say(f"cannot tell {words}")
    for words in found.final.campaign.notes:
        say(f"note: {words}")


def print_effects(found: "sw.Diagnosis") -> None:
    """Print whether held-out runs confirm a diagnosis, and what leaving each effect out changes."""
    from slipwise.view.words.diagnosis_words import confirmed_words
    from slipwise.view.words.importance_rows import importance_rows, replayed_run
    from slipwise.view.words.terminal import print_table

    if words := confirmed_words(found):
        say(words)
    if rows := importance_rows(found, brief=True):
        print_table(f"Changes without each effect; peak slip, energy and largest load of {replayed_run(found)}", rows)


def ladder(
    campaign: CampaignFolder,
    out: Annotated[Path, typer.Option(help="Folder for ladder.json and the picture.")] = Path("out/ladder"),
    add: Annotated[list[str] | None, typer.Option(help="Add these effects in this order instead of searching.")] = None,
    model: ModelFile = None,
    effect: Own = None,
    trust: Trusted = False,
    system: System = True,
    json: Json = False,
) -> None:
    """Watch the error fall, step by step, on runs that no fit has seen, down to the noise floor.

    Example: `slipwise ladder campaigns/march --out out/march`
    """
    from slipwise.view.figures.canvas import save_figure
    from slipwise.view.figures.diagnosis_figures import ladder_figure
    from slipwise.view.figures.style import styled
    from slipwise.view.files import save_json

    measured = sw.load_campaign(campaign)
    folder = out_folder(out)
    with steps() as tell:
        start = start_model(campaign, model, trust, effect)
        found = sw.ladder(measured, add or [], start, own=own_effects(effect, start), system=system, progress=tell)
    content = save_json(found.as_json(), folder / "ladder.json")
    with styled():
        picture = save_figure(ladder_figure(found), folder / "ladder.png")
    if json:
        print_json(found.as_json())
        return
    say_corrections(found.corrections)
    print_rungs(found)
    screened, refitted = found.tried
    OUT.print(f"{screened} candidates compared, {refitted} hypotheses refitted, {found.seconds:.0f} s; {found.stopped}")
    _wrote([content, picture])
    say_next(f"look at {picture}", f"`slipwise diagnose {quote(str(campaign))}` for how sure that is")


def print_rungs(found: "sw.Ladder") -> None:
    """Print the errors of every step; nothing where there is none."""
    from slipwise.view.figures.diagnosis_figures import step_errors
    from slipwise.view.words.diagnosis_words import floors
    from slipwise.view.words.terminal import print_table

    errors = step_errors(found)
    rows = [
        {"model": " + ".join(["base", *step.effects])}
        | {runs: floors(values[place]) for runs, values in errors.items() if isfinite(values[place])}
        for place, step in enumerate(found.steps)
    ]
    print_table("Error in multiples of the noise floor", rows)


def _wrote(files: list[Path]) -> None:
    for path in files:
        say(f"wrote {path}")
