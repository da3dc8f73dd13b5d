"""`slipwise next`: which table motion would tell the rivals apart."""

from pathlib import Path
from typing import Annotated

import typer

from slipwise.campaign import load_campaign
from slipwise.cli.console import OUT, print_json
from slipwise.cli.diagnose import CampaignFolder, Json, ModelFile, start_model, steps
from slipwise.record import write_json
from slipwise.units import quantity


def next_motion(
    campaign: CampaignFolder,
    out: Annotated[Path | None, typer.Option(help="Folder for next.json.")] = None,
    stroke: Annotated[str, typer.Option(help="The table's, from the middle.")] = "300 mm",
    speed: Annotated[str, typer.Option(help="The table's largest.")] = "1.5 m/s",
    acceleration: Annotated[str, typer.Option(help="The table's largest.")] = "1 g",
    model: ModelFile = None,
    json: Json = False,
) -> None:
    """Rank table motions by how well they would tell the remaining rivals apart.

    Example: `slipwise next campaigns/march --stroke "150 mm"`
    """
    from slipwise.diagnose import diagnose
    from slipwise.next_test import Limits, next_test

    limits = Limits(
        quantity(stroke, "m", "--stroke"),
        quantity(speed, "m/s", "--speed"),
        quantity(acceleration, "m/s^2", "--acceleration"),
    )
    measured = load_campaign(campaign)
    with steps() as tell:
        found = diagnose(measured, start_model(campaign, model), progress=lambda words, share: tell(words, 0.5 * share))
        ranked = next_test(found, limits, progress=lambda words, share: tell(words, 0.5 + 0.5 * share))
    rows = [
        {
            "motion": p.motion,
            "separation": round(p.separation, 3),
            "in": p.relation,
            "probability then": round(p.probability, 3),
            "table": p.refused or "can make it",
        }
        for p in ranked.proposals
    ]
    content = {"best": list(ranked.best), "rival": list(ranked.rival), "probability": ranked.now, "motions": rows}
    if out is not None:
        write_json(out / "next.json", content)
    if json:
        print_json(content)
        return
    from slipwise.view.terminal import print_table

    rival = " + ".join(ranked.rival) or "the base model"
    OUT.print(
        f"{' + '.join(ranked.best) or 'the base model'} ({100 * ranked.now:.0f} %) against {rival}:", markup=False
    )
    print_table("What each motion would tell; separation in variances of the noise", rows)


def register(app: typer.Typer) -> None:
    """Add this command to the command line."""
    app.command("next")(next_motion)
