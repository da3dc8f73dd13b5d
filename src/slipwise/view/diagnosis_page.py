"""The page of a diagnosis: the verdict in a sentence, the evidence, the rivals, and what would change our mind."""

from math import isfinite

from slipwise.diagnosis.indistinguishable import known_effects
from slipwise.diagnosis.ladder import Ladder
from slipwise.diagnosis.result import Diagnosis
from slipwise.diagnosis.rivals import discriminating_tests, explanations
from slipwise.estimation.intervals import Interval
from slipwise.params import Parameter
from slipwise.units import convert
from slipwise.view.diagnosis_figures import (
    balances_figure,
    ladder_figure,
    loops_figure,
    step_errors,
    surface_figure,
)
from slipwise.view.html import Section, bullets, callout, details, figure, page, paragraph, table, verdict
from slipwise.view.numbers import in_words
from slipwise.view.style import styled

_TONES = {"complete": "good", "named": "warn", "instrument": "warn", "ambiguous": "warn", "unknown": "bad"}
_HEADLINES = {
    "complete": "Nothing is missing",
    "named": "An effect is missing",
    "instrument": "A gauge is at fault",
    "unknown": "Something that is not in the catalogue",
}


def diagnosis_page(found: Diagnosis, ladder: Ladder | None = None) -> str:
    """Make the page.

    Args:
        found: the diagnosis.
        ladder: the falling error, where it was climbed.

    Returns:
        The text of a self-contained HTML file.
    """
    with styled():
        return _page(found, ladder)


def _page(found: Diagnosis, ladder: Ladder | None) -> str:
    before = "held-out error before" if _held_out(found) else "error on fitted runs before"
    facts = {
        "probability": f"{100 * found.verdict.probability:.0f} %",
        before: f"{found.base_error:.2f} floors",
        "after": f"{found.final_error:.2f} floors",
        "where": found.component,
    }
    if found.system:
        facts["replay before / after"] = f"{found.system['base']:.1f} / {found.system['final']:.1f} floors"
    box = verdict(_headline(found), found.sentence, _TONES[found.verdict.kind], facts)  # type: ignore[arg-type]
    sections = [_evidence(found), _what_it_is(found), _rivals(found)]
    if found.verdict.leftover == "unknown" and found.verdict.surface is not None:
        sections.insert(1, _shape(found))
    if ladder is not None:
        sections.insert(1, _falling(ladder))
    sections += [_change(found), _limits(found)]
    return page(f"Diagnosis of {found.campaign}", sections, [box])


def _headline(found: Diagnosis) -> str:
    kind = found.verdict.kind
    if kind == "ambiguous":
        rivals = explanations(found.verdict, found.search)
        words = f"{in_words(len(rivals)).capitalize()} explanations, one measurement"
        return f"{words}: {' or '.join(' + '.join(names) for names in rivals)}"
    names = ", ".join(found.verdict.effects)
    return _HEADLINES[kind] + (f": {names}" if names else "")


def _held_out(found: Diagnosis) -> bool:
    """Tell whether the campaign has a run that no fit has seen; if not, nothing may be called held-out."""
    return bool(found.search.base.problem.held_out)


def _evidence(found: Diagnosis) -> Section:
    if _held_out(found):
        where, errors, run = "runs that no fit has seen", "Held-out error of every balance", "a held-out run"
    else:
        where, run = "the runs that were fitted (the campaign keeps none back)", "a run that was fitted"
        errors = "Error of every balance on the runs that were fitted"
    return Section(
        "The evidence",
        [
            paragraph(
                f"Every balance of the rig, on {where}, in multiples of the noise floor: 1 is what a perfect model "
                "leaves. Pads are driven by measured load and speed: each part answers for itself."
            ),
            figure(balances_figure(found), f"{errors}, before and after."),
            figure(loops_figure(found), f"Friction of one pad against slip in {run}."),
            *(paragraph(f"{run.words}.") for run in found.predicted_friction),
        ],
    )


def _floors(error: float) -> float | str:
    return round(error, 2) if isfinite(error) else "-"


def _falling(ladder: Ladder) -> Section:
    errors = step_errors(ladder)
    rows = [
        {"model": " + ".join(("base", *step.effects)), **{label: _floors(own[i]) for label, own in errors.items()}}
        for i, step in enumerate(ladder.steps)
    ]
    return Section(
        "The error, step by step",
        [figure(ladder_figure(ladder), "Error in multiples of the floor."), table(rows)],
    )


def _shape(found: Diagnosis) -> Section:
    surface = found.verdict.surface
    assert surface is not None
    return Section(
        "The shape of what is missing",
        [
            paragraph(f"What remains after the best effects of the catalogue, {surface.words}."),
            figure(surface_figure(surface), "Missing force, orthogonal to what the base parameters can do."),
        ],
    )


def _what_it_is(found: Diagnosis) -> Section:
    pieces = []
    known = known_effects(found.search)
    for name in found.verdict.effects:
        effect = known.get(name)
        if effect is None:
            continue
        pieces += [
            callout(name, f"{effect.summary} `{effect.equation}`"),
            paragraph(f"How it shows: {effect.signature}."),
        ]
    best = found.candidates[0] if found.candidates and found.added else None
    if best is not None:
        rows = []
        for key, interval in best.parameters.items():
            label, _, parameter = key.rpartition(".")
            effect = known[label.partition("[")[0]]
            rows.append({"parameter": f"{label}: {parameter}", **_numbers(effect.parameter(parameter), interval)})
        pieces.append(table(rows, "Fitted on the fit runs, with 95 % intervals that hold for correlated noise"))
    if not pieces:
        pieces.append(paragraph("No effect of the catalogue was worth a name."))
    return Section("What it is, and how large", pieces)


def _numbers(known: Parameter, interval: Interval) -> dict[str, object]:
    shown = known.shown_in or known.unit
    ends = {"value": interval.value, "low": interval.low, "high": interval.high}
    out = {k: f"{convert(v, known.unit, shown):.{interval.figures}g}" for k, v in ends.items()}
    out["unit"] = "" if shown == "1" else shown
    if interval.limit:
        out |= {"low": "may be absent"}
    return {**out, "meaning": known.meaning}


def _rivals(found: Diagnosis) -> Section:
    seen = "held-out" if _held_out(found) else "error on fitted runs"
    rows = [
        {
            "hypothesis": c.effect,
            "probability": f"{100 * c.probability:.1f} %",
            f"{seen} before": round(c.holdout_before, 2),
            f"{seen} after": round(c.holdout_after, 2),
            "hidden by the base fit": f"{100 * c.absorbed_by_base:.0f} %",
        }
        for c in found.candidates
    ]
    words = "The hypotheses that were refitted, with all base parameters free, best first."
    pieces = [paragraph(words), table(rows)] if rows else [paragraph("No hypothesis lowered the error.")]
    return Section("Rivals", pieces)


def _change(found: Diagnosis) -> Section:
    known, named = known_effects(found.search), found.verdict.effects
    items = [f"{words}." for words in discriminating_tests(found.verdict, found.search)]
    for name in (n for n in named if n in known):
        tests = known[name].confused_with.items()
        items += [f"{rival} instead of {name}: {test}." for rival, test in tests if rival not in named]
    items.append(
        "A run of another kind (amplitude, frequency, rest before it), kept from the fit, on which the error does not "
        "fall."
    )
    return Section("What would change our mind", [bullets(items), paragraph("`slipwise next` ranks table motions.")])


def _limits(found: Diagnosis) -> Section:
    pieces = []
    if found.cannot_tell:
        pieces.append(bullets(list(found.cannot_tell)))
    least = [{"effect": n, "smallest size": f"{v:.3g}", "unit": u} for n, (v, u) in found.least.items()]
    pieces.append(details("Smallest size of each effect that this campaign would have shown", [table(least)]))
    seen = [
        {"candidate": s.term.label, "explains alone": f"{s.gain:.3g}", "hidden by the base fit": f"{s.absorbed:.0%}"}
        for s in found.search.screened
    ]
    words = paragraph("Without a refit: drop of the squared residual of the fitted runs, in variances of the noise.")
    pieces.append(details(f"All {len(seen)} candidates as they were screened", [words, table(seen)]))
    return Section("What this campaign could not tell", pieces)
