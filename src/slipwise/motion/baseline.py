"""Treatment of the baseline of one component: what is taken away is said."""

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import SettingError
from slipwise.motion.trace import Baseline


def without_baseline(values: Array, how: Baseline) -> tuple[Array, str]:
    """Take the baseline away.

    Args:
        values: (n,) [m/s^2].
        how: "mean", "linear" (least squares line) or "none".

    Returns:
        The treated values and what was done, in words.

    Raises:
        SettingError: another word.
    """
    if how == "none":
        return values, "baseline left as it is"
    if how == "mean":
        mean = float(values.mean())
        return values - mean, f"mean of {mean:.6g} m/s^2 removed"
    if how == "linear":
        place = np.linspace(-1.0, 1.0, len(values))
        mean, slope = float(values.mean()), float(values @ place / (place @ place))
        line = mean + slope * place
        return values - line, f"line from {line[0]:.6g} to {line[-1]:.6g} m/s^2 removed"
    raise SettingError(f"a baseline treatment {how!r} does not exist; mean, linear and none do")
