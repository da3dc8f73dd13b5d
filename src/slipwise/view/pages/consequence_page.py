"""The page of a consequence: a sentence, a picture of two distributions, and a table."""

from typing import Any

from slipwise.studies.consequence import Consequence
from slipwise.view.figures.consequence_figure import consequence_figure
from slipwise.view.pages.html import Section, bullets, figure, page, paragraph, table, verdict
from slipwise.view.words.consequence_tables import drawn_rows, short_rows
from slipwise.view.words.numbers import counted


def consequence_page(found: Consequence) -> str:
    """Make the text of one HTML file that needs nothing else."""
    names = " and ".join(found.named)
    count = counted(found.earthquakes, "earthquake")
    words = (
        f"{count[0].upper()}{count[1:]} on {found.rig}, with {names} in the model and without; both models meet the "
        "same ones."
    )
    caption = (
        "Share of the earthquakes whose peak slip stays below. Solid: with what was named; dashed: without it; "
        "numbers: the 90 % quantiles."
    )
    picture = figure(
        consequence_figure(found),
        caption,
        "Two distributions of peak slip",
        narrow=consequence_figure(found, narrow=True),
    )
    about = (
        "Quantiles over all earthquakes, without → with. The interval of the change is that of drawing the earthquakes "
        "again."
    )
    sections = [
        Section("Peak slip", [picture]),
        Section("Responses", [paragraph(about), table(short_rows(found))]),
        Section("Sizes", _sizes(found)),
    ]
    if found.notes:
        sections.append(Section("What to know", [bullets([f"{w[0].upper()}{w[1:]}." for w in found.notes])]))
    return page(f"{found.rig}: what {names} means", sections, [verdict(found.sentence, words, "plain")])


def _sizes(found: Consequence) -> list[Any]:
    if not found.drawn:
        return [paragraph("No size was drawn: each is as the model has it.")]
    times = "" if found.draws == 1 else f", {found.draws} times for each"
    words = f"Drawn anew for every earthquake{times}. Each size is drawn by itself, whatever the others are."
    return [paragraph(words), table(drawn_rows(found))]
