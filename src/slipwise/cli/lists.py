"""`slipwise rigs`, `channels`, `motions`: what there is, from the code itself."""

from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import print_json

Json = Annotated[bool, typer.Option("--json", help="Print JSON for a program to read.")]


def rigs(json: Json = False) -> None:
    """List the rigs with their rated values.

    Example: `slipwise rigs`
    """
    rows = []
    for name in sw.rig.RIGS:
        specimen = sw.rig.load_specimen(name)
        rows.append(
            {
                "rig": name,
                "mass [t]": specimen.mass / 1e3,
                "pads": len(specimen.pads),
                "pressure [MPa]": round(specimen.rated_pressure / 1e6, 2),
                "buffers [kN/mm]": round(sum(specimen.buffer_stiffness) / 1e6, 3),
                "frequency [Hz]": round(specimen.frequency, 3),
                "h/b": round(specimen.slenderness, 3) if specimen.free else None,
                "file": specimen.path.name,
            }
        )
    _show("Rigs", rows, json)


def channels(json: Json = False) -> None:
    """List the channels: name, unit, where it is measured, what a positive value means.

    Example: `slipwise channels`
    """
    known = sw.channels.CHANNELS.values()
    rows = [{"channel": c.name, "unit": c.shown_in, "where": c.place, "positive": c.sign} for c in known]
    _show("Channels", rows, json)


def motions(json: Json = False) -> None:
    """List the synthetic motions and the formats of recorded ones that can be read.

    Example: `slipwise motions`
    """
    from slipwise.view.terminal import print_table

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


def _show(title: str, rows: list[dict], json: bool) -> None:
    from slipwise.view.terminal import print_table

    if json:
        print_json(rows)
    else:
        print_table(title, rows)


def register(app: typer.Typer) -> None:
    """Add these commands to the command line."""
    for command in (rigs, channels, motions):
        app.command()(command)
