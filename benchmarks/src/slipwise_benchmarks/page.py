"""The page of the bench: how often verdicts are right, who is taken for whom, and every verdict that is wrong."""

from collections.abc import Mapping, Sequence
from statistics import median
from typing import Any

from matplotlib.figure import Figure

from slipwise.view.pages.html import Html, Section, figure, page, paragraph, table, verdict
from slipwise_benchmarks.pictures import (
    Result,
    calibration_figure,
    confusion_figure,
    error_figure,
    hidden_name,
    named,
    said_name,
)
from slipwise_benchmarks.score import DOWN, rates, right
from slipwise_benchmarks.sizes import sizes

#: A verdict that says so much should be right nine times in ten.
SURE = 0.9
#: Groups of `rates` in words.
_GROUPS = {
    "complete": "nothing is hidden",
    "single": "one effect of physics",
    "pair": "two effects",
    "instrument": "a fault of an instrument",
    "unknown": "a law outside the catalogue",
    "3 floors or more": "anything of the catalogue, 3 floors or more",
    "singles of 3 floors or more": "one effect or fault, 3 floors or more",
    "below 3 floors": "anything of the catalogue, below 3 floors",
}
_NUMBERS = ("planted", "found", "low", "high")
_CONFUSION = "Counts of campaigns. What was called by its own name has no cell."
_CALIBRATION = "Each dot is a tenth of probability. On the dashed line verdicts are right as often as they say."
_FALLING = (
    f"Each line is a campaign. Below the dashed line at {DOWN:g} floors nothing above the noise is left. Labels say "
    "what was hidden where the error stays above it or the verdict is wrong."
)


def pictures(results: Sequence[Result]) -> dict[str, Figure]:
    """Draw all pictures, by the names of their files; use within `styled()`."""
    drawn = {"confusion": confusion_figure(results), "calibration": calibration_figure(results)}
    return {**drawn, "error_ratios": error_figure(results)} if named(results) else drawn


def bench_page(results: Sequence[Result], planned: int, drawn: Mapping[str, Figure]) -> str:
    """Make the page.

    Args:
        results: of the campaigns that are done: name, truth, said.
        planned: number of campaigns asked for.
        drawn: the pictures, from `pictures`.

    Returns:
        The text of a self-contained HTML file.
    """
    sections = [
        Section("How often verdicts are right", [table(_rates(results))]),
        Section("Who is taken for whom", [_wide(drawn["confusion"], _CONFUSION)]),
        Section("What a probability is worth", [paragraph(_sure(results)), figure(drawn["calibration"], _CALIBRATION)]),
    ]
    if "error_ratios" in drawn:
        sections.append(Section("How far the error falls", [_wide(drawn["error_ratios"], _FALLING)]))
    sections += [Section("Sizes outside their interval", _sizes(results)), Section("Wrong verdicts", _wrong(results))]
    return page("The blind bench", sections, [_summary(results, planned)])


def _wide(picture: Figure, caption: str) -> Html:
    """Keep a picture of many names readable on a phone, where it can be pushed along."""
    return Html(
        f'<div class="scroll" tabindex="0"><div style="min-width:58rem">{figure(picture, caption).text}</div></div>'
    )


def _summary(results: Sequence[Result], planned: int) -> Any:
    good = sum(right(r["truth"], r["said"]) for r in results)
    words = "Campaigns of a second simulator, each with something hidden in it or nothing, diagnosed blind."
    if len(results) < planned:
        words += f" So far {len(results)} of {planned} are done; the same command goes on where it stopped."
    facts = {
        "verdicts of 0.9 or more": _of(_when_sure(results)),
        "sizes inside their interval": _of([row["inside"] for row in sizes(results)]),
        "a verdict took, median": f"{median(r['said'].get('seconds', 0.0) for r in results):.0f} s",
    }
    return verdict(f"{good} of {len(results)} verdicts are exactly right", words, "plain", facts)


def _of(flags: Sequence[bool]) -> str:
    return f"{sum(flags)} of {len(flags)}"


def _rates(results: Sequence[Result]) -> list[dict[str, str]]:
    shares = rates(list(map(dict, results)))
    by_group = shares.pop("exactly right")
    every = {f"exactly right: {words}": by_group[name] for name, words in _GROUPS.items() if name in by_group} | shares
    return [{"campaigns": name, "count": f"{count} of {total}"} for name, (count, total) in every.items()]


def _when_sure(results: Sequence[Result]) -> list[bool]:
    return [right(r["truth"], r["said"]) for r in results if r["said"].get("probability", 0.0) >= SURE]


def _sure(results: Sequence[Result]) -> str:
    flags = _when_sure(results)
    if not flags:
        return f"No verdict claimed {SURE:g} or more."
    mean = sum(p for r in results if (p := r["said"].get("probability", 0.0)) >= SURE) / len(flags)
    return f"Verdicts that claimed {SURE:g} or more ({mean:.2f} on average) were right in {_of(flags)} cases."


def _sizes(results: Sequence[Result]) -> list[Any]:
    held = sizes(results)
    rows = [
        {"campaign": row["campaign"], "size": row["size"], **{k: _number(row[k]) for k in _NUMBERS}}
        for row in held
        if not row["inside"]
    ]
    words = f"Of {len(held)} planted sizes of rightly named effects {len(rows)} lie outside the 95 % interval."
    return [paragraph(words), table(rows, "SI units")] if rows else [paragraph(words)]


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.5g}"


def _wrong(results: Sequence[Result]) -> list[Any]:
    rows = [
        {
            "campaign": r["name"],
            "hidden": hidden_name(r["truth"]),
            "its size [floors]": f"{r['truth']['size_after_fit']:.1f}",
            "said": said_name(r["said"]),
            "probability": f"{r['said'].get('probability', 0.0):.2f}",
            "in words": r["said"].get("words") or r["said"]["verdict"],
        }
        for r in results
        if not right(r["truth"], r["said"])
    ]
    return [table(rows)] if rows else [paragraph("None.")]
