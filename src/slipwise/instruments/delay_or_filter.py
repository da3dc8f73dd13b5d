"""A filter or a delay? One rule for the audit and for the diagnosis.

A filter of a channel's own whose corner lies above what the logger let through took nothing away that could be missed:
what is left of it is its lag, and that is a delay by its name, however little better the filter fits.
"""

from collections.abc import Mapping

from slipwise.effects import Effect
from slipwise.signals.filters import LowPass


def passed(lowpass: LowPass | None, dt: float) -> float:
    """Return the highest frequency that reached the record [Hz]: the logger's corner, or half the sampling rate."""
    return lowpass.frequency if lowpass else 0.5 / dt


def is_delay(effect: Effect, values: Mapping[str, float], highest: float) -> bool:
    """Return whether an effect is a filter that takes nothing of what is slower than the highest frequency [Hz]."""
    return "corner" in effect.hooks and effect.hooks["corner"](**values) > highest
