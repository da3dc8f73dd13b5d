"""`slipwise export`: a fitted rig in the words of other structural programs."""

from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import print_json, say, say_next, steps
from slipwise.cli.options import Allowed, Json, Trusted, refuse_unnamed
from slipwise.errors import SettingError, unknown_name

PROGRAMS = {"opensees": Path("out/export/rig.py"), "sap2000": Path("out/export/links.csv")}


def export(
    program: Annotated[str, typer.Argument(help="opensees or sap2000.")],
    model: Annotated[str, typer.Argument(help="A model.toml, or a name of `slipwise rigs` with --law.")],
    motion: Annotated[
        list[str] | None,
        typer.Option(help="Of the table: a file or a synthetic one; files of one record are repeated."),
    ] = None,
    campaign: Annotated[
        Path | None, typer.Option(help="sap2000: a campaign, over whose pressures and speeds links are fitted.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option(help="The script rig.py, or the table links.csv; other files are written beside it.")
    ] = None,
    law: Annotated[str, typer.Option(help="paper (eqs. 7 and 8) or coulomb: of a rig given by its name.")] = "paper",
    effect: Allowed = None,
    trust: Trusted = False,
    run: Annotated[bool, typer.Option(help="Run the script too, where OpenSeesPy is installed.")] = True,
    json: Json = False,
) -> None:
    """Write a rig for another program, and say what that cannot express and what it costs.

    opensees: an OpenSeesPy script that runs alone and ends with the line `peak slip x [mm]: VALUE`. Its sliders have
    the friction model that is nearest over the pressures and speeds of our replay; where OpenSeesPy is installed the
    script is run, and its responses held against ours. sap2000: a table of link properties, friction slow and fast,
    rate, stiffness and radius, fitted over the pressures and speeds of a campaign or of a motion.

    Example: `slipwise export opensees model.toml --motion quake:seed=1,peak=0.7g --out out/rig.py`
    """
    if program not in PROGRAMS:
        raise unknown_name("program", program, PROGRAMS)
    wanted = _model(model, law, trust, effect)
    refuse_unnamed(effect, wanted)
    shaking, path = (sw.load_motion(motion) if motion else None), out or PROGRAMS[program]
    if program == "sap2000":
        _links(wanted, campaign, shaking, path, json)
        return
    if shaking is None or campaign is not None:
        raise SettingError("a script for OpenSees shakes the rig by one motion: give --motion, and no --campaign")
    _script(wanted, shaking, path, run, json)


def _script(model: "sw.Model", shaking: "sw.TableMotion", out: Path, run: bool, json: bool) -> None:
    from slipwise.view.files import save_json
    from slipwise.view.words.export_tables import effect_rows, friction_rows, response_rows
    from slipwise.view.words.terminal import print_table

    with steps() as tell:
        found = sw.export_opensees(model, shaking, out, run=run, progress=tell)
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
    say_next(f"`python {found.script}` where OpenSeesPy is installed")


def _links(model: "sw.Model", campaign: Path | None, shaking: "sw.TableMotion | None", out: Path, json: bool) -> None:
    from slipwise.view.files import save_json, save_rows
    from slipwise.view.words.export_tables import link_rows, short_link_rows
    from slipwise.view.words.terminal import print_table

    with steps() as tell:
        found = sw.export_sap2000(model, campaign, shaking, progress=tell)
    content = found.as_json()
    files = [save_rows(link_rows(found), out), save_json(content, out.with_suffix(".json"))]
    if json:
        print_json(content)
        return
    sliders, springs = short_link_rows(found)
    print_table(f"Friction isolators, fitted over {found.fitted_over}; kN, m, s", sliders)
    if springs:
        print_table("Buffers; kN, m, s", springs)
    for words in found.left_out:
        say(f"not in the links: {words}")
    for path in files:
        say(f"wrote {path}")
    say_next("give each link of the office's model its row")


def _model(given: str, law: str, trust: bool, allowed: list[str] | None) -> "sw.Model":
    """Return the model that is meant: a file, or a rig with a law."""
    if law not in ("paper", "coulomb"):
        raise SettingError(f"--law {law!r}: possible are paper and coulomb")
    path = Path(given)
    if path.suffix == ".toml" and path.name != "specimen.toml":
        return sw.load_model(path, trust=trust or allowed or ())
    return sw.base_model(given, None if law == "paper" else ())
