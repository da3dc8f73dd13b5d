"""`slipwise consequence`: what a named effect means for the bridge."""

from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import counting, out_folder, print_json, say, say_next
from slipwise.cli.options import Allowed, Figures, Json, Trusted, refuse_unnamed
from slipwise.cli.workers import Cluster, Workers, chosen_executor


def consequence(
    model: Annotated[str, typer.Argument(help="The fitted model.toml, or a name of `slipwise rigs`.")],
    motions: Annotated[
        list[str] | None,
        typer.Option(
            help="Of the bridge: a file, a folder of records, or a synthetic motion; may be repeated. In a folder each "
            "folder is a record, and so are files that differ in their endings only, and PEER's of one number."
        ),
    ] = None,
    out: Annotated[
        Path, typer.Option(help="Folder for consequence.html, .png, .csv and .json, the members and both models.")
    ] = Path("out/consequence"),
    diagnosis: Annotated[
        Path | None, typer.Option(help="A diagnosis.json or its folder: what was named, and intervals of its sizes.")
    ] = None,
    without: Annotated[
        list[str] | None, typer.Option(help="Effect that the second model has not, instead of what was named.")
    ] = None,
    drawn: Annotated[int, typer.Option(help="Draw so many earthquakes of a quake: without a seed.")] = 0,
    spectrum: Annotated[
        Path | None, typer.Option(help="Scale each motion to this spectrum: columns period [s] and acceleration [g].")
    ] = None,
    length_scale: Annotated[
        float | None, typer.Option(help="Length of the bridge over the model's; of bridge1 and bridge2 it is known.")
    ] = None,
    vary: Annotated[
        list[str] | None, typer.Option(help="Draw a further number, uniform: KEY=LOW..HIGH, as `slipwise ensemble`.")
    ] = None,
    draws: Annotated[int, typer.Option(help="Draws of the sizes at each motion.")] = 1,
    seed: Annotated[int, typer.Option(help="Of the earthquakes and of the sizes.")] = 1,
    effect: Allowed = None,
    trust: Trusted = False,
    figures: Figures = False,
    workers: Workers = None,
    cluster: Cluster = None,
    json: Json = False,
) -> None:
    """Shake the model with many earthquakes, with what was named and without it: what does it mean for the bridge?

    Peak slip, residual slip, largest pad load and buffer force, at the model and at the bridge; sizes are drawn from
    their intervals. Killed and called again with the same `--out`, it goes on where it stopped.

    Example: `slipwise consequence march/model.toml --diagnosis out/march --drawn 200 --spectrum site.csv`
    """
    from slipwise.view.figures.canvas import save_figure
    from slipwise.view.figures.consequence_figure import consequence_figure
    from slipwise.view.figures.figure_files import figures_into
    from slipwise.view.files import save_json, save_page, save_rows
    from slipwise.view.pages.consequence_page import consequence_page
    from slipwise.view.words.consequence_tables import consequence_rows, short_rows
    from slipwise.view.words.terminal import print_table

    path = Path(model)
    given = sw.load_model(path, trust=trust or effect or ()) if path.suffix == ".toml" else sw.base_model(model)
    refuse_unnamed(effect, given)
    folder = out_folder(out)
    with chosen_executor(cluster) as executor, counting("replays") as tell:
        found = sw.consequence(
            given, motions or [], folder, diagnosis=diagnosis, without=without or (), vary=vary or (), drawn=drawn,
            draws=draws, spectrum=spectrum, length_scale=length_scale, seed=seed, executor=executor, workers=workers,
            progress=tell,
        )  # fmt: skip
    rows, content = consequence_rows(found), found.as_json()
    with figures_into(folder / "figures" if figures else None) as more:
        page = save_page(consequence_page(found), folder / "consequence.html")
    files = [page, save_figure(consequence_figure(found), folder / "consequence.png")]
    files += [save_rows(rows, folder / "consequence.csv"), save_json(content, folder / "consequence.json")]
    if json:
        print_json(content)
        return
    title = f"{found.earthquakes} earthquakes, without {' and '.join(found.named)} → with"
    print_table(title, short_rows(found, whole=False))
    for words in found.notes:
        say(f"note: {words}")
    say(found.sentence)
    for file in (*files, *more, found.path):
        say(f"wrote {file}")
    say_next(f"open {page}")
