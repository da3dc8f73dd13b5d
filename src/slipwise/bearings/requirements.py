"""What the standards ask of a bearing test and a campaign does not hold, a sentence each.

Source: ASCE/SEI 7-16, sections 17.8.1 (qualification), 17.8.2 (prototype tests); EN 15129:2009, chapter 8; EN 1998-2,
Annex J; EN 1337-2:2004, Annex D.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.bearings.factors import ASCE, EN_ISOLATORS, EN_SLIDERS, CycleValues
from slipwise.campaign import Campaign
from slipwise.rig.similarity import LENGTH_SCALE

#: Strokes, and loads, that differ by more than this share are two [1].
_DIFFERS = 0.1
#: A load that deviates from its mean by no more than this share is held [1].
_HELD = 0.1
#: Cycles in a row of each stroke, strokes, cycles in a row of the longest test, and loads that ASCE/SEI 7 asks.
_EACH, _STROKES, _LONGEST, _LOADS = 3, 4, 10, 3
#: Way of the long-term friction test of EN 1337-2 [m].
_LONG_WAY = 10_000.0


@dataclass(frozen=True)
class NotHeld:
    """Something that a standard asks and the test does not hold.

    Attributes:
        standard: that asks it.
        words: one sentence.
    """

    standard: str
    words: str


def list_not_held(
    campaign: Campaign, cyclic: Mapping[str, CycleValues], way: float, load_swing: float
) -> list[NotHeld]:
    """Return what the test does not hold.

    Args:
        campaign: that was tested.
        cyclic: name of a series -> its cycles, of the sum of the pads or of the only pad.
        way: slid in all runs together [m].
        load_swing: largest deviation of the load from its mean within closed cycles, over that mean [1].
    """
    out = _of_motions(cyclic) if cyclic else []
    if load_swing > _HELD:
        words = (
            f"the vertical load is to be held in a cyclic test; it varied by up to {100.0 * load_swing:.0f} % of its "
            "mean within cycles, and energy, Q_d and K_d of single cycles vary with it"
        )
        out.append(NotHeld(f"{ASCE}, {EN_ISOLATORS}", words))
    known = any(
        name.startswith("pad_") and name.endswith("_T") for run in campaign.runs for name in run.record.channels
    )
    if not known:
        words = (
            "no temperature was recorded; friction is asked at several temperatures (lambda_f2 of EN 1998-2, Annex J)"
        )
        out.append(NotHeld(EN_ISOLATORS, words))
    out += [
        NotHeld(ASCE, "ageing and environment (lambda_ae) were not tested: they come from qualification tests, 17.8.1"),
        NotHeld(
            EN_ISOLATORS,
            "ageing (lambda_f1), contamination (lambda_f3) and cumulative travel (lambda_f4) were not tested",
        ),
        NotHeld(ASCE, "one specimen was tested; the prototype tests ask for two of each type and size"),
    ]
    if way < _LONG_WAY:
        words = f"{way:.4g} m were slid in all; the long-term friction test asks for about {_LONG_WAY / 1e3:.0f} km"
        out.append(NotHeld(EN_SLIDERS, words))
    if scale := LENGTH_SCALE.get(campaign.specimen.name):
        words = f"the pads are models at a length scale of 1:{scale:g}; quantities are those of the model"
        out.append(NotHeld("all", words))
    return out


def _of_motions(cyclic: Mapping[str, CycleValues]) -> list[NotHeld]:
    strokes = {run: _amplitude(cycles) for run, cycles in cyclic.items() if len(cycles) >= _EACH}
    loads = {run: float(np.mean([c["mean_pressure"] for c in cycles])) for run, cycles in cyclic.items()}
    most = max(len(cycles) for cycles in cyclic.values())
    out = []
    if (count := _count_different(list(strokes.values()))) < _STROKES:
        words = (
            f"{_EACH} fully reversed cycles are asked at each of {_STROKES} amplitudes (0.25, 0.5, 0.67 and 1.0 of the "
            f"maximum displacement); amplitudes with them in this test: {count}"
        )
        out.append(NotHeld(ASCE, words))
    if most < _LONGEST:
        words = f"{_LONGEST} cycles in a row are asked at 0.75 of the maximum displacement; the most here are {most}"
        out.append(NotHeld(ASCE, words))
    reached = max(_amplitude(cycles) for cycles in cyclic.values())
    words = (
        f"the cycles reach {1e3 * reached:.4g} mm; a campaign does not state the design's maximum displacement, with "
        "which this must be compared"
    )
    out.append(NotHeld(f"{ASCE}, {EN_ISOLATORS}", words))
    if np.isfinite(list(loads.values())).all() and (count := _count_different(list(loads.values()))) < _LOADS:
        words = f"the mean, the largest and the smallest vertical load are asked; loads in the cyclic motions: {count}"
        out.append(NotHeld(f"{ASCE}, {EN_ISOLATORS}", words))
    return out


def _amplitude(cycles: CycleValues) -> float:
    return 0.5 * float(np.mean([c["displacement_max"] - c["displacement_min"] for c in cycles]))


def _count_different(values: list[float]) -> int:
    """Count values, those that differ by no more than a tenth as one."""
    count, last = 0, 0.0
    for value in sorted(values):
        if not count or value > (1.0 + _DIFFERS) * last:
            count, last = count + 1, value
    return count
