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
from slipwise.errors import InputError, SlipwiseError, unknown_name
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
            "with these, index.html, summary.json, summary.csv and specimens.json."
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
    power: Annotated[
        bool, typer.Option("--power", help="Say which effects a campaign like this would have shown (a minute or two).")
    ] = False,
    why_not: Annotated[
        list[str] | None,
        typer.Option(help="Say why this effect was not named, and what contradicts it; may be given more than once."),
    ] = None,
    predicted: Annotated[
        Path | None,
        typer.Option(
            help="Folder with the same runs as another program predicted them: says what that program's model lacks, "
            "which of its numbers are off, and how far its error would fall."
        ),
    ] = None,
    timings: Annotated[bool, typer.Option(help="Print how long each stage took.")] = False,
    json: Json = False,
) -> None:
    """Say which effect the model lacks, with a probability that means what it says.

    Of several campaigns (the same rig a year later, or several specimens), it also says what is common to all and what
    differs, and fits one law over all whose sizes differ from specimen to specimen. Each is worked at on one core, with
    `--workers 1` one after another on all cores; one campaign alone always here, on all cores. One that cannot be used
    is told in its row, and the exit code is 2. Called again, only what is new or changed is diagnosed. The workers of a
    cluster must see the same folders.

    Example: `slipwise diagnose campaigns/march --out out/march`
    """
    recording = can_record(recording)
    if len(campaign) > 1:
        if accept:
            raise InputError("--accept writes the model.toml of one campaign; give one")
        if power or why_not:
            raise InputError("--power and --why-not ask about one campaign; give one")
        if predicted is not None:
            raise InputError("--predicted is of the runs of one campaign; give one")
        own = tuple(str(Path(name).resolve()) if name.endswith(".py") else name for name in effect or [])
        wanted = Wanted(model.resolve() if model else None, own, trust, system, recording)
        diagnose_many(campaign, out, wanted, workers, cluster, json)
        return
    if predicted is not None:
        if accept:
            raise InputError("--accept and --predicted are of two models; give one of them")
        if power or why_not:
            raise InputError("--power and --why-not ask about one model; leave out --predicted")
        _diagnose_prediction(campaign[0], predicted, out, model, effect, trust, system, recording, figures, json)
        return
    _diagnose_one(
        campaign[0], out, model, effect, trust, system, recording, figures, accept, power, why_not or [], json, timings
    )


def _diagnose_prediction(
    campaign: Path,
    predicted: Path,
    out: Path,
    model: Path | None,
    effect: list[str] | None,
    trust: bool,
    system: bool,
    recording: bool,
    figures: bool,
    json: bool,
) -> None:
    """Diagnose a campaign, and say what it shows of the model that predicted it."""
    measured = sw.load_campaign(campaign)
    folder = out_folder(out)
    start = start_model(campaign, model, trust, effect)
    own = own_effects(effect, start)
    with steps() as tell:
        judged = sw.judge_prediction(measured, predicted, start, own=own, system=system, progress=tell)
    if not json:
        _tell_prediction(judged)
    files = write_diagnosis(judged.found, folder, recording, figures, prediction=judged)
    if json:
        print_json(judged.as_json())
    else:
        _wrote(files)
        say_next(f"open {folder / 'report.html'}", *_next_steps(judged.found, campaign, accepted=False))


def _tell_prediction(judged: "sw.PredictionReport") -> None:
    """Print what another program's model is, what it lacks and which of its numbers are off."""
    from slipwise.view.words.prediction_words import error_rows, number_rows, prediction_answers, run_rows
    from slipwise.view.words.terminal import print_table

    say(judged.sentence)
    for question, answer in prediction_answers(judged):
        say(f"{question} {answer}")
    say_corrections(judged.found.corrections)
    print_table("Error of every balance, in noise floors", error_rows(judged))
    print_table("Numbers of the model and of the campaign", number_rows(judged.numbers))
    print_table("Runs as measured and as predicted", run_rows(judged))
    say(f"the campaign, begun from the paper's law or model.toml: {judged.found.sentence}")
    for words in judged.notes:
        say(f"note: {words}")


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
    power: bool,
    why_not: list[str],
    json: bool,
    timings: bool,
) -> None:
    _refuse_unknown(why_not, effect)
    measured = sw.load_campaign(campaign)
    folder = out_folder(out)
    start = start_model(campaign, model, trust, effect)
    # opened first: whoever has this campaign open elsewhere hears so before minutes have passed
    session = sw.Session(measured, start, trust=trust or effect or (), resume=False) if accept else None
    try:
        own = own_effects(effect, start)
        with steps() as tell:
            found = sw.diagnose(measured, start, own=own, system=system, law=False, progress=tell)
            if power:
                tell("putting each effect into twins of the campaign", 1.0)
                found = found.with_power()
            if why_not:
                tell("refitting what was asked about", 1.0)
                found = found.with_why_not(*why_not)
        tests = sw.hold_laws_against(found, own)
        found = _show(found, folder, recording and measured.specimen.free, figures, json, timings, tests)
        if session is not None:
            _accept(found, session, ERR if json else OUT)
        if not json:
            say_next(f"open {folder / 'report.html'}", *_next_steps(found, campaign, accepted=accept))
    finally:
        if session is not None:
            session.close()


def _refuse_unknown(names: list[str], own: list[str] | None) -> None:
    """Refuse a name that is in no catalogue before minutes have passed; that of an own file is known afterwards."""
    for name in names:
        if name not in sw.effects.catalogue() and not own:
            raise unknown_name("effect", name, sw.effects.catalogue(), "`slipwise effects` lists them.")


def _next_steps(found: "sw.Diagnosis", campaign: Path, accepted: bool) -> list[str]:
    """Return what a verdict suggests."""
    place, kind = quote(str(campaign)), found.verdict.kind
    if kind == "ambiguous":
        return [f"`slipwise next {place}` for a motion that tells them apart"]
    if kind == "unknown" or found.law:
        return [f"`slipwise discover {place}` for its law"]
    if found.verdict.is_doubtful:
        return [f"`slipwise next {place}` for a motion that would tell more"]
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
    tests: "sw.LawTests",
) -> "sw.Diagnosis":
    """Print a diagnosis and write its files; gives it with the law of what has no name, where one is found."""
    from slipwise.view.files import save_json

    try:
        if not json:  # before a law is looked for and anything is drawn: who waits, waits for this
            _tell(found)
            for test in tests.tests:
                say(test.sentence)
    finally:  # who listened may have left after some lines, as `head` does
        found = _with_law(found, ERR if json else OUT)
        times: dict[str, float] = {}
        files = write_diagnosis(found, folder, recording, figures, times)
        files += [save_json(tests.as_json(), folder / "holds.json")] if tests.tests else []
    if json:
        print_json(found.as_json() | ({"laws": tests.as_json()["laws"]} if tests.tests else {}))
    else:
        _wrote(files)
    if timings:
        for words, seconds in {**found.stages, **times}.items():
            say(f"{seconds:6.1f} s  {words}", ERR if json else OUT)
    return found


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
    except SlipwiseError as error:  # the verdict stands, and is written
        say(f"no law could be looked for: {error}", console)
        return found
    if found.law:
        from slipwise.view.words.diagnosis_words import law_words

        say(law_words(found), console)
    return found


def _tell(found: "sw.Diagnosis") -> None:
    """Print the verdict, what each effect changes, its rivals and what it rests on."""
    from slipwise.view.words.diagnosis_words import cannot_tell_words, error_name, floors, four_answers
    from slipwise.view.words.limit_words import limit_rows, power_rows, power_words
    from slipwise.view.words.terminal import print_table
    from slipwise.view.words.why_not_words import why_not_words

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
    for why in found.why_not:
        say(f"Why not {why.effect}?")
        for words in why_not_words(why):
            say(f"  {words}")
    if found.power:
        say(power_words(found))
        if rows := limit_rows(found, brief=True):
            shown = [{key: row[key] for key in ("effect", "at most", "of what matters")} for row in rows]
            print_table("Not named, and possibly there at a size that matters: at most so large (95 %)", shown)
        print_table("Each effect at the limit of what matters, in campaigns like this one", power_rows(found))
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
    counts = f"candidates compared: {screened}, hypotheses refitted: {refitted}"
    OUT.print(f"{counts}; {found.seconds:.0f} s; {found.stopped}")
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
