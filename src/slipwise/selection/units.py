"""Size of a strength that is one limit of materiality: what moves slip, energy, load or a channel by its limit.

It is told by a replay with a small strength and one without. Not by the change of component forces: a guide's drag
changes forces by nearly nothing and slip by a third. A gauge's fault is held against the channel that it changes.
Forms of one candidate are replayed once, the others follow in proportion to what they change directly.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from slipwise.campaign.materiality import Materiality
from slipwise.comparison.system_level import build_replayed_model
from slipwise.diagnosis.importance import Answer, compute_answer, compute_share_of_channel, is_replayable
from slipwise.diagnosis.initial_grid import shapes, strengths
from slipwise.diagnosis.sensitivities import small
from slipwise.errors import SlipwiseError
from slipwise.estimation.base_fit import BaseFit
from slipwise.jobs.parallel import on_every_core
from slipwise.relations.measurement import apply_gauge_faults
from slipwise.relations.parameters import Term


def compute_units(base: BaseFit, terms: Sequence[Term], limits: Materiality) -> dict[tuple[str, str], float]:
    """Return (label, strength) -> share of the limit that the small strength of its column changes [1].

    Args:
        base: the fit from which the candidates depart.
        terms: candidates.
        limits: what matters.
    """
    asked = [
        (term, p.name, small(term.effect, shapes(term.effect)[0], p)) for term in terms for p in strengths(term.effect)
    ]
    shares = compute_shares_of_sizes(base, [(term, values) for term, _, values in asked], limits)
    return {(term.label, name): share for (term, name, _), share in zip(asked, shares, strict=True)}


def choose_shown(base: BaseFit) -> int:
    """Return the place of the run whose answer tells what matters: the held-out one, else the last that is fitted."""
    return [*base.objective.held_out, *base.objective.fitted[-1:]][0]


def compute_share_of_limit(bare: Answer, there: Answer, base: BaseFit, place: int, limits: Materiality) -> float:
    """Return the largest change between two answers of a run, as a share of what matters [1].

    Args:
        bare: the answer without.
        there: the answer with what is asked for.
        base: the fit, whose record says how large a channel is.
        place: of the run.
        limits: what matters.
    """
    record = base.objective.run(place).record
    shares = [
        compute_share_of_channel(there.channels[c] - bare.channels[c], record[c]) / limits.channel
        for c in there.channels
        if c in record and c in bare.channels
    ]
    shares += [abs(there.responses[r] / size - 1.0) / limits.response for r, size in bare.responses.items() if size > 0]
    best = max(shares, default=0.0)
    return best if np.isfinite(best) else 0.0


def _share_of_gauge(base: BaseFit, term: Term, values: Mapping[str, float]) -> float:
    keyed = {f"{term.label}.{k}": v for k, v in values.items()}
    best = 0.0
    for run in base.objective.fitted_runs:
        changed = apply_gauge_faults([term], keyed, run.record)
        for name in term.targets:
            if name in run.record and name in changed:
                best = max(best, compute_share_of_channel(changed[name] - run.record[name], run.record[name]))
    return best


def compute_shares_of_sizes(
    here: BaseFit, asked: Sequence[tuple[Term, Mapping[str, float]]], limits: Materiality
) -> list[float]:
    """Return the share of the limit that each term changes at these values, added to a fit [1]; 0 where none answers.

    Args:
        here: a fit without the terms.
        asked: term, and values of its parameters.
        limits: what matters.
    """
    objective, shown = here.objective, choose_shown(here)
    replayed = is_replayable(objective, shown)
    whole = build_replayed_model(here)[0] if objective.specimen.free else objective.model(here.solution.values)
    bare = compute_answer(whole, here, shown, replayed=replayed)

    def share(k: int) -> float:
        term, values = asked[k]
        try:
            if term.effect.port == "gauge":
                return _share_of_gauge(here, term, values) / limits.gauge
            keyed = {f"{term.label}.{n}": v for n, v in values.items()}
            there = compute_answer(whole.adding(*term.uses(keyed)), here, shown, replayed=replayed)
        except (SlipwiseError, FloatingPointError):
            return 0.0
        return compute_share_of_limit(bare, there, here, shown, limits)

    return list(on_every_core(share, len(asked)))


def compute_sizes_in_place(here: BaseFit, terms: Sequence[Term], limits: Materiality) -> dict[str, float]:
    """Return the label of each term of a model -> what leaving it out changes, as a share of what matters [1].

    Args:
        here: a fit with the terms.
        terms: of the model.
        limits: what matters.
    """
    objective, values = here.objective, here.solution.values
    shown = choose_shown(here)
    replayed = is_replayable(objective, shown)
    whole = build_replayed_model(here)[0] if objective.specimen.free else objective.model(values)
    bare = compute_answer(whole, here, shown, replayed=replayed)

    def size(k: int) -> float:
        term = terms[k]
        try:
            if term.effect.port == "gauge":
                own = {n: values[f"{term.label}.{n}"] for n in term.effect.parameter_names}
                return _share_of_gauge(here, term, own) / limits.gauge
            less = whole.without(*(u.label for u in term.uses(values)))
            there = compute_answer(less, here, shown, replayed=replayed)
        except (SlipwiseError, FloatingPointError):
            return 0.0
        return compute_share_of_limit(bare, there, here, shown, limits)

    return {t.label: x for t, x in zip(terms, on_every_core(size, len(terms)), strict=True)}
