"""`slipwise export`: a fitted rig in the words of other structural programs."""

from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import print_json, say, steps
from slipwise.cli.options import Allowed, Json, Trusted
from slipwise.errors import SettingError

app = typer.Typer(no_args_is_help=True, rich_markup_mode="markdown", help="Write a fitted rig for another program.")

ModelOrRig = Annotated[str, typer.Argument(help="A model.toml, or a name of `slipwise rigs` with --law.")]
Law = Annotated[str, typer.Option(help="paper (eqs. 7 and 8) or coulomb: the law of a rig that is given by its name.")]


@app.command()
def opensees(
    model: ModelOrRig,
    motion: Annotated[list[str], typer.Option(help="Of the table: a file or a synthetic one; files may be repeated.")],
    out: Annotated[Path, typer.Option(help="The script; motion and results are written beside it.")] = Path(
        "out/export/rig.py"
    ),
    law: Law = "paper",
    effect: Allowed = None,
    trust: Trusted = False,
    run: Annotated[bool, typer.Option(help="Run the script too, where OpenSeesPy is installed.")] = True,
    json: Json = False,
) -> None:
    """Write a rig as an OpenSeesPy script, say what that program cannot express, and what it costs.

    Sliders get the friction model that is nearest over the pressures and speeds of our replay. The script runs alone,
    and ends with the line `peak slip x [mm]: VALUE`.

    Example: `slipwise export opensees model.toml --motion quake:seed=1,peak=0.7g --out out/rig.py`
    """
    from slipwise.view.files import save_json
    from slipwise.view.words.export_tables import effect_rows, friction_rows, response_rows
    from slipwise.view.words.terminal import print_table

    wanted, shaking = _model(model, law, trust, effect), sw.load_motion(motion)
    with steps() as tell:
        found = sw.export_opensees(wanted, shaking, out, run=run, progress=tell)
    content = found.as_json()
    file = save_json(content, out.with_suffix(".json"))
    if json:
        print_json(content)
        return
    print_table("Friction of the sliders", friction_rows(found))
    if rows := effect_rows(found):
        print_table("What OpenSees has of the model; peak slip x of our replay without what it lacks", rows)
    for words in found.remarks:
        say(f"differs: {words}")
    print_table("The same run in both programs", response_rows(found))
    say(found.sentence)
    for path in (found.script, found.data, file):
        say(f"wrote {path}")


@app.command()
def sap2000(
    model: ModelOrRig,
    campaign: Annotated[
        Path | None, typer.Option(help="Folder with campaign.toml, over whose pressures and speeds links are fitted.")
    ] = None,
    motion: Annotated[
        list[str] | None, typer.Option(help="A table motion instead, over whose replay they are fitted.")
    ] = None,
    out: Annotated[Path, typer.Option(help="The table of link properties.")] = Path("out/export/links.csv"),
    law: Law = "paper",
    effect: Allowed = None,
    trust: Trusted = False,
    json: Json = False,
) -> None:
    """Write link properties for SAP2000: friction slow and fast, rate, stiffness, radius.

    Example: `slipwise export sap2000 campaigns/march/model.toml --campaign campaigns/march --out out/links.csv`
    """
    from slipwise.view.files import save_json, save_rows
    from slipwise.view.words.export_tables import link_rows, short_link_rows
    from slipwise.view.words.terminal import print_table

    wanted = _model(model, law, trust, effect)
    shaking = sw.load_motion(motion) if motion else None
    with steps() as tell:
        found = sw.export_sap2000(wanted, campaign, shaking, progress=tell)
    files = [save_rows(link_rows(found), out), save_json(found.as_json(), out.with_suffix(".json"))]
    if json:
        print_json(found.as_json())
        return
    sliders, springs = short_link_rows(found)
    print_table(f"Friction isolators, fitted over {found.fitted_over}; kN, m, s", sliders)
    if springs:
        print_table("Buffers; kN, m, s", springs)
    for words in found.left_out:
        say(f"not in the links: {words}")
    for path in files:
        say(f"wrote {path}")


def _model(given: str, law: str, trust: bool, allowed: list[str] | None) -> "sw.Model":
    """Return the model that is meant: a file, or a rig with a law."""
    if law not in ("paper", "coulomb"):
        raise SettingError(f"--law {law!r}: possible are paper and coulomb")
    path = Path(given)
    if path.suffix == ".toml" and path.name != "specimen.toml":
        return sw.load_model(path, trust=trust or allowed or ())
    return sw.base_model(given, None if law == "paper" else ())
