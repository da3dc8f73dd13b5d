"""`slipwise ensemble`: many motions, many scales, and numbers that are known within ranges only."""

from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import counting, out_folder, print_json, say, say_next
from slipwise.cli.workers import Cluster, Workers, chosen_executor


def ensemble(
    motion: Annotated[
        list[str], typer.Argument(help="Motions, each a file or a synthetic one: see `slipwise motions`.")
    ],
    out: Annotated[Path, typer.Option(help="Folder for members.parquet, the tables and the finished replays.")] = Path(
        "out/ensemble"
    ),
    scale: Annotated[str, typer.Option(help="Factors on each motion's acceleration: FIRST:LAST:STEP, or one.")] = "1",
    vary: Annotated[
        list[str] | None,
        typer.Option(
            help="Draw a number, uniform: KEY=LOW..HIGH with a unit, as rig.mass=9..11t or shear_rate.rate=10..30s/m. "
            "KEY is rig. and a name of campaign.toml's [specimen], or an effect of the model and its parameter; may be "
            "repeated."
        ),
    ] = None,
    members: Annotated[
        int, typer.Option(help="Draws, which every motion meets at every scale; a power of 2 suits sobol best.")
    ] = 128,
    sampling: Annotated[str, typer.Option(help="sobol or latin (hypercube).")] = "sobol",
    seed: Annotated[int, typer.Option(help="Of the draws; the same gives the same members.parquet.")] = 1,
    limit: Annotated[
        list[str] | None,
        typer.Option(help="Count what exceeds it: RESPONSE=VALUE, e.g. slip_x=30mm or pad_load=60kN; may be repeated."),
    ] = None,
    rig: Annotated[
        str, typer.Option(help="A name of slipwise rigs, or the path of a specimen.toml or an MJCF file.")
    ] = "bridge1",
    effect: Annotated[
        list[str] | None, typer.Option(help="Switch an effect on, by name or file, at its typical size.")
    ] = None,
    law: Annotated[str, typer.Option(help="paper (eqs. 7 and 8) or coulomb: what the effects are added to.")] = "paper",
    workers: Workers = None,
    cluster: Cluster = None,
    json: Annotated[bool, typer.Option("--json", help="Print ensemble.json for a program to read.")] = False,
) -> None:
    """Shake a rig whose numbers are uncertain by many motions at many scales; tables as for fragility curves.

    Killed and called again with the same `--out`, it goes on where it stopped.

    Example: `slipwise ensemble quake:seed=1,peak=0.4g quake:seed=2,peak=0.4g --scale 0.5:3:0.5 --vary rig.mass=9..11t`
    """
    from slipwise.view.files import save_json, save_rows
    from slipwise.view.words.ensemble_tables import ensemble_json, exceedance_rows, printed_tables, quantile_rows

    folder = out_folder(out)
    with chosen_executor(cluster) as executor, counting("replays") as tell:
        found = sw.ensemble.run_scaled(
            motion, folder, rig=rig, law=law, effects=effect or (), vary=vary or (), scales=scale, members=members,
            sampling=sampling, seed=seed, limits=limit or (), executor=executor, workers=workers, progress=tell,
        )  # fmt: skip
    files = [found.path, save_rows(quantile_rows(found), folder / "quantiles.csv")]
    if found.exceedances:
        files.append(save_rows(exceedance_rows(found), folder / "exceedance.csv"))
    content = ensemble_json(found)
    files.append(save_json(content, folder / "ensemble.json"))
    if json:
        print_json(content)
        return
    _tell(found, printed_tables(found))
    for path in files:
        say(f"wrote {path}")
    say_next(
        f"open {folder / 'quantiles.csv'} in a spreadsheet", "the same command with --limit counts what exceeds it"
    )


def _tell(found: "sw.ensemble.Ensemble", tables: list) -> None:
    from slipwise.view.words.terminal import print_table

    for title, rows in tables:
        print_table(title, rows)
    drawn = "; ".join(f"{v.key} {v.low:g} to {v.high:g} {v.unit}" for v in found.varied) or "nothing is varied"
    count = len(found.motions) * len(found.scales) * found.members
    say(f"{found.members} members at each motion and scale: {drawn}")
    speed = f", {found.run / found.seconds:.1f} a second" if found.run else ""
    say(f"{count} replays, {found.run} of them now in {found.seconds:.0f} s{speed}")
