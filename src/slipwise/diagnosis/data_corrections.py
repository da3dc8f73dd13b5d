"""What was wrong before any balance: dead, late, reversed and tared channels, gravity in a gauge, the wrong rig.

The rest is diagnosed. Such a fault is put right, or its channel is left out, before the first fit.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from slipwise.preparation.rig_check import WrongRig
from slipwise.preparation.sample_faults import SampleFault

#: Kind of a fault of samples -> how it is told; a zero that is far off is gravity, or the weight that cells lack.
_KINDS = {"late": "late", "turned": "reversed", "dead": "dead", "shifted": "gravity"}


@dataclass(frozen=True)
class FirstThing:
    """One of them.

    Attributes:
        kind: "dead", "late", "reversed", "tared", "gravity" or "wrong_rig".
        channels: that show it; none for the wrong rig.
        words: in a sentence.
    """

    kind: str
    channels: tuple[str, ...]
    words: str

    def as_json(self) -> dict[str, Any]:
        """Return the entry of diagnosis.json."""
        return {"kind": self.kind, "channels": list(self.channels), "words": self.words}


def first_things(faults: Sequence[SampleFault], other_rig: WrongRig | None = None) -> tuple[FirstThing, ...]:
    """Return what comes before any balance: faults of samples, and another rig than the declared one."""
    rig = (FirstThing("wrong_rig", (), other_rig.words),) if other_rig else ()
    return (*(_told(fault) for fault in faults if fault.kind in _KINDS), *rig)


def _told(fault: SampleFault) -> FirstThing:
    places = ", ".join(fault.channels)
    if fault.kind == "turned":
        return FirstThing("reversed", fault.channels, f"{places}: reversed; turned round before any fit")
    if fault.kind == "late":
        words = f"{places}: {fault.size:.3f} s behind the other channels; brought forward before any fit"
        return FirstThing("late", fault.channels, words)
    if fault.kind == "dead":
        runs = ", ".join(fault.runs)
        return FirstThing("dead", fault.channels, f"{places}: dead in {runs}; left out there")
    if fault.channels[0].startswith("pad_"):
        words = f"{places}: set to zero under the girder; a quarter of its rated weight was put back on each"
        return FirstThing("tared", fault.channels, words)
    return FirstThing("gravity", fault.channels, f"{places}: gravity is in it; taken out before any fit")
