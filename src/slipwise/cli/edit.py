"""`slipwise add` and `slipwise remove`: edit model.toml, refit, and print the error before and after."""

from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import say, steps
from slipwise.cli.diagnose import Allowed, Trusted, start_model

Folder = Annotated[Path, typer.Option("--campaign", help="Folder with campaign.toml; model.toml is kept there too.")]


def add(
    name: Annotated[str, typer.Argument(help="An effect of `slipwise effects`, or a file of your own: ./mine.py.")],
    campaign: Folder = Path(),
    effect: Allowed = None,
    trust: Trusted = False,
) -> None:
    """Add an effect to model.toml, refit everything, and print the error before and after.

    Example: `slipwise add run_in --campaign campaigns/march`
    """
    measured = sw.load_campaign(campaign)
    with steps() as tell:
        changed = sw.add(name, measured, start_model(campaign, None, trust, effect), progress=tell)
    _finish(changed, campaign, held_out=bool(measured.with_role("holdout")))


def remove(
    name: Annotated[str, typer.Argument(help="Name of an effect of model.toml.")],
    campaign: Folder = Path(),
    effect: Allowed = None,
    trust: Trusted = False,
) -> None:
    """Take an effect out of model.toml, refit everything, and print the error before and after.

    Example: `slipwise remove run_in --campaign campaigns/march`
    """
    measured = sw.load_campaign(campaign)
    with steps() as tell:
        changed = sw.remove(name, measured, start_model(campaign, None, trust, effect), progress=tell)
    _finish(changed, campaign, held_out=bool(measured.with_role("holdout")))


def _finish(changed: "sw.ModelChange", campaign: Path, *, held_out: bool) -> None:
    from slipwise.view.terminal import print_table

    which = "Held-out error" if held_out else "Error of the runs that were fitted"
    print_table(f"{which} in multiples of the noise floor", changed.rows())
    path = campaign / "model.toml"
    sw.save_model(changed.model, path)
    say(f"wrote {path}")


def register(app: typer.Typer) -> None:
    """Add these commands to the command line."""
    app.command()(add)
    app.command()(remove)
