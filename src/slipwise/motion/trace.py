"""One component as a reader gives it, before it becomes x, y or z of a table."""

import warnings
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import InputError, SlipwiseWarning
from slipwise.motion.origin import Origin
from slipwise.motion.source_file import SourceFile
from slipwise.motion.table_motion import HeaderPeak

Array = NDArray[np.float64]
Baseline = Literal["mean", "linear", "none"]

#: No earthquake and no table reaches 1000 g: the unit is wrong, or the file damaged.
_LARGEST = 1e4


@dataclass(frozen=True, eq=False)
class Trace:
    """One recorded component.

    Attributes:
        source: the file.
        name: the component, e.g. "EW", "N28W", "90 DEG".
        title: event and station.
        dt: step [s].
        acceleration: (n,) as recorded [m/s^2].
        baseline: the treatment of the baseline that the format asks for.
        treatment: reader, unit and step in words.
        header_peak: what the file states, or None.
        origin: station, sensor, event and start that the file states.
        aliases: other names by which a user may choose it: "Chan 3", "3".
    """

    source: SourceFile
    name: str
    title: str
    dt: float
    acceleration: Array
    baseline: Baseline
    treatment: tuple[str, ...]
    header_peak: HeaderPeak | None = None
    origin: Origin = field(default_factory=Origin)
    aliases: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what cannot be a record.

        Raises:
            InputError: fewer than 2 values, or accelerations that no table reaches.
        """
        if len(self.acceleration) < 2:
            raise InputError(
                f"{self.source.name}: {len(self.acceleration)} values are no record; at least 2 are needed"
            )
        peak = float(np.abs(self.acceleration).max())
        if not peak < _LARGEST:
            raise InputError(
                f"{self.source.name}: component {self.name} reaches {peak:.3g} m/s^2; no table does, check the unit"
            )


def check_header_peak(values: Array, dt: float, stated: HeaderPeak, source: SourceFile, name: str) -> None:
    """Hold the data against the peak that their header states: it tells a wrong unit, a wrong step, a damaged record.

    Args:
        values: (n,) treated as the agency does [m/s^2].
        dt: their step [s].
        stated: the header's.
        source: the file.
        name: the component, for the message.

    Raises:
        InputError: the peaks differ by more than a tenth. A smaller difference, or another time, is a warning.
    """
    size = np.abs(values)
    found = float(size.max(initial=0.0))
    difference = abs(found - abs(stated.value))
    words = (
        f"{source.name}: the header states a peak of {abs(stated.value):.6g} m/s^2 for {name}, "
        f"the data reach {found:.6g} m/s^2"
    )
    # Half of the last digit, with room for the arithmetic of the agency.
    rounding = 1.01 * stated.rounding + 1e-6 * found
    if difference > max(0.1 * max(abs(stated.value), found), rounding):
        raise InputError(f"{words}; the record is damaged or its unit is not what the header says, fetch it again")
    if difference > max(1e-3 * abs(stated.value), 2 * rounding):
        warnings.warn(words, SlipwiseWarning, stacklevel=2)
    if stated.time is None:
        return
    near = round(stated.time / dt)
    if size[max(near - 1, 0) : max(near + 2, 0)].max(initial=0.0) < 0.99 * found:
        warnings.warn(
            f"{source.name}: the header states the peak of {name} at {stated.time:.6g} s, the data reach it at "
            f"{size.argmax() * dt:.6g} s; look at the step of {dt:g} s and at the start of the record",
            SlipwiseWarning,
            stacklevel=2,
        )


def half_last_digit(text: str) -> float:
    """Give half of the last digit of a number as written: 0.0005 for "22.962"."""
    decimals = text.strip().partition(".")[2]
    return 0.5 * 10.0 ** -len(decimals)
