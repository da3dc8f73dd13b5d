"""What the logger's filter was, where the campaign does not say: the one through which reversals look as they do.

At a reversal friction turns round within a fraction of a millisecond. What the record makes of that step is the
filter's own step response, ringing and lag included, so kind, order and frequency can be read from it.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from slipwise.campaign import Campaign, Logger
from slipwise.cores import on_every_core
from slipwise.fit.data import fit_runs
from slipwise.fit.problem import Problem
from slipwise.fit.solve import Solution, solve
from slipwise.fit.terms import YAW_INERTIA, Term, base_free, terms_of
from slipwise.model import Model
from slipwise.signals import LowPass

_KINDS: tuple[tuple[int, str], ...] = ((4, "zero"), (2, "zero"), (4, "causal"), (2, "causal"))
_FREQUENCIES: tuple[float, ...] = (55.0, 80.0, 115.0, 165.0)
#: A kind is looked at more closely while its best error is within this factor of the best of all.
_NEAR = 1.6
#: A closer look is in vain where the worst of all is not this much worse than the best: the law is wrong by far more
#: than a filter could be [1].
_HEARD = 1.3
#: Ratio of neighbouring frequencies at which the closer look begins and ends; each round takes its square root.
_WIDE, _NARROW = 1.2, 1.02
#: Numbers of the rig that decide how a reversal looks.
_OF_REVERSALS = ("rig.stick_length", "rig.late_force", "rig.pitch_slip", "rig.shear_strength")


def estimated_logger(campaign: Campaign, model: Model, first: Solution, terms: Sequence[Term] = ()) -> LowPass:
    """Give the filter under which the law of friction, fitted anew for each, explains one run's pads best.

    A law that was fitted under a wrong filter has bent itself to it and speaks for a filter like that one.

    Args:
        campaign: of unknown logger.
        model: its base model.
        first: a fit with a guessed filter; a start.
        terms: effects that this fit has added to the model: what they do at reversals is not the filter's doing.
    """
    fastest = max(campaign.with_role("fit", "repeat"), key=lambda r: float(np.ptp(r.record["slip_x"])))
    limit = 0.48 / fastest.record.dt
    alone = replace(campaign, runs=(replace(fastest, role="fit"),))
    start = {k: v for k, v in first.values.items() if k != "rig.logger"}
    start |= {"rig.stick_length": 1e-6, "rig.late_force": 0.0}
    own = [f for f in base_free(model, balances=True) if not f.key.startswith("rig.") or f.key in _OF_REVERSALS]
    if terms:
        beside = tuple(f"{t.label}." for t in terms)
        own += [f for f in first.free if f.key.startswith(beside) or f.key == YAW_INERTIA]
    tried: dict[LowPass, float] = {}

    def error(kind: LowPass) -> float:
        runs = fit_runs(replace(alone, logger=Logger(kind, known=True)))
        problem = Problem(runs, model.specimen, (*terms_of(model), *terms))
        problem.relations = ("pads",)
        problem.weigh(start)
        values = solve(problem, start, own, most=3, enough=20.0).values
        problem.weigh(values)
        found = solve(problem, values, own, most=1, enough=20.0)
        return float(np.sum((found.residuals.parts["pads"][0] * problem.sigmas["pads"][0]) ** 2))

    def try_all(kinds: Sequence[LowPass]) -> None:
        fresh = [k for k in kinds if k not in tried]
        tried.update(zip(fresh, on_every_core(lambda i: error(fresh[i]), len(fresh)), strict=True))

    coarse = [[LowPass(f, order, phase) for f in _FREQUENCIES if f < limit] for order, phase in _KINDS]
    try_all([kind for kinds in coarse for kind in kinds])
    best = min(tried, key=tried.__getitem__)
    if max(tried.values()) < _HEARD * tried[best]:
        return best
    leaders = [min(kinds, key=tried.__getitem__) for kinds in coarse]
    leaders = [k for k in leaders if tried[k] <= _NEAR * tried[best]]
    ratio = _WIDE
    while ratio > _NARROW:
        beside = [[replace(k, frequency=k.frequency * x) for x in (1.0 / ratio, 1.0, ratio)] for k in leaders]
        beside = [[k for k in kinds if k.frequency < limit] for kinds in beside]
        try_all([k for kinds in beside for k in kinds])
        leaders = [min(kinds, key=tried.__getitem__) for kinds in beside]
        ratio = float(np.sqrt(ratio))
    return min(leaders, key=tried.__getitem__)
