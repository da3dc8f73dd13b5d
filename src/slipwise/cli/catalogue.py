"""`slipwise rigs`, `channels`, `motions`: what there is, from the code itself."""

from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import print_json, say_next
from slipwise.errors import SettingError

Json = Annotated[bool, typer.Option("--json", help="Print JSON for a program to read.")]


def rigs(
    rig: Annotated[
        str | None, typer.Argument(help="One rig: a name, a folder, a specimen.toml or an MJCF file.")
    ] = None,
    new: Annotated[
        str | None, typer.Option("--new", help="Begin a rig of this name: a folder with specimen.toml and its MJCF.")
    ] = None,
    mjcf: Annotated[bool, typer.Option("--mjcf", help="Write the MJCF of a specimen.toml beside it.")] = False,
    json: Json = False,
) -> None:
    """List the rigs with their rated values, begin one, or write its MJCF.

    Example: `slipwise rigs --new my_rig`, then edit my_rig/specimen.toml and
    `slipwise replay sine:2Hz,0.3g --rig my_rig --out out/mine`
    """
    if new is not None:
        path, written = sw.rig.new_rig(new, Path.cwd())
        typer.echo(f"wrote {path.relative_to(Path.cwd())}: the places, sizes and masses of the rig")
        typer.echo(f"wrote {written.relative_to(Path.cwd())}: its MJCF; after edits `slipwise rigs {new} --mjcf` again")
        say_next(f"edit {path.relative_to(Path.cwd())}, then `slipwise replay sine:2Hz,0.3g --rig {new} --out DIR`")
        return
    if mjcf:
        if rig is None:
            raise SettingError("--mjcf needs the rig: `slipwise rigs my_rig --mjcf`")
        typer.echo(f"wrote {sw.rig.write_mjcf(sw.rig.load_specimen(rig))}")
        say_next(f"`slipwise replay sine:2Hz,0.3g --rig {quote(rig)} --out DIR`")
        return
    rows = []
    for name in sw.rig.RIGS if rig is None else (rig,):
        specimen = sw.rig.load_specimen(name)
        rows.append(
            {
                "rig": specimen.name,
                "mass [t]": specimen.carried_mass / 1e3,
                "pads": len(specimen.pads),
                "pressure [MPa]": round(specimen.rated_pressure / 1e6, 2),
                "buffers [kN/mm]": round(sum(specimen.buffer_stiffness) / 1e6, 3),
                "frequency [Hz]": round(specimen.frequency, 3),
                "h/b": round(specimen.slenderness, 3) if specimen.free else None,
                "file": specimen.path.name,
            }
        )
    if rig is None and not json:  # a rig that ships lies in a file of its own name
        rows = [{key: value for key, value in row.items() if key != "file"} for row in rows]
    one = quote(rig) if rig else "bridge1"
    _show("Rigs", rows, json, f"`slipwise replay sine:2Hz,0.3g --rig {one}`", "`slipwise rigs --new my_rig` begins one")


def channels(json: Json = False) -> None:
    """List the channels: name, unit, where it is measured, what a positive value means.

    Example: `slipwise channels`
    """
    known = sw.channels.CHANNELS.values()
    rows = [{"channel": c.name, "unit": c.shown_in, "where": c.place, "positive": c.sign} for c in known]
    _show("Channels", rows, json, "`slipwise init FOLDER` finds them in the columns of your files")


def motions(json: Json = False) -> None:
    """List the synthetic motions and the formats of recorded ones that can be read.

    Example: `slipwise motions`
    """
    from slipwise.view.words.terminal import print_table

    made = [
        {"motion": m.name, "syntax": m.syntax, "meaning": m.meaning, "example": m.example}
        for m in sw.motion.synthetic_motions()
    ]
    read = [{"format": f.name, "note": f.note} for f in sw.motion.FORMATS]
    if json:
        print_json({"synthetic": made, "formats": read})
        return
    print_table("Synthetic motions", made)
    print_table("Recorded motions", read)
    say_next("`slipwise replay MOTION --out DIR`, with a line of the examples or with files")


def _show(title: str, rows: list[dict], json: bool, *steps: str) -> None:
    from slipwise.view.words.terminal import print_table

    if json:
        print_json(rows)
    else:
        print_table(title, rows)
        say_next(*steps)
