"""The gauges on which one fault may act together: a channel of its own, or a card of cells."""

from collections.abc import Iterable

from slipwise.channels import pads_in, part_of
from slipwise.effects import Effect, moved_channels
from slipwise.record import Record

#: Channels of one gauge each, by their beginnings.
_SINGLE = ("slip_x", "slip_y", "girder_a", "table_a", "yaw")
#: What the pads' cells measure; those of one kind are a card.
_CELLS = ("N", "Fx", "Fy")


def group_gauges(record: Record) -> dict[str, tuple[str, ...]]:
    """Return the channels, and the cards as patterns, "pad_*_Fx", that a fault may touch together."""
    single = [n for n in record.channels if n.startswith(_SINGLE)]
    single += [n for n in record.channels if part_of(n)[0] == "pad" and n.rpartition("_")[2] in _CELLS]
    groups: dict[str, tuple[str, ...]] = {name: (name,) for name in single}
    for kind in _CELLS:
        names = tuple(name for pad in pads_in(record.channels) if (name := f"pad_{pad}_{kind}") in record)
        if len(names) > 1:
            groups[f"pad_*_{kind}"] = names
    return groups


def find_places_of_gauges(effect: Effect, record: Record) -> dict[str, tuple[str, ...]]:
    """Return the groups on which a gauge's fault may sit: what it can move, alone or on a card as it declares.

    Zeros do not move alike, a clock belongs to a card, and a reading of another gauge needs that one recorded. What
    sits on all pads' cells at once has one place, that of the loads.

    Args:
        effect: of port "gauge".
        record: whose channels count.
    """
    if effect.gauges.sits == "pads":
        loads = tuple(name for pad in pads_in(record.channels) if (name := f"pad_{pad}_N") in record)
        return {"pad_*_N": loads} if loads else {}
    moved = moved_channels(effect, record.channels)
    return {
        place: channels
        for place, channels in group_gauges(record).items()
        if moved.issuperset(channels) and _sits(effect, place, channels) and record.has_all(*_read(effect, channels))
    }


def find_floors_of_gauges(effect: Effect, record: Record) -> dict[str, tuple[str, ...]]:
    """Return the gauges of floors on which a fault may sit: a floor's displacement and acceleration, where it has both.

    Audits look for them; fits hold nothing against a floor's displacement.
    """
    floors = [n for n in record.channels if n.startswith("storey_") and n[-2] == "d"]
    both = [name for floor in floors for name in (floor, f"{floor[:-2]}a{floor[-1]}") if name in record]
    moved = moved_channels(effect, both)
    return {
        name: (name,) for name in both if name in moved and _sits(effect, name, (name,)) and not effect.gauges.reads
    }


def _sits(effect: Effect, place: str, channels: tuple[str, ...]) -> bool:
    if effect.gauges.sits == "alone":
        return len(channels) == 1
    return effect.gauges.sits != "card" or len(channels) > 1 or not place.startswith("pad_")


def _read(effect: Effect, channels: Iterable[str]) -> list[str]:
    """Return the other channels of the same cells that a fault reads."""
    pairs = [(name, ending, other) for name in channels for ending, other in effect.gauges.reads.items()]
    return [name.removesuffix(ending) + other for name, ending, other in pairs if name.endswith(ending)]
