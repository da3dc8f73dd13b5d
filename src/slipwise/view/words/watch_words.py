"""What a watch tells of a step, in sentences: which gauge broke, what is missing, where it fails, which motion next."""

from collections.abc import Sequence
from typing import Any

from slipwise.monitoring.step import Step
from slipwise.monitoring.watch import News
from slipwise.view.colours import Tone

#: How many runs are named; of more only the number is said.
_NAMED = 6


def news_words(news: News, before: News | None) -> list[str]:
    """Return what is new, a sentence each.

    Args:
        news: what there is to tell.
        before: what was told last, None where nothing was.
    """
    if news.about == "waiting":
        return [words for words in news.waiting if before is None or words not in before.waiting]
    step = news.steps[-1]
    match news.about:
        case "runs":
            return [runs_words(step), *step.refused]
        case "gauges":
            return [f"Are the instruments telling the truth? {step.gauges}", *gauge_words(step)]
        case "verdict":
            return [f"What is missing? {verdict_words(step)}", *_seconds(step, "verdict", "known")]
        case "places":
            return [f"Where does it fail? {words}." for words in step.places[:1]]
        case "next":
            return [f"What next? {step.next_words}"]
        case _:
            return ["A run is coming in: what is left to say of the runs before is not worked out."]


def runs_words(step: Step) -> str:
    """Say which runs came in."""
    if not step.runs:
        return "No run can be used yet." if not step.files else "The same runs, judged with what was changed."
    names = ", ".join(step.runs) if len(step.runs) <= _NAMED else f"{len(step.runs)} runs"
    return f"Step {step.number}, {step.began}: {names} {'has' if len(step.runs) == 1 else 'have'} come in."


def gauge_words(step: Step) -> list[str]:
    """Say which gauge broke since the run before, and which is sound again; a sentence each, none where none did."""
    since = " and ".join(step.runs) if len(step.runs) <= _NAMED else "the new runs"
    broke = [f"Broke since the last run: {words}, in {since}." for words in step.broke]
    return [*broke, *(f"No longer seen in {since}: {name}." for name in step.sound)]


def verdict_words(step: Step) -> str:
    """Say the verdict, or why there is none."""
    if step.cannot:
        return f"Not known: {step.cannot}"
    return str(step.verdict.get("words", "Not known yet: it is being worked out."))


def tone(step: Step) -> Tone:
    """Return the tone of a step."""
    if step.cannot:
        return "bad"
    tones: dict[str, Tone] = {"complete": "good", "unknown": "bad"}
    kind = step.verdict.get("verdict")
    return tones.get(str(kind), "warn") if kind else "plain"


def change_words(before: Step | None, step: Step) -> str:
    """Say how a verdict differs from that of the step before; "" where there are not two."""
    if before is None or not before.verdict or not step.verdict:
        return ""
    earlier, now = (", ".join(one.verdict.get("effects", [])) or "nothing" for one in (before, step))
    if earlier == now:
        return f"As before: {now}."
    return f"Before these runs it was {earlier}, now it is {now}."


def step_rows(steps: Sequence[Step]) -> list[dict[str, str]]:
    """Return all steps as rows of a table, the newest first."""
    return [
        {
            "step": str(step.number),
            "at": step.began.partition(" ")[2],
            "runs": ", ".join(step.runs) or "the same",
            "verdict": str(step.verdict.get("verdict", "none" if step.cannot else "")),
            "effects": ", ".join(step.verdict.get("effects", [])),
            "probability": f"{100 * step.verdict['probability']:.0f} %" if step.verdict else "",
            "broke": "; ".join(step.broke),
            "left out": "; ".join(words.partition(" is left out")[0] for words in step.refused),
        }
        for step in reversed(steps)
    ]


def motion_rows(step: Step) -> list[dict[str, Any]]:
    """Return the next motions as rows of a table."""
    return [
        {
            "motion": row["motion"],
            "separation [noise variances]": row["separation"],
            "in": row["in"],
            "probability then": f"{100 * row['probability then']:.0f} %",
        }
        for row in step.motions
    ]


def _seconds(step: Step, key: str, words: str) -> list[str]:
    return [f"{words} {step.seconds[key]:.0f} s after the files were whole"] if key in step.seconds else []
