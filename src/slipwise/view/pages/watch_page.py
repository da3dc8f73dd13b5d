"""The page of a day: the newest verdict on top, every step below it; it reads itself again while the watch goes on."""

from collections.abc import Sequence
from urllib.parse import quote

from slipwise.monitoring.step import Step
from slipwise.view.pages.html import Html, Piece, Section, bullets, callout, escape, page, paragraph, table, verdict
from slipwise.view.words.watch_words import (
    change_words,
    gauge_words,
    motion_rows,
    runs_words,
    step_rows,
    tone,
    verdict_words,
)

#: Time after which a browser reads the page again [s].
_EVERY = 5


def watch_page(name: str, steps: Sequence[Step], waiting: Sequence[str], *, ended: bool = False) -> str:
    """Make the page.

    Args:
        name: of the campaign.
        steps: so far.
        waiting: what is waited for.
        ended: whether the watch is over: the page then stays as it is.

    Returns:
        The text of a self-contained HTML file.
    """
    summary: list[Piece] = []
    if steps:
        summary += _newest(steps)
    else:
        summary.append(callout("Nothing has come in yet.", "The first run that is whole is judged at once."))
    state = "The watch has ended; it goes on with the same command." if ended else f"Read again every {_EVERY} s."
    summary += [bullets(waiting)] if waiting else []
    summary.append(paragraph(state))
    sections = [_section(steps, place) for place in reversed(range(len(steps)))]
    if len(steps) > 1:
        sections = [Section("All steps", [table(step_rows(steps))]), *sections]
    return page(f"Watching {name}", sections, summary, every=0 if ended else _EVERY)


def _newest(steps: Sequence[Step]) -> list[Piece]:
    step = steps[-1]
    facts: dict[str, str] = {}
    if step.verdict:
        facts["probability"] = f"{100 * step.verdict['probability']:.0f} %"
        errors = [step.verdict[key] for key in ("base_error", "final_error")]
        facts["error [noise floors]"] = " to ".join("unknown" if e is None else f"{e:.3g}" for e in errors)
        facts["where"] = step.verdict["component"]
    if "verdict" in step.seconds:
        facts["known after"] = f"{step.seconds['verdict']:.0f} s"
    words = " ".join(filter(None, [verdict_words(step), step.next_words]))
    pieces: list[Piece] = [verdict(_headline(step), words, tone(step), facts)]
    return [*pieces, *(callout("A gauge.", words, "bad") for words in gauge_words(step))]


def _headline(step: Step) -> str:
    if step.cannot:
        return "No verdict"
    if not step.verdict:
        return "A run is being judged"
    names = ", ".join(step.verdict["effects"])
    heads = {
        "complete": "Nothing is missing", "named": "Missing", "instrument": "A gauge is at fault",
        "ambiguous": "Either of these", "unknown": "Something that is not in the catalogue",
    }  # fmt: skip
    return heads[step.verdict["verdict"]] + (f": {names}" if names else "")


def _section(steps: Sequence[Step], place: int) -> Section:
    step, before = steps[place], steps[place - 1] if place else None
    pieces: list[Piece] = [paragraph(runs_words(step))]
    pieces += [callout("Left out.", words, "warn") for words in step.refused]
    if step.gauges:
        pieces.append(paragraph(f"The instruments: {step.gauges}"))
    pieces += [callout("A gauge.", words, "bad") for words in gauge_words(step)]
    pieces.append(paragraph(" ".join(filter(None, [verdict_words(step), change_words(before, step)]))))
    if step.places:
        pieces += [paragraph("Where the model fails:"), bullets([f"{words}." for words in step.places])]
    if step.next_words:
        pieces.append(paragraph(step.next_words))
    if step.motions:
        pieces.append(table(motion_rows(step), "Motions, the one that would tell most first"))
    if step.report:
        link = f"{quote(step.report)}/report.html"
        pieces.append(Html(f'<p><a href="{escape(link)}">The whole diagnosis of step {step.number}</a></p>'))
    return Section(f"Step {step.number}: {', '.join(step.runs) or 'the same runs'}", pieces)
