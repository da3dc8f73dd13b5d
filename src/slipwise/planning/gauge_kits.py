"""Gauges that may be bolted on: one by one, or together where one alone is of no use; and sets of them for a budget."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from slipwise.errors import InputError
from slipwise.planning.structure import Structure
from slipwise.rig import Specimen, storey_names
from slipwise.short_repr import short_repr

#: Kits that are tried together where no single one separates a pair.
_TOGETHER = 2


@short_repr
@dataclass(frozen=True)
class Kit:
    """Gauges that are added together.

    Attributes:
        words: what they are.
        channels: that they record.
    """

    words: str
    channels: tuple[str, ...]


@short_repr
@dataclass(frozen=True)
class Remedy:
    """What would separate two kinds of faults.

    Attributes:
        first: a kind of faults.
        second: another, or the same on another pad.
        kits: that would separate them, the fewest channels; none where no gauge does.
    """

    first: str
    second: str
    kits: tuple[Kit, ...]

    @property
    def channels(self) -> tuple[str, ...]:
        """Channels of the kits."""
        return tuple(dict.fromkeys(c for kit in self.kits for c in kit.channels))


def list_kits(specimen: Specimen) -> tuple[Kit, ...]:
    """Return the gauges that the balances of a rig use."""
    loads, along, across = (tuple(f"pad_{pad}_{kind}" for pad in specimen.pads) for kind in ("N", "Fx", "Fy"))
    each = "of every pad" if len(specimen.pads) > 1 else "of the pad"
    cells = (Kit(f"cells for the load {each}", loads), Kit(f"cells for the friction {each}", along))
    slip = Kit("a slip gauge", ("slip_x",))
    if not specimen.free:
        return (slip, *cells)
    storeys = tuple(f"{storey}_ax" for storey in storey_names(specimen.storeys))
    return (
        slip,
        *cells,
        Kit("an accelerometer along x on the girder", ("girder_ax",)),
        Kit("an accelerometer along x on the table", ("table_ax",)),
        Kit("a vertical accelerometer at the girder's centre of gravity", ("girder_az",)),
        Kit("two vertical accelerometers at the girder's ends", ("girder_az_1", "girder_az_2")),
        Kit("a vertical accelerometer on the table", ("table_az",)),
        Kit("a gauge of the girder's yaw", ("yaw",)),
        *((Kit("accelerometers along x on every storey", storeys),) if storeys else ()),
        Kit("gauges across: slip, accelerations and friction along y", ("slip_y", "girder_ay", "table_ay", *across)),
    )


def list_remedies(planned: Structure, kits: Sequence[Kit], judge: Callable[[Sequence[str]], Structure]) -> list[Remedy]:
    """Return for each pair that planned gauges do not tell apart what would, and likewise for what they do not show.

    Args:
        planned: what the planned gauges show.
        kits: that may be added.
        judge: what some channels show.
    """
    missing = [kit for kit in kits if not set(kit.channels) <= set(planned.channels)]
    tried: list[tuple[int, tuple[Kit, ...], Structure]] = []
    for count in range(1, _TOGETHER + 1):
        for some in combinations(missing, count):
            more = {c for kit in some for c in kit.channels} - set(planned.channels)
            tried.append((len(more), some, judge([*planned.channels, *sorted(more)])))
    tried.sort(key=lambda t: (t[0], len(t[1])))
    out = []
    for kind in planned.unseen:
        some = next((of for _, of, then in tried if kind not in then.unseen), ())
        out.append(Remedy(kind, "", some))
    for pair in planned.confused:
        some = next((of for _, of, then in tried if pair not in then.confused and not set(pair) & set(then.unseen)), ())
        out.append(Remedy(*pair, some))
    return out


def keep_judged(specimen: Specimen, channels: Sequence[str]) -> tuple[str, ...]:
    """Return the channels that a diagnosis looks at: with cells on some pads only, these pads alone.

    Balances of a girder ask for a quantity on every pad, or on none: then it follows from inertia.
    """
    kinds = [[f"pad_{pad}_{kind}" for pad in specimen.pads] for kind in ("N", "Fx")]
    if not specimen.free or all(set(cells) <= set(channels) or not set(cells) & set(channels) for cells in kinds):
        return tuple(channels)
    whole = [pair for pair in zip(*kinds, strict=True) if set(pair) <= set(channels)]
    return tuple(c for c in channels if c == "slip_x" or any(c in pair for pair in whole))


def list_sets(specimen: Specimen, kits: Sequence[Kit], budget: int) -> Iterator[tuple[str, ...]]:
    """Yield sets of channels within a budget, with what every fit needs: slip, and load and friction of a pad.

    Balances of a girder ask for load and friction of every pad: they come for one pad alone, or for all together.

    Raises:
        InputError: the budget is less than that.
    """
    loads, along = ([f"pad_{pad}_{kind}" for pad in specimen.pads] for kind in ("N", "Fx"))
    least = ("slip_x", loads[0], along[0])
    if budget < len(least):
        raise InputError(
            f"a budget of {budget} channels is less than every fit needs: {', '.join(least)}; give {len(least)} or more"
        )
    rest = [kit for kit in kits if not {"slip_x", loads[0], along[0]} & set(kit.channels)]
    for cells in (least, ("slip_x", *loads, *along)):
        for count in range(len(rest) + 1):
            for some in combinations(rest, count):
                channels = tuple(dict.fromkeys([*cells, *(c for kit in some for c in kit.channels)]))
                twice = {"girder_az", "girder_az_1"} <= set(channels)
                if len(channels) <= budget and not twice:
                    yield channels


def choose_set(sets: Iterator[tuple[str, ...]], judge: Callable[[Sequence[str]], Structure]) -> Structure:
    """Return the set that shows and tells apart most; of several the one of the fewest channels."""
    return max((judge(channels) for channels in sets), key=lambda s: (s.score, -len(s.channels)))
