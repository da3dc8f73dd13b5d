"""`slipwise laws`: the laws that were found in the campaigns of a folder."""

from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import print_json, say, say_next
from slipwise.cli.options import Json


def laws(
    folder: Annotated[Path, typer.Argument(help="Folder with what `slipwise discover` wrote, at any depth.")] = Path(
        "out"
    ),
    json: Json = False,
) -> None:
    """List the laws that were found: held-out share, range, date, and forms that cannot be told apart.

    Example: `slipwise laws out`
    """
    from slipwise.view.words.terminal import print_table

    found = sw.list_laws(folder)
    if json:
        print_json(found.as_json())
        return
    rows = [
        {
            "law": law.name,
            "depends on": " and ".join(law.states),
            "form": " or ".join((law.form, *law.tied)),
            "held-out share": "" if law.share is None else f"{100.0 * law.share:.0f} %",
            "valid": "; ".join(f"{state} {low:.3g} to {high:.3g}" for state, (low, high) in law.valid.items()),
            "date": law.date,
            "campaign": law.campaign,
        }
        for law in found.laws
    ]
    if not rows:
        say(f"no law was found in {folder}")
        say_next("`slipwise discover CAMPAIGN` looks for one")
        return
    print_table(f"Laws in {folder}", rows)
    for law in found.laws:
        say(f"{law.name}: {law.file}")
    say_next(f"`slipwise diagnose CAMPAIGN --effect {quote(str(found.laws[0].file))}` says whether one holds elsewhere")
