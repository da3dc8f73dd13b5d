"""Pictures of the bench: who is taken for whom, what a probability is worth, how far the error falls.

Only drawing is taken from the library; neither side's physics enters.
"""

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from math import ceil, sqrt
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.style import EXPECTED, INK, MODEL_COLOURS, MUTED, UPLIFT, mixed
from slipwise_benchmarks.score import BASE, DOWN, calibration, kind, right

Result = dict[str, Any]
#: Order in which kinds of hidden things are shown.
_KINDS = ("complete", "single", "instrument", "pair", "unknown")
_NOTHING, _OUTSIDE = "nothing", "outside the catalogue"
_RIGHT, _WRONG = MODEL_COLOURS[5], UPLIFT
#: Sizes of the confusion's parts [inch]: a column, a row, the names of rows, a line of the list, a letter.
_COLUMN, _ROW, _SIDE, _LINE, _LETTER = 0.46, 0.27, 3.6, 0.21, 0.08
#: Columns that there is room for at least, so that cells keep their size; names beside each other in the list.
_ROOM, _ABREAST = 14, 3
#: Room for a label among the campaigns of the picture of errors [1].
_LABEL = 0.012


def hidden_name(truth: Mapping[str, Any]) -> str:
    """Name what was hidden; a pair in one order, whichever of the two was drawn first."""
    missing = sorted(truth["missing"])
    return _OUTSIDE if missing == ["unknown"] else " + ".join(missing) or _NOTHING


def said_name(said: Mapping[str, Any]) -> str:
    """Name what a verdict says is missing, in the words of `hidden_name`."""
    names, verdict = sorted(set(said.get("effects") or []) - BASE), str(said["verdict"])
    if verdict == "ambiguous":
        return " or ".join(names)
    if names:
        return " + ".join(names)
    return {"complete": _NOTHING, "unknown": _OUTSIDE}.get(verdict, verdict.split(":")[0])


def confusion_figure(results: Sequence[Result]) -> Figure:
    """Draw what was hidden (rows) against what was said instead (columns), and name what was always called rightly."""
    groups: dict[str, list[Result]] = defaultdict(list)
    for result in sorted(results, key=lambda r: (_KINDS.index(kind(r["truth"])), hidden_name(r["truth"]))):
        groups[hidden_name(result["truth"])].append(result)
    instead = {hidden: Counter(s for r in of if (s := said_name(r["said"])) != hidden) for hidden, of in groups.items()}
    rows = [hidden for hidden, said in instead.items() if said]
    clean = [hidden for hidden, said in instead.items() if not said]
    columns = [said for said, _ in sum(instead.values(), Counter()).most_common()]
    lines = ceil(len(clean) / _ABREAST)
    head = _LETTER * max(len(line) for said in ("exactly right", *columns) for line in _broken(said).splitlines())
    heights = [head + _ROW * (len(rows) + 2), _LINE * (lines + 2)]
    width = _SIDE + _COLUMN * (max(len(columns), _ROOM) + 1)
    figure = new_figure(width, sum(heights) + 0.4, "Hidden (rows), and what was said instead (columns)")
    above, below = figure.subplots(2, 1, height_ratios=heights)
    _cells(above, {hidden: groups[hidden] for hidden in rows}, columns)
    below.set_axis_off()
    below.set_title("Called by its name every time" if clean else "")
    for i, hidden in enumerate(clean):
        place = (i // lines / _ABREAST, 1.0 - (i % lines + 1) / (lines + 1))
        below.text(*place, f"{hidden}: {_share(groups[hidden])}", transform=below.transAxes, fontsize=7.5)
    return figure


def _cells(axes: Axes, groups: Mapping[str, Sequence[Result]], columns: Sequence[str]) -> None:
    """Draw the table: exactly right of all in the first column, then a count for each thing that was said instead."""
    if not groups:
        axes.set_axis_off()
        axes.text(0.0, 0.5, "Nothing was taken for anything else.", transform=axes.transAxes, va="center")
        return
    for y, (hidden, results) in enumerate(groups.items()):
        axes.text(0, y, _share(results), ha="center", va="center", fontweight="bold", fontsize=9.0)
        for x, said in enumerate(columns, start=1):
            here = [right(r["truth"], r["said"]) for r in results if said_name(r["said"]) == said]
            if said == hidden or not here:
                continue
            colour = EXPECTED if all(here) else _WRONG
            axes.add_patch(Rectangle((x - 0.46, y - 0.42), 0.92, 0.84, color=colour))
            ink = INK if all(here) else "white"
            axes.text(x, y, str(len(here)), ha="center", va="center", color=ink, fontweight="bold")
    axes.set_xlim(-0.6, max(len(columns), _ROOM) + 0.5)
    axes.set_ylim(len(groups) - 0.5, -0.5)
    words = ["exactly right", *map(_broken, columns)]
    axes.set_xticks(range(len(words)), words, rotation=90, fontsize=8.5)
    axes.set_yticks(range(len(groups)), list(groups), fontsize=9.0)
    axes.tick_params(top=True, labeltop=True, bottom=False, labelbottom=False, length=0)
    note = "red: wrong; grey: counted as right (too faint to see alone, or one thing to this rig)"
    axes.set_xlabel(note, loc="left")


def _broken(said: str) -> str:
    return said.replace(" or ", "\nor ").replace(" + ", "\n+ ")


def _share(results: Sequence[Result]) -> str:
    return f"{sum(right(r['truth'], r['said']) for r in results)} of {len(results)}"


def calibration_figure(results: Sequence[Result]) -> Figure:
    """Draw the probability that verdicts gave against how often they were right, with the 95 % range of chance."""
    figure = new_figure(9.5, 5.0, "Is a probability worth its name?")
    axes = figure.subplots()
    axes.plot([0, 1], [0, 1], color=MUTED, lw=1.0, ls="--", label="as often right as it says")
    for i, row in enumerate(calibration(results)):
        low, high = _range(row["right"], row["count"])
        size = min(4.0 + row["count"] ** 0.5, 12.0)
        axes.plot([row["said"]] * 2, [low, high], color=mixed(_RIGHT, "#ffffff", 0.5), lw=2.0)
        label = "verdicts: how many, and the 95 % range of chance" if i == 0 else None
        axes.plot(row["said"], row["right"], "o", color=_RIGHT, ms=size, label=label)
        axes.annotate(
            f"{row['count']:.0f}", (row["said"], row["right"]), xytext=(-4.0 - size / 2.0, 0),
            textcoords="offset points", ha="right", va="center",
        )  # fmt: skip
    axes.set(xlim=(-0.06, 1.04), ylim=(-0.04, 1.04), xlabel="probability of the verdict", ylabel="share exactly right")
    axes.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=2, markerscale=0.6)
    return figure


def _range(share: float, count: float) -> tuple[float, float]:
    """Give Wilson's 95 % interval of a share of so many."""
    z = 1.96
    middle, weight = share + z * z / (2.0 * count), 1.0 + z * z / count
    half = z * sqrt(share * (1.0 - share) / count + (z / (2.0 * count)) ** 2)
    return (middle - half) / weight, (middle + half) / weight


def error_figure(results: Sequence[Result]) -> Figure:
    """Draw the held-out error before and after the named effects, campaign by campaign, largest last."""
    figure = new_figure(11.0, 5.2, "Held-out error before and after the named effects")
    axes = figure.subplots()
    shown = sorted(named(results), key=lambda r: r["said"]["base_error"])
    free, gap = 0.0, _LABEL * len(shown)
    for x, result in enumerate(shown):
        before, after = result["said"]["base_error"], result["said"]["final_error"]
        good = right(result["truth"], result["said"])
        axes.plot([x, x], [before, after], color=EXPECTED, lw=1.0, zorder=1)
        axes.plot(x, before, "o", color=MODEL_COLOURS[0], ms=4)
        axes.plot(x, after, "o" if good else "X", color=_RIGHT if good else _WRONG, ms=4 if good else 7)
        if after > DOWN or not good:
            place = max(x, free)  # neighbours' labels stand side by side
            free = place + gap
            axes.annotate(
                hidden_name(result["truth"]), (place, max(before, after)), xytext=(0, 6), textcoords="offset points",
                rotation=90, ha="center", va="bottom", fontsize=7.0, color=MUTED if good else _WRONG,
            )  # fmt: skip
    axes.axhline(DOWN, color=INK, lw=1.0, ls="--")
    axes.annotate(f"{DOWN:g}", (1.005, DOWN), xycoords=("axes fraction", "data"), ha="left", va="center")
    for label, colour, marker in (
        ("base model", MODEL_COLOURS[0], "o"),
        ("with what was named, rightly", _RIGHT, "o"),
        ("with what was named, wrongly", _WRONG, "X"),
    ):
        axes.plot([], [], marker, color=colour, label=label)
    axes.set(yscale="log", xlabel="campaigns in which something was named, by their error", ylabel="error [floors]")
    axes.yaxis.set_major_formatter("{x:g}")
    axes.set_xticks([])
    axes.margins(x=0.01)
    axes.set_ylim(top=axes.get_ylim()[1] * 6.0)
    axes.legend(loc="upper left")
    return figure


def named(results: Sequence[Result]) -> list[Result]:
    """Give the campaigns in which effects were named and the error before and after is known."""
    return [r for r in results if r["said"].get("effects") and r["said"].get("base_error") and r["said"]["final_error"]]
