"""The page of a diagnosis: the verdict in a sentence, the evidence, the rivals, and what would change our mind."""

from math import isfinite

from slipwise.diagnosis.alternatives import list_discriminating_tests, list_explanations
from slipwise.diagnosis.indistinguishable import list_known_effects
from slipwise.diagnosis.ladder import Ladder
from slipwise.diagnosis.result import Diagnosis
from slipwise.effects import Effect
from slipwise.prediction.result import PredictionReport
from slipwise.rig import Specimen
from slipwise.units import convert
from slipwise.view.figures.diagnosis_figures import (
    balances_figure,
    ladder_figure,
    loops_figure,
    step_errors,
    surface_figure,
)
from slipwise.view.figures.style import styled
from slipwise.view.pages.diagnosis_effects import evidence_rows, importance_section, sizes_section
from slipwise.view.pages.html import Section, bullets, callout, details, figure, page, paragraph, table, verdict
from slipwise.view.pages.prediction_section import prediction_section, prediction_verdict
from slipwise.view.pages.why_not_section import limits_section, why_not_pieces
from slipwise.view.words.diagnosis_words import cannot_tell_words, confirmed_words, error_name, floors
from slipwise.view.words.limit_words import missed_words
from slipwise.view.words.numbers import in_words, usual_unit

_TONES = {"complete": "good", "named": "warn", "instrument": "warn", "ambiguous": "warn", "unknown": "bad"}
_HEADLINES = {
    "complete": "Nothing is missing",
    "named": "An effect is missing",
    "instrument": "A gauge is at fault",
    "unknown": "Something that is not in the catalogue",
}


def diagnosis_page(found: Diagnosis, ladder: Ladder | None = None, prediction: PredictionReport | None = None) -> str:
    """Make the page.

    Args:
        found: the diagnosis.
        ladder: the falling error, where it was climbed.
        prediction: what was found of a model that predicted the runs, if one did; it stands first.

    Returns:
        The text of a self-contained HTML file.
    """
    with styled():
        return _page(found, ladder, prediction)


def _page(found: Diagnosis, ladder: Ladder | None, prediction: PredictionReport | None) -> str:
    error = error_name(found)
    facts = {
        "probability": f"{100 * found.verdict.probability:.0f} %",
        f"{error} [noise floors]": _fall(found, found.base_error, found.final_error),
    }
    if found.system:
        facts[f"{error}, replayed [noise floors]"] = _fall(found, found.system["base"], found.system["final"])
    facts["where"] = found.component
    missed = missed_words(found) if found.verdict.kind == "complete" else ""
    words = " ".join(filter(None, [found.sentence, missed, confirmed_words(found)]))
    box = verdict(_headline(found), words, _TONES[found.verdict.kind], facts)  # type: ignore[arg-type]
    shape = found.verdict.leftover == "unknown" and found.verdict.surface is not None
    sections = [
        importance_section(found),
        _evidence(found),
        _falling(ladder) if ladder is not None else None,
        _shape(found) if shape else None,
        sizes_section(found),
        _rivals(found),
        _change(found),
        limits_section(found),
        _limits(found),
    ]
    first = [callout("Before anything was fitted", f"{thing.words}.", "warn") for thing in found.corrections]
    parts = [part for part in sections if part is not None]
    if prediction is None:
        return page(f"Diagnosis of {found.campaign}", parts, [box, *first])
    words = "What the campaign shows beyond the model that this diagnosis begins with: the paper's law, or model.toml."
    own = [prediction_section(prediction), Section("The campaign by itself", [paragraph(words), box, *first])]
    return page(f"The model that predicted {found.campaign}", [*own, *parts], [prediction_verdict(prediction)])


def _fall(found: Diagnosis, before: float, after: float) -> str:
    """Write an error before and after; one number where nothing was added to the base model."""
    return f"{floors(before)} before, {floors(after)} after" if found.added else floors(before)


def _headline(found: Diagnosis) -> str:
    kind = found.verdict.kind
    if kind == "ambiguous":
        rivals = list_explanations(found.verdict, found.search)
        words = f"{in_words(len(rivals)).capitalize()} explanations, one measurement"
        return f"{words}: {' or '.join(' + '.join(names) for names in rivals)}"
    names = ", ".join(found.verdict.effects)
    if kind == "complete" and found.verdict.minor:
        return "Nothing that matters is missing"
    if found.verdict.is_doubtful:
        what = "missing, or a gauge is at fault" if kind == "instrument" else "missing"
        return f"Something is {what}; nearest: {names}" if names else "Something is left that has no name"
    if kind == "named" and len(found.verdict.effects) > 1:
        return f"{in_words(len(found.verdict.effects)).capitalize()} effects are missing: {names}"
    return _HEADLINES[kind] + (f": {names}" if names else "")


def _evidence(found: Diagnosis) -> Section:
    if found.held_out:
        where, errors, run = "runs that no fit has seen", "Held-out error of every balance", "a held-out run"
    else:
        where, run = "the runs that were fitted (no other can be judged)", "a run that was fitted"
        errors = "Error of every balance on the runs that were fitted"
    return Section(
        "The evidence",
        [
            paragraph(
                f"Every balance of the rig, on {where}, in multiples of the noise floor: 1 is what a perfect model "
                "leaves. Pads are driven by measured load and speed: each part answers for itself."
            ),
            figure(
                balances_figure(found),
                f"{errors}{', before and after' if found.added else ''}.",
                narrow=balances_figure(found, narrow=True),
            ),
            figure(loops_figure(found), f"{_loop_words(found)} against slip in {run}."),
            *(paragraph(f"{run.words}.") for run in found.predicted_friction),
        ],
    )


def _loop_words(found: Diagnosis) -> str:
    measured = found.search.base.objective.forces_measured
    return "Friction of one pad" if measured else "Force of all bearings, from the inertia of what they carry,"


def _falling(ladder: Ladder) -> Section:
    errors = step_errors(ladder)
    rows = [
        {"model": " + ".join(("base", *step.effects))}
        | {label: floors(own[i]) if isfinite(own[i]) else "-" for label, own in errors.items()}
        for i, step in enumerate(ladder.steps)
    ]
    caption = "Error of the worst balance of the rig, and of the replay, in multiples of the noise floor."
    return Section(
        "The error, step by step", [figure(ladder_figure(ladder), caption), table(rows, "Error in noise floors")]
    )


def _shape(found: Diagnosis) -> Section:
    surface = found.verdict.surface
    assert surface is not None
    words = surface.words
    whose = "the model with the effects that were found leaves" if found.added else "the base model leaves"
    return Section(
        "The shape of what is missing",
        [
            paragraph(f"What {whose} above the noise has a shape. {words[0].upper()}{words[1:]}."),
            figure(surface_figure(surface), "Missing force, orthogonal to what the base parameters can do."),
        ],
    )


def _rivals(found: Diagnosis) -> Section:
    error = error_name(found)
    rows = [
        {
            "hypothesis": c.effect,
            "probability": f"{100 * c.probability:.1f} %",
            f"{error} before [noise floors]": floors(c.holdout_before),
            "after [noise floors]": floors(c.holdout_after),
            "hidden by the base fit": f"{100 * c.absorbed_by_base:.0f} %",
        }
        for c in found.candidates
    ]
    pieces = []
    if evidence := evidence_rows(found):
        words = (
            "Each motion is predicted by a fit to the others: the model with an effect is held against the model "
            "without it, and against the model with another effect in its place."
        )
        pieces += [paragraph(words), table(evidence)]
    if rows:
        words = (
            "The hypotheses that were refitted, with all base parameters free, best first. The errors are those of the "
            "balance in which a hypothesis helps most."
        )
        pieces += [paragraph(words), table(rows)]
    pieces += why_not_pieces(found)
    return Section("Rivals", pieces or [paragraph("No hypothesis lowered the error.")])


def _change(found: Diagnosis) -> Section:
    known, named = list_known_effects(found.search), found.verdict.effects
    rig = found.final.campaign.specimen
    items = [f"{words}." for words in list_discriminating_tests(found.verdict, found.search)]
    for name in (n for n in named if n in known):
        tests = {
            r: test for r, test in known[name].confused_with.items() if r not in named and _can_have(rig, known[r])
        }
        items += [f"{rival} instead of {name}: {test}." for rival, test in tests.items()]
    items.append(
        "A run of another kind (amplitude, frequency, rest before it), kept from the fit, on which the error does not "
        "fall."
    )
    return Section("What would change our mind", [bullets(items), paragraph("`slipwise next` ranks table motions.")])


def _can_have(rig: Specimen, effect: Effect) -> bool:
    """Return whether a rig has what an effect acts on: one slider has neither buffers nor a girder."""
    absent = {"buffers"} if not rig.buffer_stiffness else set[str]()
    return absent.isdisjoint(effect.all_needs) and (rig.free or "balances" not in effect.all_needs)


def _limits(found: Diagnosis) -> Section:
    pieces = []
    if found.cannot_tell:
        pieces.append(bullets(cannot_tell_words(found)))
    if notes := found.final.campaign.notes:
        pieces += [paragraph("What was done to the records, and what was assumed of them:"), bullets(list(notes))]
    known = list_known_effects(found.search)
    least = [_least_row(known.get(name), name, size, unit) for name, (size, unit) in found.least.items()]
    pieces.append(details("Smallest size of each effect that this campaign would have shown", [table(least)]))
    seen = [
        {"candidate": s.term.label, "explains alone": f"{s.gain:.3g}", "hidden by the base fit": f"{s.absorbed:.0%}"}
        for s in found.search.alone
    ]
    words = paragraph("Without a refit: drop of the squared residual of the fitted runs, in variances of the noise.")
    pieces.append(details(f"What each of {len(seen)} candidates could explain alone", [words, table(seen)]))
    return Section("What this campaign could not tell", pieces)


def _least_row(effect: Effect | None, name: str, size: float, unit: str) -> dict[str, str]:
    own = [p.shown_in for p in effect.parameters if p.unit == unit and p.shown_in] if effect else []
    shown = own[0] if own else usual_unit(unit)
    return {"effect": name, "smallest size": f"{convert(size, unit, shown):.3g}", "unit": "" if shown == "1" else shown}
