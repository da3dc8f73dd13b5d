"""`slipwise next`: which table motion would tell the rivals apart."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from slipwise.campaign import load_campaign
from slipwise.cli.console import OUT, out_folder, print_json
from slipwise.cli.diagnose import CampaignFolder, Json, ModelFile, Own, own_effects, start_model, steps
from slipwise.record import write_json
from slipwise.units import quantity

if TYPE_CHECKING:
    from slipwise.experiment.next_test import NextTest


def next_motion(
    campaign: CampaignFolder,
    out: Annotated[Path | None, typer.Option(help="Folder for next.json.")] = None,
    stroke: Annotated[str, typer.Option(help="How far the table goes from its middle.")] = "300 mm",
    speed: Annotated[str, typer.Option(help="The table's largest speed.")] = "1.5 m/s",
    acceleration: Annotated[str, typer.Option(help="The table's largest acceleration.")] = "1 g",
    model: ModelFile = None,
    effect: Own = None,
    json: Json = False,
) -> None:
    """Rank table motions by how well they would tell the remaining rivals apart.

    A motion beyond the table's limits is made smaller until the table can make it. Every rival is shaken with every
    motion, and every rival fitted to what comes out.

    Example: `slipwise next campaigns/march --stroke "150 mm"`
    """
    from slipwise.diagnosis.diagnose import diagnose
    from slipwise.experiment.motions import Limits
    from slipwise.experiment.next_test import next_test, refuse_prescribed

    limits = Limits(
        quantity(stroke, "m", "--stroke"),
        quantity(speed, "m/s", "--speed"),
        quantity(acceleration, "m/s^2", "--acceleration"),
    )
    measured = load_campaign(campaign)
    refuse_prescribed(measured)
    start, own = start_model(campaign, model), own_effects(effect)
    folder = None if out is None else out_folder(out)
    with steps() as tell:
        found = diagnose(measured, start, own=own, progress=lambda words, share: tell(words, 0.5 * share))
        ranked = next_test(found, limits, progress=lambda words, share: tell(words, 0.5 + 0.5 * share))
    rows = [
        {
            "motion": p.motion,
            "separation": round(p.separation, 3),
            "in": p.relation,
            "probability then": round(p.probability, 3),
            "table": p.refused or "can make it",
            "failed": p.failed,
        }
        for p in ranked.proposals
    ]
    content = {
        "best": list(ranked.rivals[0]),
        "rival": list(ranked.rivals[1]),
        "probability": round(ranked.chances[0], 3),
        "rivals": [
            {"effects": list(names), "probability": round(chance, 3)}
            for names, chance in zip(ranked.rivals, ranked.chances, strict=True)
        ],
        "words": ranked.words,
        "motions": rows,
    }
    if folder is not None:
        write_json(folder / "next.json", content)
    if json:
        print_json(content)
    else:
        _tell(found.sentence, ranked)
        if folder is not None:
            OUT.print(f"wrote {folder / 'next.json'}", markup=False, highlight=False, soft_wrap=True)


def _tell(sentence: str, ranked: "NextTest") -> None:
    """Print the verdict, what is held against what, and the motions; those that cannot be made or judged apart."""
    from slipwise.view.terminal import print_table

    each = zip(ranked.rivals, ranked.chances, strict=True)
    told = " against ".join(f"{' + '.join(names) or 'the base model'} ({100 * c:.0f} %)" for names, c in each)
    rows = [
        {
            "motion": p.motion,
            "separation": round(p.separation, 3),
            "in": p.relation,
            "probability then": round(p.probability, 3),
        }
        for p in ranked.proposals
        if not p.refused and not p.failed
    ]
    OUT.print(f"{sentence}\n{told}:", markup=False, highlight=False, soft_wrap=True)
    if rows:
        print_table("What each motion would tell; separation in variances of the noise", rows)
    left = [f"the table cannot make {p.motion}: {p.refused}" for p in ranked.proposals if p.refused]
    left += [f"{p.motion} could not be judged: {p.failed}" for p in ranked.proposals if p.failed]
    for words in (*left, *filter(None, [ranked.words])):
        OUT.print(words, markup=False, highlight=False, soft_wrap=True)


def register(app: typer.Typer) -> None:
    """Add this command to the command line."""
    app.command("next")(next_motion)
