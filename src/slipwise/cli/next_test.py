"""`slipwise next`: which table motion would tell the rivals apart."""

from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import out_folder, print_json, say, say_corrections, say_next, steps
from slipwise.cli.options import CampaignFolder, Json, ModelFile, Own, Trusted, own_effects, start_model


def next_motion(
    campaign: CampaignFolder,
    out: Annotated[Path | None, typer.Option(help="Folder for next.json.")] = None,
    stroke: Annotated[str, typer.Option(help="How far the table goes from its middle.")] = "300 mm",
    speed: Annotated[str, typer.Option(help="The table's largest speed.")] = "1.5 m/s",
    acceleration: Annotated[str, typer.Option(help="The table's largest acceleration.")] = "1 g",
    model: ModelFile = None,
    effect: Own = None,
    trust: Trusted = False,
    json: Json = False,
) -> None:
    """Rank table motions by how well they would tell the remaining rivals apart.

    A motion beyond the table's limits is made smaller until the table can make it. Every rival is shaken with every
    motion, and every rival fitted to what comes out.

    Example: `slipwise next campaigns/march --stroke "150 mm"`
    """
    from slipwise.view.files import save_json

    limits = sw.Limits(
        sw.quantity(stroke, "m", "--stroke"),
        sw.quantity(speed, "m/s", "--speed"),
        sw.quantity(acceleration, "m/s^2", "--acceleration"),
    )
    measured = sw.load_campaign(campaign)
    start = start_model(campaign, model, trust, effect)
    own = own_effects(effect, start)
    folder = None if out is None else out_folder(out)
    with steps() as tell:
        ranked = sw.next_test(measured, limits, progress=tell, model=start, own=own)
    content = ranked.as_json()
    if folder is not None:
        save_json(content, folder / "next.json")
    if json:
        print_json(content)
    else:
        _tell(ranked)
        if folder is not None:
            say(f"wrote {folder / 'next.json'}")
        say_next(*_next_steps(ranked, campaign))


def _next_steps(ranked: "sw.NextTest", campaign: Path) -> list[str]:
    best = next((p.motion for p in ranked.proposals if not p.refused and not p.failed), None)
    if best is None or ranked.gain <= 0.0:
        return [f"`slipwise workbench {quote(str(campaign))}`"]
    return [
        f"shake the rig by {best}, add the run to campaign.toml, and `slipwise diagnose {quote(str(campaign))}` again",
        f"see it first: `slipwise replay {quote(best)}`",
    ]


def _tell(ranked: "sw.NextTest") -> None:
    """Print the verdict, what is held against what, and the motions; those that cannot be made or judged apart."""
    from slipwise.view.words.terminal import print_table

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
    say_corrections(ranked.corrections)
    if not ranked.proposals:
        say(ranked.words)
    say(f"{ranked.sentence}\n{told}{':' if rows else '.'}")
    if not ranked.proposals:
        return
    if rows:
        print_table("What each motion would tell; separation in variances of the noise", rows)
    left = [f"the table cannot make {p.motion}: {p.refused}" for p in ranked.proposals if p.refused]
    left += [f"{p.motion} could not be judged: {p.failed}" for p in ranked.proposals if p.failed]
    for words in (*left, *filter(None, [ranked.words])):
        say(words)
