"""Upper limit of a strength that may well be zero: the profile of the likelihood, for the bound makes it lopsided.

    u:  min over all other numbers of cost(strength = u)  -  cost at the fit  =  t^2 v,    v = sandwich / plain variance

A strength that cannot be negative and is fitted near zero has no symmetric interval: half of it would lie where nothing
can be. What the data say is how large it can be at most. v makes up for noise that is correlated.

Source: Self and Liang (1987) on bounds, Raue et al. (2009) on profiles, Kent (1982) on v.
"""

from collections.abc import Callable

import numpy as np

from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.least_squares import get_slopes, solve
from slipwise.relations.parameters import Free

#: The limit is found when its cost is this near to what was asked for, as a share [1], or after this many fits.
_NEAR, _MOST = 0.03, 10


def is_strength(base: BaseFit, free: Free) -> bool:
    """Return whether a free number is an effect's strength that is absent at its lower bound."""
    for term in base.objective.terms:
        if p := term.parameters.get(free.key):
            return p.neutral is not None and p.neutral == p.low
    return False


def find_upper_limit(base: BaseFit, free: Free, first: float, rise: float) -> float:
    """Return the strength [SI] at which the profile has risen so far, or its upper bound.

    Args:
        base: the fit; all other numbers are fitted again at each strength that is tried.
        free: the strength.
        first: a first guess of the limit's distance from the fitted value [SI].
        rise: of the squared residual.
    """
    at = base.solution.values[free.key]
    furthest = free.high - at

    def root(distance: float) -> float:
        return float(np.sqrt(max(_profiled(base, free, at + distance) - base.solution.cost, 0.0)))

    return at + _reached(root, float(np.sqrt(rise)), min(first, furthest), furthest)


def _profiled(base: BaseFit, free: Free, value: float) -> float:
    others = [f for f in base.solution.free if f.key != free.key]
    slopes = get_slopes(base.solution)
    known = {f.key: slopes[f.key] for f in others}
    values = {**base.solution.values, free.key: value}
    return solve(base.objective, values, others, most=4, enough=0.1, known=known).cost


def _reached(rising: Callable[[float], float], goal: float, first: float, furthest: float) -> float:
    """Find where a function that rises from 0 at 0, much like a straight line, reaches a goal; `furthest` if never."""
    low, low_value, high, here = 0.0, 0.0, furthest, first
    for _ in range(_MOST):
        value = rising(here)
        if abs(value - goal) < _NEAR * goal:
            return here
        if value < goal:
            if here >= furthest:
                return furthest
            low, low_value = here, value
            guess = here * goal / value if value > 0.0 else 4.0 * here
            here = min(max(guess, 1.1 * here), 4.0 * here, high if high < furthest else furthest)
        else:
            high = here
            here = low + (here - low) * (goal - low_value) / (value - low_value)
    return here
