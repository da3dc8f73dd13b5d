"""Size of a strength that is one limit of materiality: what moves slip, energy, load or a channel by its limit.

It is told by a replay with a small strength and one without. Not by the change of component forces: a guide's drag
changes forces by nearly nothing and slip by a third. A gauge's fault is held against the channel that it changes.
Forms of one candidate are replayed once, the others follow in proportion to what they change directly.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from slipwise.campaign.materiality import Materiality
from slipwise.errors import SlipwiseError
from slipwise.estimation.base_fit import BaseFit
from slipwise.jobs.parallel import on_every_core
from slipwise.model import Model
from slipwise.relations.measurement import apply_gauge_faults
from slipwise.relations.parameters import Term
from slipwise.selection.hypothesis import Hypothesis
from slipwise.selection.hypothesis_fit import make_fit
from slipwise.selection.importance import (
    Answer,
    build_answering_model,
    choose_shown,
    compute_answer,
    compute_share_of_channel,
    is_replayable,
)
from slipwise.selection.initial_grid import shapes, strengths
from slipwise.selection.sensitivities import small
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class Moved:
    """What some size of an effect moves.

    Attributes:
        share: the largest of its changes, as a share of what matters [1]; 0 where no answer can be given.
        responses: name of `RESPONSES` -> change of the replayed run, with its sign [m, J, N]; empty for gauges.
    """

    share: float
    responses: Mapping[str, float] = field(default_factory=dict[str, float])


def compute_units(
    base: BaseFit, terms: Sequence[Term], whole: Sequence[Hypothesis], limits: Materiality, most: Mapping[str, int]
) -> dict[tuple[str, str], Moved]:
    """Return (label, strength) -> what the small strength of its column moves.

    Args:
        base: the fit from which the candidates depart.
        terms: candidates.
        whole: fits of `fit_whole`: all of a candidate together has the strength "".
        limits: what matters.
        most: label -> place of a run in which the candidate does more than in the last one, if any.
    """
    moved = [(term, p) for term in terms for p in strengths(term.effect)]
    sizes = [(term, small(term.effect, shapes(term.effect)[0], p)) for term, p in moved]
    answers = compute_moved_by_sizes(base, sizes, limits, most)
    found = {(term.label, p.name): one for (term, p), one in zip(moved, answers, strict=True)}
    return found | compute_units_of_fits(base, whole, limits)


def compute_moved_by_sizes(
    here: BaseFit, asked: Sequence[tuple[Term, Mapping[str, float]]], limits: Materiality, most: Mapping[str, int]
) -> list[Moved]:
    """Return what each term moves at these values, added to a fit.

    Args:
        here: a fit without the terms.
        asked: term, and values of its parameters.
        limits: what matters.
        most: as of `compute_units`.
    """
    whole, places = build_answering_model(here), [choose_shown(here), *dict.fromkeys(most.values())]
    bare = {place: _answer(whole, here, place) for place in dict.fromkeys(places)}

    def moved(k: int) -> Moved:
        term, values = asked[k]
        if term.effect.port == "gauge":
            return Moved(_share_of_gauge(here, term, values, limits))
        model = _having(whole, term, {f"{term.label}.{n}": v for n, v in values.items()})
        own = [places[0], *([most[term.label]] if term.label in most else [])]
        return _compare(here, model, bare, own, limits)

    return list(on_every_core(moved, len(asked)))


def compute_sizes_in_place(
    here: BaseFit, terms: Sequence[Term], laws: Mapping[str, BaseFit], limits: Materiality
) -> dict[str, float]:
    """Return the label of each term of a model -> what leaving it out changes, as a share of what matters [1].

    Args:
        here: a fit with the terms.
        terms: of the model.
        laws: label of a term that takes another's place -> the fit with that other one.
        limits: what matters.
    """
    values, places = here.solution.values, list(dict.fromkeys([choose_shown(here), here.objective.fitted[0]]))
    whole = build_answering_model(here)
    bare = {place: _answer(whole, here, place) for place in places}

    def size(k: int) -> float:
        term = terms[k]
        if term.label in laws:
            return _compare(here, build_answering_model(laws[term.label]), bare, places, limits).share
        if term.effect.port == "gauge":
            own = {n: values[f"{term.label}.{n}"] for n in term.effect.parameter_names}
            return _share_of_gauge(here, term, own, limits)
        return _compare(here, whole.without(*(u.label for u in term.uses(values))), bare, places, limits).share

    return {t.label: x for t, x in zip(terms, on_every_core(size, len(terms)), strict=True)}


def compute_units_of_fits(
    here: BaseFit, whole: Sequence[Hypothesis], limits: Materiality
) -> dict[tuple[str, str], Moved]:
    """Return (label, "") -> what a candidate moves as it was fitted.

    A law that takes another's place is held against the fit with that other one, what else is added against nothing.

    Args:
        here: the fit without the candidates.
        whole: fits of `fit_whole`.
        limits: what matters.
    """
    if not whole:
        return {}
    place = choose_shown(here)
    without = {place: _answer(build_answering_model(here), here, place)}

    def moved(k: int) -> Moved:
        [term], fit = whole[k].terms, make_fit(here, whole[k], with_slopes=False)
        if term.effect.port == "gauge":
            return Moved(_share_of_gauge(fit, term, whole[k].values_of(term), limits))
        model = build_answering_model(fit)
        if term.effect.replaces:
            return _compare(here, model, without, [place], limits)
        bare = model.without(*(u.label for u in term.uses(fit.solution.values)))
        return _compare(fit, bare, {place: _answer(model, fit, place)}, [place], limits)

    answers = on_every_core(moved, len(whole))
    return {(h.terms[0].label, ""): x for h, x in zip(whole, answers, strict=True)}


def _answer(model: Model, here: BaseFit, place: int) -> Answer:
    """Return what a fit's own model answers."""
    replayed = is_replayable(model, here, place)
    return compute_answer(model, here, place, replayed=replayed, rough=True, partly=True)


def _having(model: Model, term: Term, values: Mapping[str, float]) -> Model:
    """Return a model with a term; one over whose slip friction turns round takes the place of the base's stick."""
    if term.effect.reverses:
        model = model.without(*(u.label for u in model.uses if u.effect.reverses))
    return model.adding(*term.uses(values))


def _compare(
    here: BaseFit, model: Model, bare: Mapping[int, Answer], places: Sequence[int], limits: Materiality
) -> Moved:
    """Return what a model moves against the bare answers.

    Slip, energy and load count in the first of the places, channels in all: wear may be over when that run begins.
    """
    shares: list[float] = []
    changes: dict[str, float] = {}
    for number, place in enumerate(places):
        run, without = here.objective.run(place), bare[place]
        try:
            there = compute_answer(model, here, place, replayed=without.replayed, rough=True)
        except (SlipwiseError, FloatingPointError):
            return Moved(0.0)
        for c in (c for c in there.channels if c in run.record and c in without.channels):
            change = there.channels[c] - without.channels[c]
            shares.append(compute_share_of_channel(change, run.record[c]) / limits.channel)
        if number == 0:
            pairs = {r: (there.responses[r], size) for r, size in without.responses.items() if size > 0.0}
            # of the larger of the two: a spring loses next to no energy, and any change would be many times that
            shares += [abs(x - size) / max(x, size) / limits.response for x, size in pairs.values()]
            changes = {r: x - size for r, (x, size) in pairs.items()}
    best = max(shares, default=0.0)
    return Moved(best, changes) if np.isfinite(best) else Moved(0.0)


def _share_of_gauge(here: BaseFit, term: Term, values: Mapping[str, float], limits: Materiality) -> float:
    """Return by how much a fault changes the channel that it changes most, as a share of what matters [1]."""
    keyed = {f"{term.label}.{k}": v for k, v in values.items()}
    best = 0.0
    try:
        for run in here.objective.fitted_runs:
            changed = apply_gauge_faults([term], keyed, run.record)
            for name in (n for n in term.targets if n in run.record and n in changed):
                best = max(best, compute_share_of_channel(changed[name] - run.record[name], run.record[name]))
    except SlipwiseError:
        return 0.0
    return best / limits.gauge
