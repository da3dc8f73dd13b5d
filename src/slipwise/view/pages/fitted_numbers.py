"""What the fit found, for the report: its numbers, the surface they mean, and whether unseen runs are predicted."""

from math import isfinite
from typing import Any

from slipwise.comparison.result import Comparison
from slipwise.units import parse_unit
from slipwise.view.figures.error_maps import surface_figure
from slipwise.view.pages.html import figure, paragraph, table
from slipwise.view.words.number_names import CALLED, called


def fitted_numbers(found: Comparison) -> list[Any]:
    """Show every fitted number with its interval, what trades off, and the surface of friction that they mean."""
    names = {**CALLED, **_of_effects(found)}
    rows, marked = [], []
    for entry in found.intervals.entries:
        words, unit = called(entry.key, entry.unit, names)
        factor = parse_unit(unit, entry.unit, entry.key)
        row = {"number": words, "unit": unit, "value": f"{entry.value / factor:.5g}"}
        if entry.limit:
            row["95 % interval"] = f"at most {entry.high / factor:.5g}"
        elif entry.bound:
            marked.append(len(rows))
            row["95 % interval"] = f"ended on its {entry.bound} bound"
        elif not isfinite(entry.low + entry.high):
            row["95 % interval"] = "these records do not tell it"
        else:
            row["95 % interval"] = f"{entry.low / factor:.5g} to {entry.high / factor:.5g}"
        row["rated"] = f"{entry.rated / factor:.5g}"
        rows.append(row)
    words = (
        f"Fitted on runs of role fit and repeat. Intervals hold for correlated noise: only {found.intervals.blocks} "
        "stretches of time count as independent."
    )
    pieces: list[Any] = [paragraph(words), table(rows, marked=marked)]
    strong = [(a, b, c) for a, b, c in found.intervals.strongest(8) if abs(c) > 0.7]
    if strong:
        pairs = [f"{called(a, '', names)[0]} and {called(b, '', names)[0]} ({c:+.2f})" for a, b, c in strong]
        pieces.append(paragraph("Numbers that these runs hardly tell apart (correlation): " + "; ".join(pairs) + "."))
    if found.surface:
        pieces.append(
            figure(
                surface_figure(found),
                "Coefficient of friction that the fit means, where the campaign has been, with its 95 % band: numbers "
                "trade off against each other, this surface does not.",
                "Coefficient of friction over speed for some pressures",
            )
        )
    return pieces


def _of_effects(found: Comparison) -> dict[str, tuple[str, str]]:
    """Return what the parameters of the model's effects are called, in their files' own words and units."""
    return {
        key: (f"{term.label}, {p.meaning}", p.shown_in or p.unit)
        for term in found.base.objective.terms
        for key, p in term.parameters.items()
    }


def predicted_runs(found: Comparison) -> list[Any]:
    """Show the mean friction of runs that no fit has seen beside what the law says; nothing without such runs."""
    held = [f for f in found.predicted_friction if f.inside is not None]
    rows = [
        {
            "run": f.run,
            "mean friction [N]": f"{f.measured:.4g}",
            "the law says": f"{f.value:.4g}",
            "95 % interval": f"{f.low:.4g} to {f.high:.4g}",
            "inside": "yes" if f.inside else "no",
        }
        for f in held
    ]
    words = (
        "Mean friction of one pad while it slides, in runs that the fit has not seen. The interval is "
        "what the fitted runs are missed by, those of one slider each when the others are fitted: with few or unlike "
        "runs it is wide."
    )
    return [paragraph(words), table(rows)] if rows else []
