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
    if not found.laws:
        say(f"no law was found in {folder}")
        say_next("`slipwise discover CAMPAIGN` looks for one")
        return
    shares = ("" if law.share is None else f"{100.0 * law.share:.0f} %" for law in found.laws)
    rows = [{**law.as_row(), "held-out share": share} for law, share in zip(found.laws, shares, strict=True)]
    # files are too long for a table
    print_table(f"Laws in {folder}", [{k: v for k, v in row.items() if k not in ("file", "enters")} for row in rows])
    for law in found.laws:
        say(f"{law.name}: {law.file}")
    say_next(f"`slipwise diagnose CAMPAIGN --effect {quote(str(found.laws[0].file))}` says whether one holds elsewhere")
