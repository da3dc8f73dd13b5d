"""`slipwise demo`: the whole promise on data that ships with the package."""

import shutil
import time
from importlib.resources import files
from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import OUT, can_record, out_folder, say, say_next, steps
from slipwise.cli.diagnose import print_effects, print_rungs

#: Worst places of the error that are told.
_TOLD = 3


def demo(
    out: Annotated[Path, typer.Option(help="Folder for the campaign, the report and the recording.")] = Path(
        "out/demo"
    ),
) -> None:
    """Show the whole promise: a campaign with a hidden effect, compared, located, named, added, and the error falling.

    Example: `slipwise demo`
    """
    from slipwise.view.files import save_json, save_page
    from slipwise.view.geometry import geometry_of
    from slipwise.view.pages.diagnosis_page import diagnosis_page
    from slipwise.view.words.diagnosis_words import floors
    from slipwise.view.words.numbers import counted, in_words
    from slipwise.view.words.terminal import print_table

    began = time.perf_counter()
    folder = out_folder(out)
    campaign = folder / "campaign"
    _copy(campaign)
    measured = sw.load_campaign(campaign)
    rig, unseen = measured.specimen, len(measured.with_role("holdout"))
    fitted = len(measured.runs) - unseen
    _say(
        "1  A laboratory has shaken a girder",
        f"A girder of {rig.mass / 1e3:g} t on {counted(len(rig.pads), 'PTFE pad')} and "
        f"{counted(len(rig.buffer_stiffness), 'rubber buffer')} (the rig of Takahashi et al., 2004): "
        f"{counted(len(measured.runs), 'run')} on the shaking table. They lie in {campaign}. A second simulator made "
        "them, with one physical effect hidden in it.",
    )
    runs = [{"run": r.name, "role": r.role, "seconds": round(float(r.record.time[-1]), 1)} for r in measured.runs]
    print_table("Runs", runs)
    with steps() as tell:
        compared = sw.compare(measured, system=False, progress=tell)
    _say(
        f"2  The paper's model, fitted to {counted(fitted, 'run')}, is held against the {in_words(unseen)} that it has "
        "not seen",
        "Each balance of the rig answers for itself; 1 is the noise floor, what a perfect model would leave.",
    )
    errors = {n: compared.error(n, held_out=True) for n in compared.relations}
    rows = [
        {"balance": n, "held-out error [noise floors]": "" if error is None else floors(error)}
        for n, error in errors.items()
    ]
    print_table("Where the model fails", rows)
    for place in compared.places[:_TOLD]:
        say(f"  - {place.words}")
    with steps() as tell:
        found = sw.diagnose(measured, system=True, progress=tell)
    ladder = found.ladder()
    _say("3  What is missing?", found.sentence)
    print_effects(found)
    hypotheses = [{"hypothesis": c.effect, "probability": f"{100 * c.probability:.1f} %"} for c in found.candidates]
    print_table(f"{ladder.tried[0]} candidates compared, {ladder.tried[1]} refitted", hypotheses)
    _say(
        "4  Add it, and watch the error fall",
        f"Refitted with {' and '.join(found.added) or 'nothing more'}, and judged by "
        f"{counted(unseen, 'held-out run')}, which no fit has seen. It stops here: {ladder.stopped}.",
    )
    print_rungs(ladder)
    sw.save_model(found.model, campaign / "model.toml")
    save_json(found.as_json(), folder / "diagnosis.json")
    save_json(ladder.as_json(), folder / "ladder.json")
    save_page(diagnosis_page(found, ladder), folder / "report.html")
    recorded = can_record(True)
    if recorded:
        from slipwise.view.recordings.comparison import write_comparison

        seen, simulated = found.replays()
        write_comparison(seen, simulated, geometry_of(rig), folder / "before_and_after.rrd", found.sentence)
    _say("5  Look at it", "The report opens in any browser, the recording in the rerun viewer:")
    for line in (
        f"{folder / 'report.html'}",
        *((f"slipwise view {folder}",) if recorded else ()),
        f"slipwise diagnose {campaign} --model {campaign / 'model.toml'}   ({found.left_over})",
        *(f"slipwise effects {name}   (what it is, and where it comes from)" for name in found.verdict.effects),
    ):
        say(f"  {line}")
    OUT.print(f"\n{time.perf_counter() - began:.0f} s")
    say_next("`slipwise init FOLDER`, with a folder of your own measured runs")


def _copy(campaign: Path) -> None:
    """Copy the packed campaign into the user's folder."""
    campaign.mkdir(parents=True, exist_ok=True)
    for entry in Path(str(files("slipwise"))).joinpath("demo_data").iterdir():
        shutil.copyfile(entry, campaign / entry.name)
    (campaign / "model.toml").unlink(missing_ok=True)


def _say(title: str, words: str) -> None:
    OUT.print(f"\n[bold]{title}[/bold]")
    OUT.print(words, markup=False, highlight=False)
