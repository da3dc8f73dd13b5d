"""`slipwise discover`: from an unknown effect to a law that can be added."""

from collections.abc import Sequence
from datetime import date
from pathlib import Path
from shlex import quote
from typing import Annotated

import typer

import slipwise as sw
from slipwise.cli.console import OUT, can_record, out_folder, print_json, say, say_corrections, say_next, steps
from slipwise.cli.options import Figures, Json, ModelFile, Own, Trusted, own_effects, start_model
from slipwise.errors import visible

CampaignFolders = Annotated[
    list[Path], typer.Argument(help="Folder with campaign.toml and the measured runs; further ones to hold it against.")
]


def discover(
    campaigns: CampaignFolders,
    out: Annotated[
        Path, typer.Option(help="Folder for discovery.json, report.html, the recording and the law's effect file.")
    ] = Path("out/discovery"),
    name: Annotated[str, typer.Option(help="Name of the effect that is written, and of its file.")] = "law",
    model: ModelFile = None,
    effect: Own = None,
    trust: Trusted = False,
    recording: Annotated[
        bool, typer.Option(help="Write the model before and with the law beside the measurement, for the viewer.")
    ] = True,
    figures: Figures = False,
    json: Json = False,
) -> None:
    """Find the law of what the catalogue does not hold, and write it as an effect.

    It is looked for in the first campaign. Of further ones, such as another specimen's, it says whether the law holds
    there and with which size, and its constants are those of all of them.

    Example: `slipwise discover campaigns/march --out out/march`
    """
    from slipwise.view.figures.figure_files import figures_into
    from slipwise.view.files import save_json, save_page
    from slipwise.view.pages.discovery_page import discovery_page
    from slipwise.view.words.discovery_words import shape_lines

    sw.effects.check_name(name)  # not after minutes of search
    recording = can_record(recording)
    campaign = campaigns[0]
    measured, *others = [sw.load_campaign(folder) for folder in campaigns]
    folder = out_folder(out)
    with steps() as tell:
        start = start_model(campaign, model, trust, effect)
        found = sw.discover(measured, start, own=own_effects(effect, start), others=others, progress=tell)
    found = found.written(folder, name, date.today().isoformat())
    files = [save_json(found.as_json(), folder / "discovery.json")]
    with figures_into(folder / "figures" if figures else None) as drawn:
        files.append(save_page(discovery_page(found), folder / "report.html"))
    files += drawn
    if recording:
        from slipwise.view.recordings.discovery_recording import write_discovery_recording

        files.append(write_discovery_recording(found, folder / "discovery.rrd"))
    if json:
        print_json(found.as_json())
        return
    OUT.print(visible(found.sentence), markup=False, highlight=False)
    say_corrections(found.corrections)
    for words in shape_lines(found):
        say(words)
    for law in found.laws:
        for c in law.constants:
            value = "open" if c.bound else f"{c.value:.4g} {c.unit}"
            say(f"{law.name}.{c.name} = {value}{_interval(c.low, c.high, c.bound)}")
        for words in law.rivals:
            say(f"explains as much: {words}")
    for test in found.campaigns:
        say(test.sentence)
    for words in found.cannot_judge:
        say(f"cannot judge {words}")
    for path in files:
        say(f"wrote {path}")
    if any(law.alternatives for law in found.laws):
        say(f"`slipwise next {quote(str(campaign))}` ranks table motions that would tell them apart")
    added = _added(campaign, found.beside, found.files) if found.files else []
    for command in added[:-1]:
        say(f"first: `{command}`")
    say_next(f"`{added[-1]}`" if added else f"`slipwise diagnose {quote(str(campaign))}`")


def _added(campaign: Path, beside: Sequence[str], files: Sequence[Path]) -> list[str]:
    """Return the commands that add effects, one after another: a file that is in the model by then is trusted anew."""
    out = [f"slipwise add {effect} --campaign {quote(str(campaign))}" for effect in beside]
    for number, file in enumerate(files):
        trusted = "".join(f" --effect {quote(str(earlier))}" for earlier in files[:number])
        out.append(f"slipwise add {quote(str(file))} --campaign {quote(str(campaign))}{trusted}")
    return out


def _interval(low: float, high: float, bound: str) -> str:
    if bound:
        return f": the fit ran to the {bound} end of what was tried, so the data do not tell it"
    return f" ({low:.4g} to {high:.4g})" if low == low else " (a choice)"
