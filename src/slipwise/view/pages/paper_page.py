"""The page of the re-enacted paper: in the paper's order, what it states, what we get, whether it holds."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from slipwise.record import write_text
from slipwise.studies.paper.finding import FAILS, HOLDS, LIMITS, UNCHECKED, Finding, Study
from slipwise.studies.paper.reenact import Reenactment, assumptions
from slipwise.studies.paper.settings import SETTINGS
from slipwise.units import convert
from slipwise.view.colours import Tone
from slipwise.view.figures.paper_law_pictures import claims_figure, identification_figure, law_figure, map_figure
from slipwise.view.figures.paper_rig_pictures import (
    energies_figure,
    extreme_figure,
    input_figure,
    loads_figure,
    loops_figure,
)
from slipwise.view.pages.html import (
    Html,
    Piece,
    Section,
    callout,
    details,
    escape,
    figure,
    page,
    paragraph,
    table,
    verdict,
)

_TONES: dict[str, Tone] = {HOLDS: "good", LIMITS: "warn", FAILS: "bad", UNCHECKED: "plain"}
Draw = Callable[[Mapping[str, Any]], Figure]
#: Studies whose findings carry the headline.
_HEADLINE = ("loads", "loops", "extreme", "claims")
#: Study, a picture of it, and the caption of that.
PICTURES: tuple[tuple[str, Draw, str], ...] = (
    ("input", input_figure,
     "From the ground through the pier to the table, Bridge 1. The motion is assumed, not the paper's."),
    ("loads", loads_figure, "Load of pad A in both bridges under their pier-top motions, split as in Figs. 7 and 8."),
    ("loops", loops_figure,
     "Above: a sine, trapezoids mirrored on opposite sides. Below: an earthquake scaled to 532 kN cm."),
    ("loops", energies_figure,
     "Each motion with and without its vertical part. The paper's pair is one point of such a cloud."),
    ("law", law_figure, "Left: eq. (8). Right: exact leftover of pairs of pads that swing against each other."),
    ("identification", identification_figure,
     "Sine tests of ours, with the paper's range of pressure, and the fit to them."),
    ("extreme", extreme_figure,
     "Pads ring after landing; the loop of the full rig and that of one degree of freedom are close."),
    ("extreme", map_figure, "Mean over the motions: where rocking and landing matter to the slip."),
    ("claims", claims_figure,
     "Rocking changes next to nothing, vertical motion little, five times as much several per cent."),
)  # fmt: skip


def write_page(result: Reenactment, path: Path) -> Path:
    """Write the page so that it is there whole or not at all."""
    write_text(path, paper_page(result))
    return path


def paper_page(result: Reenactment) -> str:
    """Make the page's text."""
    sections = [Section("In five minutes", [overview(result)]), *(section(study) for study in result.studies)]
    sections.append(Section("What was assumed", assumed(result)))
    return page("The paper, figure by figure", sections, summary(result))


def summary(result: Reenactment) -> list[Piece]:
    """Answer first."""
    counts = result.verdicts()
    words = (
        "Takahashi, Iemura, Yanagawa and Hibi shook a 10 t girder on four PTFE pads and two rubber buffers (13WCEE, "
        "2004). "
        f"Here their rig is simulated and every table, figure and claim is put to the test, with {result.replays} "
        "replays. "
        "Mechanics that follow from the text come out as stated; what rests on one measured pair, or on figures that "
        "the "
        "text does not give, cannot be confirmed and is marked so."
    )
    facts = {name: counts[name] for name in counts}
    broken = [f.place for s in result.studies if s.name in _HEADLINE for f in s.findings if f.verdict == FAILS]
    tone: Tone = "good"
    headline = "Rocking cancels and vertical motion matters little, within limits"
    if broken:
        headline, tone = f"Under these assumptions does not hold: {', '.join(broken)}", "bad"
    out: list[Piece] = [verdict(headline, words, tone, facts)]
    if result.failed:
        out.append(callout("Note.", f"{result.failed} of {result.replays} replays diverged and were left out.", "warn"))
    changed = [a["name"] for a in assumptions(result.settings) if a["value"] != a["default"]]
    if changed:
        out.append(callout("Other assumptions than the default:", ", ".join(changed) + ".", "warn"))
    return out


def overview(result: Reenactment) -> Html:
    """Make one row of every finding."""
    rows = [
        {"where": _mark(finding), "the paper": finding.says, "here": finding.brief}
        for study in result.studies
        for finding in study.findings
    ]
    return table(rows)


def _mark(finding: Finding) -> Html:
    """Return a place with its verdict below, coloured; the words carry the meaning."""
    tone, words = _TONES[finding.verdict], finding.verdict
    return Html(f'{escape(finding.place)}<br><strong class="{tone}" style="color: var(--tone)">{words}</strong>')


def section(study: Study) -> Section:
    """Make one section: pictures, then findings, then tables."""
    pieces: list[Piece] = [
        figure(draw(study.curves), caption) for name, draw, caption in PICTURES if name == study.name
    ]
    for finding in study.findings:
        pieces += card(finding)
    pieces += [details(caption, [table(rows)]) for caption, rows in study.tables.items()]
    return Section(study.title, pieces)


def card(finding: Finding) -> list[Piece]:
    """Make the pieces of one finding."""
    rests = f" Rests on: {', '.join(finding.assumed)}." if finding.assumed else ""
    return [
        callout(f"{finding.place}: {finding.verdict}.", f"The paper: {finding.says}", _TONES[finding.verdict]),
        paragraph(f"We get: {finding.gets}"),
        paragraph(f"Range: {finding.why}{rests}"),
    ]


def assumed(result: Reenactment) -> list[Piece]:
    """List every assumption as it is printed."""
    rows = []
    for setting, entry in zip(SETTINGS, assumptions(result.settings), strict=True):
        value = entry["value"]
        if setting.unit and value is not None:
            shown = f"{convert(float(value), setting.unit, setting.shown_in):g}"
            value = shown if setting.shown_in == "1" else f"{shown} {setting.shown_in}"
        rows.append(
            {
                "assumption": f"`{setting.name}`",
                "value": "as the plan" if value is None else value,
                "decides": setting.about,
                "why, and what else is possible": setting.why,
            }
        )
    marked = [i for i, entry in enumerate(assumptions(result.settings)) if entry["value"] != entry["default"]]
    words = (
        "None of these is the paper's unless it says so: its figures and Table 1 are not in the text at hand. Change "
        "one and "
        "run again, for example `slipwise paper --readings n_unit=s/mm --readings buffer_height='0.2 m' --out DIR`."
    )
    ground = f"Ground motion of the bridge model: `{result.settings.ground}`. "
    ensemble = (
        f"Ensemble: {result.settings.members} motions from seed {result.settings.seed}, with and without vertical part."
    )
    return [paragraph(words), details("All assumptions", [table(rows, marked=marked)]), paragraph(ground + ensemble)]
