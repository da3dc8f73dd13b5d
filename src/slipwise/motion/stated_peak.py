"""Peaks that agencies state in their files, held against the data: they tell a wrong unit, step or record."""

import warnings

import numpy as np

from slipwise.errors import InputError, SlipwiseWarning
from slipwise.motion.baseline import without_baseline
from slipwise.motion.trace import Trace


def check_stated_peak(trace: Trace, unit: str | None, used: bool) -> None:
    """Hold a component, treated as its format asks for, against the peak that its header states.

    Args:
        trace: the component; one without a stated peak passes.
        unit: that the user gave, None if none.
        used: whether it drives the table.

    Raises:
        InputError: the peaks of a used component differ by more than a tenth and more than one unit of the last digit
            that is stated. A smaller difference, another time or an unused component is a warning.
    """
    stated, source = trace.header_peak, trace.source
    if stated is None:
        return
    values = without_baseline(trace.acceleration, trace.baseline)[0]
    size = np.abs(values)
    found = float(size.max(initial=0.0))
    # Some state the largest value, some the largest excursion.
    difference = min(abs(peak - abs(stated.value)) for peak in (found, abs(values.max()), abs(values.min())))
    written = f" ({stated.written})" if stated.written else ""
    words = (
        f"{source.name}: the header states a peak of {abs(stated.value):.6g} m/s^2{written} for {trace.name}, "
        f"the data reach {found:.6g} m/s^2"
    )
    # Half of the last digit, with room for the arithmetic of the agency.
    rounding = 1.01 * stated.rounding + 1e-6 * found
    if used and difference > max(0.1 * max(abs(stated.value), found), 2.0 * rounding):
        cure = (
            f"--unit {unit} contradicts it: leave it out, or correct the header"
            if unit is not None
            else "the record is damaged or its unit is not what the header says, fetch it again"
        )
        raise InputError(f"{words}; {cure}")
    if difference > max(1e-3 * abs(stated.value), 2.0 * rounding):
        warnings.warn(words if used else f"{words}; it is not used", SlipwiseWarning, stacklevel=4)
    if stated.time is None or not used:
        return
    near = round(stated.time / trace.dt)
    if size[max(near - 1, 0) : max(near + 2, 0)].max(initial=0.0) < 0.99 * found:
        warnings.warn(
            f"{source.name}: the header states the peak of {trace.name} at {stated.time:.6g} s, the data reach it at "
            f"{size.argmax() * trace.dt:.6g} s; look at the step of {trace.dt:g} s and at the start of the record",
            SlipwiseWarning,
            stacklevel=4,
        )
