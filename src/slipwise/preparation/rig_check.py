"""Whether the rig that a campaign declares is the one that was shaken: what a fit finds, held against every rig."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.estimation.base_fit import BaseFit
from slipwise.rig import load_specimen
from slipwise.rig.files import RIGS
from slipwise.rig.specimen import Specimen

#: What is held against every rig: only balances tell it, and rigs differ by it.
HELD_AGAINST: tuple[str, ...] = ("centre_height", "buffer_stiffness")
#: A rig's numbers may be off by this share, and by this one those of another rig that fits [1]: chosen by judgement,
#: the two rigs of the paper differ by factors of 2 and 1.5.
_OFF, _FITS = 0.35, 0.15


@dataclass(frozen=True)
class WrongRig:
    """Another rig than the declared one.

    Attributes:
        declared: name of the rig in campaign.toml.
        fitting: the rig whose numbers fit.
        words: in a sentence.
    """

    declared: str
    fitting: Specimen
    words: str


def wrong_rig(base: BaseFit) -> WrongRig | None:
    """Return whether the numbers that a fit found are those of another rig than the declared one; None where not.

    Args:
        base: the base fit, on the balances of a girder.
    """
    values, declared = base.solution.values, base.model.specimen
    if not base.objective.balanced or not declared.buffer_stiffness:
        return None
    found = {name: values[f"rig.{name}"] for name in HELD_AGAINST}
    off = _distance(found, declared)
    if off < np.log1p(_OFF):
        return None
    others = [load_specimen(name) for name in RIGS if name != declared.name]
    others = [o for o in others if o.free and o.pads == declared.pads and len(o.buffer_stiffness) > 0]
    best = min(others, key=lambda other: _distance(found, other), default=None)
    if best is None or _distance(found, best) > min(np.log1p(_FITS), 0.5 * off):
        return None
    numbers = _told(found["centre_height"], found["buffer_stiffness"] / len(declared.buffer_stiffness))
    rated = _told(declared.centre_height, declared.buffer_stiffness[0])
    words = f"campaign.toml declares {declared.name} ({rated}), but these numbers fit {best.name}: {numbers}"
    return WrongRig(declared.name, best, words)


def _distance(found: Mapping[str, float], rated: Specimen) -> float:
    """Return the largest logarithm of a ratio of what was found to what is rated [1]."""
    numbers = {"centre_height": rated.centre_height, "buffer_stiffness": sum(rated.buffer_stiffness)}
    return max(abs(float(np.log(found[name] / number))) for name, number in numbers.items())


def _told(height: float, stiffness: float) -> str:
    return f"height {height:.2f} m, buffers {stiffness / 1e6:.2f} kN/mm"
