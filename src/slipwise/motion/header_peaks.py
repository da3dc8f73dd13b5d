"""Peaks that a free header states: of which column each is, and what unit follows from them."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.data_files.acceleration_unit import acceleration_factor
from slipwise.data_files.statements import Peak
from slipwise.motion.orientation import orientation, plain
from slipwise.motion.source_file import SourceFile, is_number
from slipwise.motion.table_motion import HeaderPeak
from slipwise.motion.trace import half_last_digit

#: Units in which accelerations are recorded.
_UNITS = ("g", "gal", "m/s^2", "mm/s^2", "mg")
#: A record whose baseline was treated after its peak was stated is off by less [1].
_NEAR = 0.01


def peak_of(peaks: Sequence[Peak], name: str, place: int, columns: int) -> Peak | None:
    """Return the stated peak of a column, None if none is stated.

    Args:
        peaks: as the header states them.
        name: of the column.
        place: of the column among those of acceleration.
        columns: how many columns of acceleration there are.
    """
    usable = [peak for peak in peaks if is_number(peak.text)]
    labelled = [peak for peak in usable if peak.label]
    for peak in labelled:
        if plain(peak.label) == plain(name):
            return peak
    direction = orientation(name)
    alike = [peak for peak in labelled if orientation(peak.label) == direction != "unknown"]
    if len(alike) == 1:
        return alike[0]
    plain_ones = [peak for peak in usable if not peak.label]
    return plain_ones[place] if len(plain_ones) == columns else None


def unit_of_peaks(
    columns: Sequence[NDArray[np.float64]], peaks: Sequence[Peak | None], source: SourceFile
) -> tuple[str, str] | None:
    """Return the unit in which the data reach the stated peaks, and the words for the record.

    Args:
        columns: the accelerations as they stand in the file, each (n,).
        peaks: of the columns, None where none is stated.
        source: the file.

    Returns:
        None where no peak has a unit, or the peaks do not single out one unit.
    """
    pairs = [(values, peak) for values, peak in zip(columns, peaks, strict=True) if peak is not None and peak.unit]
    fitting = [unit for unit in _UNITS if pairs and all(_reaches(values, peak, unit, source) for values, peak in pairs)]
    if not fitting:
        return None
    # gal and milli-g differ by 2 %: where the digits leave both, data and peak are in one unit.
    own = [unit for unit in fitting if _factor(unit, source) == _factor(pairs[0][1].unit, source)]
    unit = own[0] if own else fitting[0] if len(fitting) == 1 else None
    if unit is None:
        return None
    stated = ", ".join(f"{peak.label or 'peak'} {peak.text} {peak.unit}" for _, peak in pairs)
    return unit, f"unit {unit}: in it the data reach the peaks that the file states ({stated})"


def header_peak(peak: Peak, factor: float, source: SourceFile) -> HeaderPeak:
    """Return the stated peak in SI; its own unit where it has one, else that of the data."""
    own = _factor(peak.unit, source) if peak.unit else factor
    written = f"{peak.text} {peak.unit}".strip()
    return HeaderPeak(float(peak.text) * own, peak.time, half_last_digit(peak.text) * own, written)


def _factor(unit: str, source: SourceFile) -> float:
    return acceleration_factor(unit, f"the peak in the header of {source.name}")


def _reaches(values: NDArray[np.float64], peak: Peak, unit: str, source: SourceFile) -> bool:
    stated = header_peak(peak, 1.0, source)
    found = float(np.abs(values).max()) * _factor(unit, source)
    return abs(found - abs(stated.value)) <= max(_NEAR * found, 2.0 * stated.rounding)
