"""What was wrong with the data before any fit, and what was done about it, in sentences.

Faults of samples are put right, or their samples are left out, and a wrong rig is replaced by the one that was shaken;
the rest is diagnosed.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from slipwise.channels import channel
from slipwise.preparation.dead_cells import EstimatedLoad
from slipwise.preparation.rig_check import WrongRig
from slipwise.preparation.sample_fault import RAILS, SampleFault
from slipwise.preparation.wrong_units import WrongUnit
from slipwise.short_repr import short_repr
from slipwise.units import convert

#: Kind of a fault of samples -> how it is told; a zero that is far off is gravity, or the weight that cells lack.
_KINDS = {
    "late": "late", "turned": "reversed", "dead": "dead", "shifted": "gravity", "scaled": "wrong_unit", "wild": "wild",
    "held": "repeated", "lost": "lost", "gap": "gap", **dict.fromkeys(RAILS, "clipped"),
}  # fmt: skip
#: Kinds that no fit could do with: they come before any balance.
BEFORE_BALANCES: tuple[str, ...] = ("dead", "late", "reversed", "tared", "gravity", "wrong_rig")


@short_repr
@dataclass(frozen=True)
class DataCorrection:
    """One of them.

    Attributes:
        kind: "dead", "late", "reversed", "tared", "gravity", "wrong_unit", "clipped", "repeated", "lost", "wild", "gap"
            or "wrong_rig".
        channels: that show it; none for a gap of all channels and for the wrong rig.
        words: in a sentence.
    """

    kind: str
    channels: tuple[str, ...]
    words: str

    def as_json(self) -> dict[str, Any]:
        """Return the entry of diagnosis.json."""
        return {"kind": self.kind, "channels": list(self.channels), "words": self.words}


def describe_corrections(
    faults: Sequence[SampleFault], estimated: Sequence[EstimatedLoad] = (), other_rig: WrongRig | None = None
) -> tuple[DataCorrection, ...]:
    """Return what was done before any fit: about faults of samples, and about another rig than the declared one.

    Args:
        faults: of samples.
        estimated: loads that stand in the place of dead cells.
        other_rig: the rig that was shaken.
    """
    rig = (DataCorrection("wrong_rig", (), f"{other_rig.words}; every fit is made on that rig"),) if other_rig else ()
    return (*(_describe(fault, estimated) for fault in faults), *rig)


def _describe(fault: SampleFault, estimated: Sequence[EstimatedLoad]) -> DataCorrection:
    places, kind = ", ".join(fault.channels), _KINDS[fault.kind]
    if fault.kind == "shifted" and fault.channels[0].startswith("pad_"):
        kind = "tared"
    return DataCorrection(kind, () if kind == "gap" else fault.channels, _words(fault, kind, places, estimated))


def _words(fault: SampleFault, kind: str, places: str, estimated: Sequence[EstimatedLoad]) -> str:
    runs, size = ", ".join(fault.runs), fault.size
    match kind:
        case "reversed":
            return f"{places}: wrong sign; reversed before any fit"
        case "late":
            return f"{places}: {size:.3f} s behind the other channels; brought forward before any fit"
        case "dead":
            instead = [one.words for one in estimated if one.channel in fault.channels]
            return f"{places}: dead in {runs}; {instead[0] if instead else 'left out there'}"
        case "tared":
            return f"{places}: set to zero under the girder; {_weight_put_back(fault)}"
        case "gravity":
            return f"{places}: gravity is in it; taken out before any fit"
        case "wrong_unit":
            return f"{WrongUnit(fault.channels, size).words(places)}; divided by that before any fit"
        case "clipped":
            return f"{places}: stands at a rail of {_shown(fault)} in {runs}; not judged there"
        case "repeated":
            return f"{places}: {size:.2%} of all samples repeat the one before; bridged, and not judged there"
        case "lost":
            return f"{places}: samples are lost in {runs}; those that repeat another are bridged, and not judged"
        case "wild":
            return f"{places}: {size:.1%} of its samples are wild; left out in {runs}"
        case _:
            return f"the logger has lost {size:.2%} of all samples; nothing is judged there"


def _shown(fault: SampleFault) -> str:
    known = channel(fault.channels[0])
    return f"{convert(fault.size, known.unit, known.shown_in):.4g} {known.shown_in}".removesuffix(" 1")


def _weight_put_back(fault: SampleFault) -> str:
    if len(fault.channels) > 1:
        return f"its rated weight was put back, {-fault.size / 1e3:.4g} kN on each"
    return f"its part of the rated weight was put back, {-fault.size / 1e3:.4g} kN"
