"""What the binary files of laboratories hold: channels with name, unit and times of their own, made into columns."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import InputError

#: Steps of channels are one within this [1].
_SAME_STEP = 1e-6
#: Names of channels of another rate that a note lists.
_LISTED = 6


@dataclass(frozen=True)
class NamedColumns:
    """Columns by header.

    Attributes:
        columns: "name [unit]" -> (n,).
        step: that the file states beside them [s], None if it states none.
        notes: what a user should know of the file.
    """

    columns: dict[str, Array]
    step: float | None = None
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class NamedGauge:
    """One channel of a file: values (n,) in its unit, and its times (n,) [s], None where other channels hold them."""

    name: str
    unit: str
    values: Array
    time: Array | None = None


def unreadable(path: Path, what: str, error: Exception, todo: str = "export it again") -> InputError:
    """Make the error for a damaged file, with the first line of what the library that reads such files says."""
    reason = (str(error).splitlines() or [""])[0][:120] or type(error).__name__
    return InputError(f"{path}: not a readable {what} ({reason}); {todo}")


def one_step(path: Path, steps: set[float]) -> float | None:
    """Return the step that the channels of a file state [s], None where none is stated.

    Raises:
        InputError: they state different ones.
    """
    if steps and max(steps) > (1.0 + _SAME_STEP) * min(steps):
        listed = ", ".join(f"{step:g} s" for step in sorted(steps))
        raise InputError(
            f"{path}: its channels state different steps, {listed}; export those of one step to a file of their own"
        )
    return next(iter(steps), None)


def of_gauges(path: Path, gauges: Sequence[NamedGauge], kind: str) -> NamedColumns:
    """Make columns of the channels that share their times with most others; name those of other times.

    Args:
        path: the file.
        gauges: its channels of numbers.
        kind: of the file, for messages.

    Raises:
        InputError: there are no channels of numbers.
    """
    groups: list[list[NamedGauge]] = []
    for gauge in (g for g in gauges if len(g.values) > 1):
        group = next((group for group in groups if _together(group[0], gauge)), None)
        if group is None:
            groups.append([gauge])
        else:
            group.append(gauge)
    if not groups:
        raise InputError(f"{path}: no channel of numbers is in this {kind} file")
    chosen = max(groups, key=lambda group: (len(group), len(group[0].values)))
    columns: dict[str, Array] = {}
    if chosen[0].time is not None:
        columns["time [s]"] = chosen[0].time
    for gauge in chosen:
        header = f"{gauge.name} [{gauge.unit}]" if gauge.unit else gauge.name
        k = 2
        while header in columns:
            header = f"{gauge.name} ({k}) [{gauge.unit}]" if gauge.unit else f"{gauge.name} ({k})"
            k += 1
        columns[header] = gauge.values
    others = [gauge.name for group in groups if group is not chosen for gauge in group]
    if not others:
        return NamedColumns(columns)
    listed = ", ".join(others[:_LISTED]) + (" and others" if len(others) > _LISTED else "")
    counted = (
        "1 channel has other times and is" if len(others) == 1 else f"{len(others)} channels have other times and are"
    )
    return NamedColumns(columns, None, (f"{path.name}: {counted} left out: {listed}",))


def _together(one: NamedGauge, other: NamedGauge) -> bool:
    if len(one.values) != len(other.values) or (one.time is None) != (other.time is None):
        return False
    if one.time is None or other.time is None:
        return True
    step = float(one.time[-1] - one.time[0]) / (len(one.time) - 1)
    return bool(np.abs(one.time - other.time).max() <= _SAME_STEP * max(abs(step) * len(one.time), 1e-12))
