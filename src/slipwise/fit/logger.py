"""What the logger's filter was, where the campaign does not say: the one through which reversals look as they do.

At a reversal friction turns round within a fraction of a millisecond. What the record makes of that step is the
filter's own step response, ringing and lag included, so kind, order and frequency can be read from it.
"""

from dataclasses import replace

import numpy as np

from slipwise.campaign import Campaign, Logger
from slipwise.fit.data import fit_runs
from slipwise.fit.problem import Problem
from slipwise.fit.solve import Solution
from slipwise.fit.terms import terms_of
from slipwise.model import Model
from slipwise.signals import LowPass

_KINDS: tuple[tuple[int, str], ...] = ((4, "zero"), (2, "zero"), (4, "causal"), (2, "causal"))
_FREQUENCIES: tuple[float, ...] = (50.0, 65.0, 80.0, 100.0, 125.0, 155.0, 190.0)
_FINER: tuple[float, ...] = (0.9, 0.95, 1.05, 1.1)


def estimated_logger(campaign: Campaign, model: Model, first: Solution) -> LowPass:
    """Give the filter under which a fitted law explains the reversals of one run best.

    Args:
        campaign: of unknown logger.
        model: its base model.
        first: a fit with a guessed filter; its law is kept.
    """
    fastest = max(campaign.with_role("fit", "repeat"), key=lambda r: float(np.ptp(r.record["slip_x"])))
    limit = 0.48 / fastest.record.dt
    alone = replace(campaign, runs=(fastest,))
    values = {**first.values, "rig.stick_length": 1e-7, "rig.late_force": 0.0, "rig.pitch_slip": 0.0}
    values.pop("rig.logger", None)

    def error(kind: LowPass) -> float:
        runs = fit_runs(replace(alone, logger=Logger(kind, known=True)))
        problem = Problem(runs, model.specimen, terms_of(model))
        problem.weigh(values)
        problem.weigh(values)
        left = problem.residuals(values).parts["pads"][0] * problem.sigmas["pads"][0]
        return float(np.sum(left**2))

    kinds = [LowPass(f, order, phase) for order, phase in _KINDS for f in _FREQUENCIES if f < limit]
    tried = {kind: error(kind) for kind in kinds}
    best = min(tried, key=lambda k: tried[k])
    finer = [replace(best, frequency=best.frequency * x) for x in _FINER if best.frequency * x < limit]
    tried.update({kind: error(kind) for kind in finer})
    return min(tried, key=lambda k: tried[k])
