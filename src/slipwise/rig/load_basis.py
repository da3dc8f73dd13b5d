"""Heave, pitch, roll and warp as patterns over the pads, from where the pads stand and how stiff they are."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from slipwise.arrays import Array
from slipwise.rig.places import MOST_PADS, Place
from slipwise.rig.specimen import Specimen

#: Patterns and places that differ by less are the same [1].
_SAME = 1e-9
#: Loads at rest that pads of unlike heights make, below this share of the weight, are none [1].
_WARPED = 1e-6
#: Loads of a rigid girder have so many degrees of freedom, heave, pitch and roll: fewer pads carry none.
RIGID_MODES = 3
#: What the warps are called: of n pads the first n - 3.
WARPS: tuple[str, ...] = ("warp", *(f"warp_{k}" for k in range(2, MOST_PADS - 2)))


@dataclass(frozen=True)
class LoadBasis:
    """What each mode is made of: mode = row @ loads.

    Attributes:
        rigid: (3, n) heave: 1; pitch: x_i / half_x; roll: y_i / half_y, from the middle of the pads.
        warp: (n - 3, n) what a rigid girder on these pads cannot load; the first is the one nearest to x_i y_i, that of
            a rectangle's diagonals. Each has 1 as its largest entry.
        middle: (x, y) of the pads, weighed by stiffness [m].
        half: (x, y) largest distance of a pad from it [m].
    """

    rigid: Array
    warp: Array
    middle: tuple[float, float]
    half: tuple[float, float]

    @property
    def inverse(self) -> Array:
        """Loads over modes: loads = modes (n_times, n) @ inverse (n, n); of a lone pad (3, 1), its modes being one."""
        modes = np.concatenate([self.rigid, self.warp])
        turned = np.linalg.inv(modes) if len(modes) == modes.shape[1] else np.linalg.pinv(modes)
        return np.asarray(turned.T, dtype=np.float64)

    @property
    def sides(self) -> Array:
        """Place of each pad in units of `half`, (n, 2) in -1 to 1."""
        return self.rigid[1:].T


def basis_of(specimen: Specimen) -> LoadBasis:
    """Return the patterns of a specimen's pads."""
    return load_basis(specimen.pad_places, specimen.springs)


def has_corners(specimen: Specimen) -> bool:
    """Return whether four pads stand one at each corner: what differs between them is along, across or diagonal."""
    sides = basis_of(specimen).sides
    return len(sides) == 4 and len({(x > 0.0, y > 0.0) for x, y in sides if x != 0.0 and y != 0.0}) == 4


def warps(specimen: Specimen) -> tuple[str, ...]:
    """Return the names of a specimen's warps: none of three pads, "warp" of four, "warp" and "warp_2" of five ..."""
    return WARPS[: max(len(specimen.pads) - 3, 0)]


def by_warp(specimen: Specimen, loads: Array) -> dict[str, Array]:
    """Return what loads (..., n) of the pads are in each warp, name -> (...)."""
    return dict(zip(warps(specimen), basis_of(specimen).warp @ np.moveaxis(loads, -1, 0), strict=True))


def is_uneven(specimen: Specimen) -> bool:
    """Return whether pads are stated to stand at heights that no plane goes through: they warp the loads at rest."""
    loads = np.array(specimen.springs) * specimen.seating
    return any(abs(load) > _WARPED * specimen.weight for load in by_warp(specimen, loads).values())


def buffer_sides(specimen: Specimen) -> tuple[float, ...]:
    """Return on which side each buffer stands, -1 to 1: across from their middle, or along where all stand in one line.

    Of one buffer, or where all stand in one place, it is 1.
    """
    off = np.array(specimen.buffer_places).reshape(-1, 2)
    off = off - off.mean(axis=0) if len(off) else off
    for axis in (1, 0):
        if len(off) and (half := np.abs(off[:, axis]).max()) > _SAME:
            return tuple(float(side) for side in off[:, axis] / half)
    return (1.0,) * len(off)


def buffers_off_centre(specimen: Specimen) -> tuple[float, float]:
    """Return how far the buffers' middle lies from the centre of gravity (x, y) [m]: that of those along y, along x.

    A force along x at y turns the girder, and so moves it across where those along y stand off x.
    """
    along = sum(b.stiffness_x for b in specimen.buffers)
    across = sum(b.stiffness_y for b in specimen.buffers)
    x = sum(b.stiffness_y * (b.x - specimen.centre_x) for b in specimen.buffers) / across if across else 0.0
    y = sum(b.stiffness_x * (b.y - specimen.centre_y) for b in specimen.buffers) / along if along else 0.0
    return x, y


def end_pairs(specimen: Specimen) -> tuple[tuple[str, str], ...]:
    """Return pads that stand beside each other across the girder: same x, neighbours along y, the one at +y first."""
    ends: dict[float, list[Place]] = {}
    for place in specimen.places:
        same = next((x for x in ends if abs(x - place.x) <= _SAME), place.x)
        ends.setdefault(same, []).append(place)
    rows = [sorted(row, key=lambda place: -place.y) for row in ends.values()]
    return tuple((one.name, other.name) for row in rows for one, other in zip(row[:-1], row[1:], strict=True))


def load_basis(places: Sequence[tuple[float, float]], springs: Sequence[float] | None = None) -> LoadBasis:
    """Return the patterns of pads.

    Args:
        places: (n, 2) of three pads or more that do not stand on one line [m].
        springs: (n,) vertical stiffness of each; the same when not given [N/m].
    """
    count = len(places)
    return _made(tuple((float(x), float(y)) for x, y in places), tuple(springs or (1.0,) * count))


@lru_cache(maxsize=64)
def _made(places: tuple[tuple[float, float], ...], springs: tuple[float, ...]) -> LoadBasis:
    weights = np.array(springs) / sum(springs)
    middle = weights @ np.array(places)
    off = np.array(places) - middle
    off[np.abs(off) < _SAME * np.abs(off).max()] = 0.0
    half = np.abs(off).max(axis=0)
    # A lone pad, or pads that stand in one line, have no sides along it: all stand on the positive one.
    sides = np.where(half > 0.0, off / np.where(half > 0.0, half, 1.0), 1.0)
    rigid = np.stack([np.ones(len(places)), sides[:, 0], sides[:, 1]])
    return LoadBasis(
        rigid, _warp(rigid, weights), (float(middle[0]), float(middle[1])), (float(half[0]), float(half[1]))
    )


def _warp(rigid: Array, weights: Array) -> Array:
    """Return the patterns w with w @ loads = 0 for every load of a rigid girder, k_i (a + b x_i + c y_i)."""
    count = rigid.shape[1]
    if count <= 3:
        return np.empty((0, count))
    carried = (rigid * weights).T
    free = np.linalg.svd(carried)[0][:, 3:]
    twist = free @ (free.T @ (rigid[1] * rigid[2]))
    if np.abs(twist).max() > _SAME:
        aside = free - np.outer(twist, twist @ free) / (twist @ twist)
        free = np.column_stack([twist, np.linalg.svd(aside)[0][:, : count - 4]])
    rows = free.T / np.abs(free).max(axis=0)[:, None]
    return np.round(rows, 12)
