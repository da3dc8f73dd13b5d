"""`slipwise paper`: the whole paper re-enacted."""

from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import OUT, out_folder, print_json, progress, say, say_next

#: Motions of the ensemble in quick mode.
_QUICK = 8


def paper(
    out: Annotated[Path, typer.Option(help="Folder for paper.json, paper.html and the finished replays.")] = Path(
        "out/paper"
    ),
    readings: Annotated[
        list[str] | None, typer.Option(help="Change an assumption, NAME=VALUE with unit; the page lists them all.")
    ] = None,
    members: Annotated[int, typer.Option(help="Motions of the ensemble, each with and without vertical part.")] = 200,
    seed: Annotated[int, typer.Option(help="Seed of the ensemble and of the noise.")] = 1,
    ground: Annotated[
        list[str] | None, typer.Option(help="Ground motion of the bridge: files of a recorded one, or one synthetic.")
    ] = None,
    workers: Annotated[int | None, typer.Option(help="Processes; as many as there are cores when not given.")] = None,
    cluster: Annotated[
        str | None, typer.Option(help="Address of a dask scheduler that runs the replays, e.g. tcp://host:8786.")
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="A few motions only: a look in under a minute.")] = False,
    json: Annotated[bool, typer.Option("--json", help="Print paper.json for a program to read.")] = False,
) -> None:
    """Re-enact the paper: every figure, table and claim, what it states and what we get.

    Killed and called again with the same options, it goes on where it stopped.

    Example: `slipwise paper --out out/paper --readings n_unit=s/mm`
    """
    settings = sw.paper.change(
        replace(sw.paper.PaperSettings(), members=_QUICK if quick else members, seed=seed), readings or []
    )
    shaking = None
    if ground:
        shaking = sw.load_motion(ground)
        settings = replace(settings, ground=shaking.title)
    folder = out_folder(out)
    with ExitStack() as stack:
        executor = stack.enter_context(sw.executors.on_cluster(cluster)) if cluster else None
        report = stack.enter_context(progress("re-enacting the paper"))
        result = sw.paper.reenact(
            settings, folder, quick=quick, ground=shaking, executor=executor, workers=workers, progress=report
        )
    # Pictures take a second to load: only when there is something to draw.
    from slipwise.view.files import save_json
    from slipwise.view.pages.paper_page import write_page
    from slipwise.view.words.terminal import print_table

    content = sw.paper.as_json(result)
    save_json(content, folder / "paper.json")
    page = write_page(result, folder / "paper.html")
    if json:
        print_json(content)
        return
    for study in result.studies:
        rows = [{"where": f.place, "we get": f.brief, "verdict": f.verdict} for f in study.findings]
        print_table(study.title, rows)
    counts = ", ".join(f"{count} {verdict}" for verdict, count in result.verdicts().items())
    OUT.print(f"\n{counts}; {result.replays} replays in {result.seconds:.0f} s", markup=False, highlight=False)
    for path in (page, folder / "paper.json"):
        say(f"wrote {path}")
    say_next(f"open {page}")
