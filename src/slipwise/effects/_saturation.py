"""What rises in proportion at first and then saturates."""

from math import exp, expm1

from numba.extending import register_jitable


@register_jitable
def risen(x: float) -> float:
    """Give 1 - exp(-x) [1], of x >= 0; `expm1` takes three times as long, and only a small x needs its digits."""
    return 1.0 - exp(-x) if x > 0.5 else -expm1(-x)
