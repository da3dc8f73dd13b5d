"""How a bearing changes from cycle to cycle: energy and characteristic strength over those of the first and the third.

Source: ASCE/SEI 7-16, section 17.8.4 (energy of the cycles of one test against each other); EN 15129:2009, chapter 8.3
(first and third cycle of a test).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Degradation:
    """One cycle against the first and the third one of its series; NaN where a series has no third one [1].

    Attributes:
        run: name.
        bearing: name of the pad, or "sum".
        series: number of the series in the run.
        cycle: number within the series, from 1.
        energy_first: energy over that of the first cycle.
        energy_third: over that of the third.
        strength_first: characteristic strength over that of the first cycle.
        strength_third: over that of the third.
    """

    run: str
    bearing: str
    series: int
    cycle: int
    energy_first: float
    energy_third: float
    strength_first: float
    strength_third: float


def follow_degradation(run: str, bearing: str, series: int, cycles: Sequence[Mapping[str, float]]) -> list[Degradation]:
    """Return how the cycles of a series compare with its first and third; nothing of a single cycle.

    Args:
        run: name.
        bearing: name.
        series: its number.
        cycles: measured quantities of each closed cycle, in order.
    """
    if len(cycles) < 2:
        return []
    ratios = {
        key: [
            (_over(c[key], cycles[0][key]), _over(c[key], cycles[2][key] if len(cycles) > 2 else 0.0)) for c in cycles
        ]
        for key in ("energy", "characteristic_strength")
    }
    both = zip(ratios["energy"], ratios["characteristic_strength"], strict=True)
    return [
        Degradation(run, bearing, series, i, *energy, *strength) for i, (energy, strength) in enumerate(both, start=1)
    ]


def _over(value: float, reference: float) -> float:
    return value / reference if reference else float("nan")
