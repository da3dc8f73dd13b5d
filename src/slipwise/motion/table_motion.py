"""A table motion: three components of acceleration at one step, with everything that was done to them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from slipwise.arrays import Array
from slipwise.display import Drawn, frame
from slipwise.errors import InputError

if TYPE_CHECKING:
    from pandas import DataFrame


#: The table's axes: x is the shaking direction, z is up.
AXES: tuple[str, str, str] = ("x", "y", "z")


@dataclass(frozen=True)
class HeaderPeak:
    """The peak that an agency states in its file.

    Attributes:
        value: as stated, with the sign of the file's component [m/s^2].
        time: after the first sample of the file [s]; None where the file gives no time.
        rounding: half of the last digit that the file gives [m/s^2].
        written: number and unit as they stand there, "" if the file's format fixes the unit.
    """

    value: float
    time: float | None
    rounding: float
    written: str = ""


@dataclass(frozen=True)
class Steady:
    """The part of a sine at full amplitude: from start to end, in cycles of one period, all [s]."""

    start: float
    end: float
    period: float


@dataclass(frozen=True, eq=False, repr=False)
class TableMotion(Drawn):
    """Acceleration of the table over time.

    Attributes:
        dt: step [s].
        acceleration: (n, 3), x (shaking direction), y (across), z (up) [m/s^2].
        title: what it is, as a picture would be headed.
        components: names of what became x, y and z, e.g. ("EW", "NS", "-DWN"); "" where the axis is at rest.
        treatment: everything that was done, in words and in order, from the reader on.
        sources: (file name, sha256) of every file read; empty for a synthetic motion.
        header_peaks: what the files state for x, y, z as recorded, before any scaling or trimming.
        steady: the full-amplitude part of a sine, None for other motions.
    """

    dt: float
    acceleration: Array
    title: str
    components: tuple[str, str, str]
    treatment: tuple[str, ...] = ()
    sources: tuple[tuple[str, str], ...] = ()
    header_peaks: tuple[HeaderPeak | None, HeaderPeak | None, HeaderPeak | None] = (None, None, None)
    steady: Steady | None = None

    def __post_init__(self) -> None:
        """Refuse what no table can follow, and lock the array.

        Raises:
            InputError: the step is not positive, the array is not (n, 3) with n >= 2, or a value is not finite.
        """
        if not (np.isfinite(self.dt) and self.dt > 0):
            raise InputError(f"{self.title}: the step must be positive, it is {self.dt!r} s")
        values = np.array(self.acceleration, dtype=np.float64)
        if values.ndim != 2 or values.shape[1] != 3 or len(values) < 2:
            raise InputError(
                f"{self.title}: a table motion is (n, 3) with at least 2 samples; this one has the shape {values.shape}"
            )
        bad = np.flatnonzero(~np.isfinite(values).all(axis=1))
        if len(bad):
            raise InputError(
                f"{self.title}: the acceleration is not finite at {len(bad)} of {len(values)} samples, "
                f"first at {bad[0] * self.dt:.4g} s; repair the file or trim the motion"
            )
        values.flags.writeable = False
        object.__setattr__(self, "acceleration", values)

    def __len__(self) -> int:
        return len(self.acceleration)

    @property
    def time(self) -> Array:
        """Times of the samples (n,), from 0 [s]."""
        return np.arange(len(self), dtype=np.float64) * self.dt

    @property
    def duration(self) -> float:
        """From the first to the last sample [s]."""
        return (len(self) - 1) * self.dt

    @property
    def peaks(self) -> Array:
        """Largest absolute acceleration of x, y, z (3,) [m/s^2]."""
        return np.abs(self.acceleration).max(axis=0)

    def to_pandas(self) -> "DataFrame":
        """Return time and acceleration as the columns of a pandas frame, SI.

        Raises:
            InputError: pandas is not installed.
        """
        return frame({"time": self.time, **{f"table_a{n}": self.acceleration[:, i] for i, n in enumerate(AXES)}})

    def _headline(self) -> str:
        return f"{self.title}, {self.duration:.4g} s in steps of {self.dt:.4g} s"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {"axis": axis, "component": name or "at rest", "peak [m/s^2]": float(peak)}
            for axis, name, peak in zip(AXES, self.components, self.peaks, strict=True)
        ]

    def about(self) -> Mapping[str, Any]:
        """Tell what it is, as JSON can hold it: for the provenance of a record."""
        return {
            "title": self.title,
            "dt_s": self.dt,
            "samples": len(self),
            "components": list(self.components),
            "peaks_m_s2": [float(peak) for peak in self.peaks],
            "treatment": list(self.treatment),
            "sources": [{"file": name, "sha256": digest} for name, digest in self.sources],
        }
