"""`slipwise add` and `slipwise remove`: edit model.toml, refit, and print the error before and after."""

from collections.abc import Callable
from pathlib import Path
from shlex import quote
from typing import Annotated

import typer
from rich.console import Console

import slipwise as sw
from slipwise.cli.console import OUT, say, say_next, steps
from slipwise.cli.options import Allowed, Trusted, refuse_unnamed

Folder = Annotated[Path, typer.Option("--campaign", help="Folder with campaign.toml; model.toml is kept there too.")]


def add(
    name: Annotated[str, typer.Argument(help="An effect of `slipwise effects`, or a file of your own: ./mine.py.")],
    campaign: Folder = Path(),
    effect: Allowed = None,
    trust: Trusted = False,
) -> None:
    """Add an effect to model.toml, refit everything, and print the error before and after.

    `slipwise workbench` shows it as a step that can be undone.

    Example: `slipwise add run_in --campaign campaigns/march`
    """
    _change(sw.add, name, campaign, trust, effect)


def remove(
    name: Annotated[str, typer.Argument(help="Name of an effect of model.toml.")],
    campaign: Folder = Path(),
    effect: Allowed = None,
    trust: Trusted = False,
) -> None:
    """Take an effect out of model.toml, refit everything, and print the error before and after.

    `slipwise workbench` shows it as a step that can be undone.

    Example: `slipwise remove run_in --campaign campaigns/march`
    """
    _change(sw.remove, name, campaign, trust, effect)


def _change(
    change: "Callable[..., sw.ModelChange]", name: str, campaign: Path, trust: bool, allowed: list[str] | None
) -> None:
    session = sw.Session(campaign, trust=trust or allowed or (), resume=False)
    try:
        refuse_unnamed(allowed, session.model)
        with steps() as tell:
            changed = change(name, session, progress=tell)
        tell_change(changed, held_out=bool(session.campaign.with_role("holdout")))
        for words in changed.remarks:
            say(words)
        say(f"wrote {session.accept()}")
        place = quote(str(campaign))
        say_next(f"`slipwise diagnose {place}`: is something else missing?", f"`slipwise workbench {place}` undoes it")
    finally:
        session.close()


def tell_change(changed: "sw.ModelChange", *, held_out: bool, console: Console = OUT) -> None:
    """Print the errors before and after."""
    from slipwise.view.words.terminal import print_table

    which = "Held-out error" if held_out else "Error of the runs that were fitted"
    print_table(f"{which} in multiples of the noise floor", changed.rows(), console)
