"""A hypothesis as a fit of its own, as intervals, the table of errors and replays take it."""

from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.least_squares import with_slopes as take_slopes
from slipwise.selection.hypothesis import Hypothesis
from slipwise.selection.jacobian_memory import complete_jacobian


def make_fit(base: BaseFit, found: Hypothesis, *, with_slopes: bool = True) -> BaseFit:
    """Return a hypothesis as a fit of its own, with its own Jacobian, for intervals, locating and replays.

    Args:
        base: the base fit.
        found: the hypothesis.
        with_slopes: take its slopes, those that it has are of a fit nearby; `refit_for_report` has taken its own.
    """
    if found.solution is base.solution:
        return base
    found = complete_jacobian(found)
    solution = take_slopes(found.objective, found.solution) if with_slopes else found.solution
    return BaseFit(base.campaign, base.model, found.objective, solution.free, solution)
