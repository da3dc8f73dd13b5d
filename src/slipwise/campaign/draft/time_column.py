"""Which column of a laboratory holds the time, and in which unit where none is written."""

from collections.abc import Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.draft.column import Column, Mapped

#: A stated step agrees with a column within this [1]; steps longer than this are milliseconds, or no shaking [s].
_AGREES, _LONGEST = 0.02, 0.5
#: A time counts from 1970 where it lies between 2001 and 2096, in each unit [s]; in days, from 1900: 1990 to 2060.
_SINCE_1970 = (1.0e9, 4.0e9)
_DAYS_SINCE_1900 = (33_000.0, 58_500.0)
_UNITS = (("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9))


def time_column(columns: Sequence[Column], step: float | None) -> tuple[str, Mapped] | None:
    """Return the header of the column of times and how it is mapped; None where no column can be one.

    Args:
        columns: of the file.
        step: that the file states [s], None if it states none.
    """
    rising = [c for c in columns if len(c.values) > 1 and np.all(np.diff(c.values) > 0.0) and not c.no_channel]
    timed = [c for c in rising if c.kind == "time" and c.unit != "?"]
    if timed:
        first = next((c for c in timed if "time" in c.meanings), timed[0])
        return first.header, Mapped("time", first.unit, 1, "it rises, in a unit of time", "sure")
    for column in (c for c in rising if "time" in c.meanings and c.unit == "?" and c.kind in ("time", "")):
        unit, why, sure = _unit_of(column.values, step)
        return column.header, Mapped("time", unit, 1, why, sure)
    if step is not None:
        return None  # times follow from the stated step
    lengths = [c for c in columns if c.kind == "length"]
    # "X_Value" is LabVIEW's word for the time, and looks like a displacement
    bare = [c for c in rising if c.unit == "?" and (not c.kind or (c is columns[0] and c in lengths[:-1]))]
    for column in (c for c in bare if rises_evenly(c.values)):
        if _counts(column.values):
            continue
        usual = float(np.median(np.diff(column.values)))
        unit = "s" if usual <= _LONGEST else "?"
        return column.header, Mapped("time", unit, 1, f"the only column that rises evenly, by {usual:.4g}", "guess")
    return None


def no_time(columns: Sequence[Column]) -> str:
    """Say why no column of a file was proposed as time."""
    named = [c for c in columns if "time" in c.meanings and c.kind in ("time", "")]
    if not named:
        return "no column is called time or rises evenly"
    falls = int(np.sum(np.diff(named[0].values) <= 0.0))
    return f"{named[0].header!r} is called time, and does not rise in {falls} of its {len(named[0].values)} rows"


def rises_evenly(values: Array) -> bool:
    """Return whether values (n,) rise by one step, as far as their rounding shows it."""
    if len(values) < 3:
        return False
    step = float(values[-1] - values[0]) / (len(values) - 1)
    return step > 0.0 and bool(np.abs(values - values[0] - step * np.arange(len(values))).max() < step)


def _counts(values: Array) -> bool:
    return bool(np.all(np.diff(values) == 1.0))


def _unit_of(values: Array, step: float | None) -> tuple[str, str, str]:
    """Return the unit of a column of times, why, and how sure that is."""
    usual, first = float(np.median(np.diff(values))), float(values[0])
    if step is not None:
        for unit, size in _UNITS:
            if abs(usual * size / step - 1.0) < _AGREES:
                return unit, f"it rises by the step of {step:g} s that the file states", "sure"
    for unit, size in _UNITS:
        if _SINCE_1970[0] <= first * size <= _SINCE_1970[1]:
            return unit, "it counts from 1970", "likely"
    if _DAYS_SINCE_1900[0] <= first <= _DAYS_SINCE_1900[1] and usual < 1e-3:
        return "d", "days since 1900, as spreadsheets count", "likely"
    if usual > _LONGEST:
        return "?", f"it rises by {usual:.4g}: is that in s or in ms?", "guess"
    return "s", f"no unit is written: seconds, it rises by {usual:.4g}", "likely"
