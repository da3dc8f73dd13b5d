"""The base fit: the user's model with its own parameters and the rig's numbers, nothing missing added."""

from dataclasses import dataclass

from slipwise.campaign import Campaign
from slipwise.fit.data import fit_runs
from slipwise.fit.problem import Problem
from slipwise.fit.solve import Solution, solve
from slipwise.fit.terms import Free, base_free, terms_of
from slipwise.model import Model, base_model
from slipwise.signals import LowPass

#: Noise near reversals depends on the fit and the fit on the noise: so often each is made anew.
_ROUNDS = 2
#: Filters that are tried where the campaign does not say what the logger did; their frequency is fitted.
_KINDS: tuple[LowPass, ...] = (LowPass(100.0, 4), LowPass(100.0, 2), LowPass(100.0, 4, "aligned"))


@dataclass(frozen=True)
class BaseFit:
    """What the base model makes of a campaign.

    Attributes:
        campaign: that was fitted.
        model: where the fit began.
        problem: relations and noise.
        free: base parameters.
        solution: the fit.
    """

    campaign: Campaign
    model: Model
    problem: Problem
    free: tuple[Free, ...]
    solution: Solution


def fit_base(campaign: Campaign, model: Model | None = None) -> BaseFit:
    """Fit a campaign's base parameters on its runs of role fit and repeat.

    Args:
        campaign: with at least one run that is not held out.
        model: the user's current model; the paper's law on the campaign's rig when not given.

    Raises:
        InputError: a run lacks what every fit needs.
    """
    model = model or base_model(campaign.specimen)
    runs = fit_runs(campaign)
    kinds = _KINDS[:1] if campaign.logger.known else _KINDS
    fits = [_fitted(campaign, model, Problem(runs, model.specimen, terms_of(model), logger=kind)) for kind in kinds]
    return min(fits, key=lambda f: f.solution.cost)


def _fitted(campaign: Campaign, model: Model, problem: Problem) -> BaseFit:
    free = base_free(model, balances=len(problem.relations) > 1, logger_known=campaign.logger.known)
    values = {f.key: f.start for f in free}
    problem.weigh(values)
    solution = solve(problem, values, free, most=6, enough=50.0)
    for _ in range(_ROUNDS):
        problem.weigh(solution.values)
        solution = solve(problem, solution.values, free, most=8, enough=1.0)
    return BaseFit(campaign, model, problem, tuple(free), solution)
