"""The suspects: every fault that a gauge can have, on every channel or card that can have it.

A suspect's signature is not written down: it is what the relations make of a record that the fault has distorted, by
the `gauge` of the effect that the fault is.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from slipwise.campaign.scales import pad_load_scale
from slipwise.channels import channel, pads_in, part_of
from slipwise.effects import Effect, catalogue
from slipwise.effects._fault import GaugeFault
from slipwise.effects._gauges import span
from slipwise.preparation.gauge_groups import find_floors_of_gauges, find_places_of_gauges
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.rig.load_basis import RIGID_MODES

#: The table's vertical motion is tied to the girder only through the pads' springs: its faults must be larger [1].
_LOOSE = 3.0
#: Units of sizes that matter the more the less a pad carries.
_WITH_LOAD = ("N", "kg")


@dataclass(frozen=True)
class Suspect:
    """One fault on one channel or card.

    Attributes:
        effect: that the fault is.
        label: the channel, or the card as a pattern, "pad_*_Fx"; with the variant in words where there are several.
        target: of the effect.
        channels: that it changes.
        unit: of its size, SI.
        step: small size at which its signature is taken.
        least: size from which it is reported.
        values: (size) -> parameters of the effect.
    """

    effect: Effect
    label: str
    target: str
    channels: tuple[str, ...]
    unit: str
    step: float
    least: float
    values: Callable[[float], dict[str, float]]

    @property
    def fault(self) -> GaugeFault:
        """What the effect declares of itself."""
        return declared(self.effect)

    @property
    def one_sided(self) -> bool:
        """Whether its size cannot be below zero."""
        return self.effect.parameters[0].low >= 0.0

    @property
    def key(self) -> tuple[str, str]:
        """Name of fault and place."""
        return self.effect.name, self.label

    def distort(self, record: Record, size: float) -> Record:
        """Return the record with the fault."""
        return self.effect.hooks["gauge"](record, self.target, **self.values(size))

    def correct(self, record: Record, size: float) -> Record:
        """Return the record without the fault; where it has no inverse, as far as noise allows."""
        hooks = self.effect.hooks
        return hooks["undo" if "undo" in hooks else "sharpen"](record, self.target, **self.values(size))


def declared(effect: Effect) -> GaugeFault:
    """Return what an effect declares of itself as a gauge's fault."""
    assert effect.fault is not None, f"{effect.name} is no fault of a gauge"
    return effect.fault


def effect_of(kind: str) -> Effect:
    """Return the effect of the catalogue that a fault of samples is."""
    return next(e for e in catalogue().values() if e.fault and kind in e.fault.samples)


def suspects(record: Record, specimen: Specimen, effects: Iterable[Effect]) -> list[Suspect]:
    """Return all suspects for the channels of a record.

    Args:
        record: whose channels count.
        specimen: whose weight says which force or mass matters.
        effects: those that are a fault of a gauge, of some least size and with an inverse, are looked for.
    """
    faults = [e for e in effects if e.fault and e.fault.least and e.hooks.keys() & {"undo", "sharpen"}]
    load = pad_load_scale(specimen)
    return [suspect for effect in faults for suspect in _of_effect(effect, record, load)]


def _of_effect(effect: Effect, record: Record, load: float) -> Iterator[Suspect]:
    pads = pads_in(record.channels)
    places = {**find_places_of_gauges(effect, record), **find_floors_of_gauges(effect, record)}
    for place, channels in places.items():
        if "*" in place and len(channels) < max(len(pads), RIGID_MODES):
            continue  # no balance holds part of a card
        if effect.gauges.sits == "pads":
            cells = [f"pad_{pad}_{kind}" for pad in pads for kind in ("N", "Fx")]
            if record.has_all(*cells, "table_ax", "table_az"):
                every = tuple(
                    n for n in record.channels if part_of(n)[0] == "pad" and n.rpartition("_")[2] in ("N", "Fx", "Fy")
                )
                yield from _forms(effect, "all", "", every, load)
        elif not effect.gauges.reads:
            yield from _forms(effect, place, place, channels, load)
        for ending, other in effect.gauges.reads.items():
            # with a cell less no balance says whose reading it is
            cells = [f"pad_{pad}{kind}" for pad in pads for kind in (ending, other)]
            if place.endswith(ending) and len(pads) >= RIGID_MODES and record.has_all(*cells):
                yield from _forms(effect, place, f"{place} from {other[1:]}", channels, load)


def _forms(effect: Effect, target: str, words: str, channels: tuple[str, ...], load: float) -> Iterator[Suspect]:
    """Yield a fault in each of its forms on one place; `load` is that of a pad over the reference rig's [1]."""
    fault = declared(effect)
    own = fault.unit.startswith("channel")
    per = span(channels[0]) if own else 1.0
    unit = fault.unit.replace("channel", channel(channels[0]).unit) if own else fault.unit
    factor = load if unit.split("/")[0] in _WITH_LOAD else 1.0
    least = factor * fault.least_on(channels[0])
    for form, shape in fault.forms.items():
        yield Suspect(
            effect,
            words + form,
            target,
            channels,
            unit,
            least if fault.step is None else factor * fault.step,
            least * (_LOOSE if channels == ("table_az",) and not own else 1.0),
            _values(effect.parameters[0].name, per, shape),
        )


def _values(name: str, per: float, shape: Mapping[str, float]) -> Callable[[float], dict[str, float]]:
    return lambda size: {name: size / per, **shape}
