"""Factors on a motion: one, or a range in steps."""

import numpy as np

from slipwise.errors import SettingError

#: More factors than this are a slip of the pen.
_MOST = 1000
#: An end that rounding has moved counts, within this share of a step [1].
_CLOSE = 1e-6


def read_scales(text: str) -> tuple[float, ...]:
    """Read "A:B:STEP", both ends included, or one factor.

    Raises:
        SettingError: it cannot be read, a factor is not positive, or the range is empty.
    """
    what = f"--scale {text!r}"
    try:
        parts = [float(part) for part in text.split(":")]
    except ValueError:
        parts = []
    if len(parts) not in (1, 3) or not np.all(np.isfinite(parts)):
        raise SettingError(f"{what}: give FIRST:LAST:STEP, for example 0.5:3:0.5, or one factor")
    if len(parts) == 1:
        parts = [parts[0], parts[0], 1.0]
    first, last, step = parts
    if not (first > 0.0 and step > 0.0 and last >= first):
        raise SettingError(f"{what}: the first factor and the step must be above 0, and the last not below the first")
    count = int((last - first) / step + 1.0 + _CLOSE)
    if count > _MOST:
        raise SettingError(f"{what}: these are {count} factors; at most {_MOST} are possible")
    return tuple(float(f"{first + i * step:.12g}") for i in range(count))
