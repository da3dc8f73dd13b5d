"""`slipwise effects`: the catalogue, from the effects' own files."""

from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import OUT, print_json, say


def effects(
    name: Annotated[str, typer.Argument(help="One effect, or a file of your own; all of them if not given.")] = "",
    json: Annotated[bool, typer.Option("--json", help="Print JSON for a program to read.")] = False,
    source: Annotated[bool, typer.Option("--source", help="Print its file: a model for one of your own.")] = False,
    picture: Annotated[Path | None, typer.Option(help="Draw what the effect does at typical size (.png).")] = None,
) -> None:
    """List the effects, or show one: equation, sources, parameters, rivals.

    Example: `slipwise effects heating --picture heating.png`
    """
    from slipwise.errors import SettingError
    from slipwise.view.effects import effect_rows, print_effect, print_effects

    if not name:
        if source or picture:
            raise SettingError("--source and --picture show one effect; say which: slipwise effects heating --source")
        if json:
            print_json(effect_rows())
        else:
            print_effects(console=OUT)
        return
    effect = sw.effects.find_effect(name)
    if json:
        print_json(effect_rows([effect])[0])
    elif source:
        typer.echo(effect.path.read_text(encoding="utf-8"), nl=False)
    else:
        print_effect(effect, OUT)
        for words in _asks(effect):
            say(words)
    if picture:
        from slipwise.view.canvas import save_figure
        from slipwise.view.effects import effect_picture
        from slipwise.view.style import styled

        if picture.suffix != ".png":
            raise SettingError(f"--picture {picture}: pictures are written as .png")
        with styled():
            saved = save_figure(effect_picture(effect), picture)
        if not json and not source:
            say(f"Picture: {saved}")


def _asks(effect: "sw.Effect") -> list[str]:
    """Say whether an effect turns the girder, and what a campaign must have for it to be tested."""
    turns = "yes, yaw belongs to its fit" if effect.turns else "no"
    needs = [f"Needs {need}; not tested otherwise: {sw.effects.NEEDS[need]}." for need in effect.all_needs]
    needs += [f"Needs pad_*{other} as well on a pad_*{ending}." for ending, other in effect.gauges.reads.items()]
    every = "Needs nothing beside what every fit needs: slip, and load and friction of a pad."
    return [f"Turns the girder about the vertical (yaw): {turns}.", *(needs or [every])]


def register(app: typer.Typer) -> None:
    """Add this command to the command line."""
    app.command()(effects)
