"""One component as a reader gives it, before it becomes x, y or z of a table."""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import InputError
from slipwise.motion.origin import MotionOrigin
from slipwise.motion.source_file import SourceFile
from slipwise.motion.table_motion import HeaderPeak

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
        treatment: reader, unit and step in words.
        baseline: the treatment of the baseline that the format asks for.
        header_peak: what the file states, or None.
        origin: station, sensor, event and start that the file states.
        aliases: other names by which a user may choose it: "Chan 3", "3".
        letter_of_file: whether its name is no more than the letter that the file's name ends in.
    """

    source: SourceFile
    name: str
    title: str
    dt: float
    acceleration: Array
    treatment: tuple[str, ...]
    baseline: Baseline = "none"
    header_peak: HeaderPeak | None = None
    origin: MotionOrigin = field(default_factory=MotionOrigin)
    aliases: tuple[str, ...] = ()
    letter_of_file: bool = False

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


def half_last_digit(text: str) -> float:
    """Return half of the last digit of a number as written: 0.0005 for "22.962"."""
    decimals = text.strip().partition(".")[2]
    return 0.5 * 10.0 ** -len(decimals)
