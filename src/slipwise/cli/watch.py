"""`slipwise watch`: on the day of the tests, a verdict after each run, and the motion that would tell most next."""

from contextlib import suppress
from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import out_folder, say, say_next, steps
from slipwise.cli.diagnosis_files import write_diagnosis
from slipwise.cli.options import CampaignFolder, ModelFile, Own, Trusted, own_effects
from slipwise.errors import OutputError


def watch(
    campaign: CampaignFolder,
    out: Annotated[
        Path, typer.Option(help="Folder for watch.html, watch.json and a folder of each diagnosis; it is gone on from.")
    ] = Path("out/watch"),
    stroke: Annotated[str, typer.Option(help="How far the table goes from its middle.")] = "300 mm",
    speed: Annotated[str, typer.Option(help="The table's largest speed.")] = "1.5 m/s",
    acceleration: Annotated[str, typer.Option(help="The table's largest acceleration.")] = "1 g",
    model: ModelFile = None,
    effect: Own = None,
    trust: Trusted = False,
) -> None:
    """Judge each run as it comes into a campaign's folder: gauges, what is missing, where, which motion next.

    campaign.toml may name runs that are still to come, or none: a data file that is younger than it is a run of role
    fit. A file that is still being written is waited for. Open watch.html in a browser: it reads itself again. Ctrl-C
    ends the watch; called again with the same folder, it goes on where it was.

    Example: `slipwise watch campaigns/today --out out/today`
    """
    from slipwise.view.files import save_page
    from slipwise.view.pages.watch_page import watch_page
    from slipwise.view.words.watch_words import news_words

    limits = sw.Limits(
        sw.quantity(stroke, "m", "--stroke"),
        sw.quantity(speed, "m/s", "--speed"),
        sw.quantity(acceleration, "m/s^2", "--acceleration"),
    )
    own = own_effects(effect)
    folder, name = out_folder(out), campaign.resolve().name
    page = folder / "watch.html"
    last: sw.News | None = None
    try:
        with steps() as tell:
            day = sw.watch(
                campaign, folder / "watch.json", model=model, trust=trust or effect or (), own=own, limits=limits,
                progress=tell,
            )  # fmt: skip
            for news in day:
                if last is None:
                    say(f"open {page.resolve().as_uri()}; Ctrl-C ends the watch")
                for words in news_words(news, last):
                    say(words)
                save_page(watch_page(name, news.steps, news.waiting), page)
                last = news
                if news.found is not None:
                    write_diagnosis(news.found, out_folder(folder / news.steps[-1].report), recording=False)
    finally:
        if last is not None:
            with suppress(OutputError):
                save_page(watch_page(name, last.steps, last.waiting, ended=True), page)
            say_next(f"open {page}", f"`slipwise watch {quote(str(campaign))} --out {quote(str(out))}` goes on")
