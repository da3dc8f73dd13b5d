"""`slipwise effects`: the catalogue, from the effects' own files."""

from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import OUT, out_folder, print_json, say, say_next


def effects(
    name: Annotated[str, typer.Argument(help="One effect, or a file of your own; all of them if not given.")] = "",
    json: Annotated[bool, typer.Option("--json", help="Print JSON for a program to read.")] = False,
    source: Annotated[bool, typer.Option("--source", help="Print its file: a model for one of your own.")] = False,
    picture: Annotated[Path | None, typer.Option(help="Draw what the effect does at typical size (.png).")] = None,
    new: Annotated[str, typer.Option(help="Write NEW.py, an effect that works, to begin one of your own with.")] = "",
    port: Annotated[
        str | None,
        typer.Option(help="Where the new effect acts: shear (friction) if not given, pad, buffer, gauge ..."),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Folder for the new effect; this one if not given.")] = None,
) -> None:
    """List the effects, or show one: equation, sources, parameters, rivals. Or write a new one to begin with.

    Example: `slipwise effects heating --picture heating.png`, or `slipwise effects --new my_effect`
    """
    from slipwise.errors import SettingError
    from slipwise.view.words.effects import effect_rows, print_effect, print_effects

    if new:
        if name or source or picture or json:
            raise SettingError("--new writes a file: it goes with --port and --out only")
        _write_new(new, port, out)
        return
    if port is not None or out is not None:
        raise SettingError("--port and --out belong to a new effect: slipwise effects --new my_effect --port shear")
    if not name:
        if source or picture:
            raise SettingError("--source and --picture show one effect; say which: slipwise effects heating --source")
        if json:
            print_json(effect_rows())
        else:
            print_effects(console=OUT)
            say_next("`slipwise effects NAME` shows one", "`slipwise effects --new my_effect` begins one of your own")
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
        from slipwise.view.figures.canvas import save_figure
        from slipwise.view.figures.effect_picture import effect_picture
        from slipwise.view.figures.style import styled

        if picture.suffix != ".png":
            raise SettingError(f"--picture {picture}: pictures are written as .png")
        with styled():
            saved = save_figure(effect_picture(effect), picture)
        if not json and not source:
            say(f"Picture: {saved}")
    if not json and not source:
        say_next(f"`slipwise replay sine:2Hz,0.3g,cycles=12 --effect {quote(name)}` shakes Bridge 1 with it")


def _write_new(name: str, port: str | None, out: Path | None) -> None:
    """Write an effect to begin with, and say what to do next."""
    begun = sw.effects.skeleton(name) if port is None else sw.effects.skeleton(name, port)
    path = sw.effects.write_effect(begun, out_folder(out or Path()))
    file = quote(str(path) if path.is_absolute() or path.parts[0] == ".." else f"./{path.as_posix()}")
    say(f"wrote {file}: it works as it is; its comments say what to change")
    replay = f"slipwise replay sine:2Hz,0.3g,cycles=12 --effect {file} --out {quote(f'out/{name}')}"
    for command, words in (
        (f"slipwise effects {file}", "says what to mend, or shows it"),
        # a replay does not say which of the gauges is faulty
        *(((replay, "shakes Bridge 1"),) if not begun.target else ()),
        (f"slipwise add {file} --campaign CAMPAIGN", "fits it to your tests"),
        (f"slipwise diagnose CAMPAIGN --effect {file}", "lets it compete with the catalogue"),
    ):
        say(f"  {command}  # {words}")
    say_next(f"edit {file}, then `slipwise effects {file}`")


def _asks(effect: "sw.Effect") -> list[str]:
    """Say whether an effect turns the girder, what a campaign must have to test it, and where it is another effect."""
    turns = "yes, yaw belongs to its fit" if effect.turns else "no"
    needs = [f"Needs {need}; not tested otherwise: {effect.without(need)}." for need in effect.all_needs]
    needs += [f"Needs pad_*{other} as well on a pad_*{ending}." for ending, other in effect.gauges.reads.items()]
    every = "Needs nothing beside what every fit needs: slip, and load and friction of a pad."
    ends = [
        f"Where {at.parameter} ends on its {at.end} bound it is {at.becomes or 'one with the base law'}, and not named."
        for at in effect.limits
    ]
    return [f"Turns the girder about the vertical (yaw): {turns}.", *(needs or [every]), *ends]
