"""Which acceleration is the table's, and in which order the levels of a structure stand above it: told by what drives.

What a storey's columns (of the lowest level: the isolators) carry is the inertia of all that stands above them, and it
follows the drift between their ends:

    sum of m_i a_i over the levels from i up = -(k d + c d'),      d'' = a_i - a_below,     k, c >= 0

The table is the cause: nothing above it makes its motion, and each level answers the one below. Of all orders that one
counts in which the least of the inertia is left unexplained, summed over the storeys; masses are taken to be equal
where none are given. All orders are judged at once: what is left of a storey depends on which levels stand above it,
not on how they stand (Held and Karp, J. SIAM 10, 1962).

Source: Chopra, Dynamics of Structures, chapter 9: equations of motion of a shear building.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.campaign.level_spectra import LevelSpectra

#: Levels, the table included, that are put in order at most: the work doubles with each.
MOST_LEVELS = 12
#: A storey holds where less than this is left of what it carries, the isolators where less than this is [1]: friction
#: leaves most, yielding some. A storey that is damped by more than this share of critical is none.
STOREY_LEFT, ISOLATORS_LEFT, _OVERDAMPED = 0.4, 0.95, 0.5
#: A signal is turned round where that takes so much from the sum of what is left [1].
_TURNED = 0.3


@dataclass(frozen=True)
class StoreyLink:
    """A level against the one below it.

    Attributes:
        left: share of the inertia above that stiffness and damping leave [1].
        stiffness: over the mean mass of a level [1/s^2].
        damping: likewise [1/s].
        above: mass that it carries, likewise [1].
    """

    left: float
    stiffness: float
    damping: float
    above: float

    @property
    def frequency(self) -> float:
        """Natural frequency of all above as one mass [Hz]."""
        return float(np.sqrt(self.stiffness / self.above)) / (2.0 * np.pi)

    @property
    def critical(self) -> float:
        """Damping as a share of critical of all above as one mass [1]; 0 without stiffness."""
        root = 2.0 * float(np.sqrt(self.stiffness * self.above))
        return self.damping / root if root > 0.0 else 0.0


@dataclass(frozen=True)
class LevelOrder:
    """An order of levels.

    Attributes:
        levels: numbers of the signals, the table's first, then from below.
        signs: +1 or -1 of each signal, in the order of the signals: -1 where it stands turned round.
        links: of each level above the table with the one below, from below.
        margin: by how much more the nearest other order leaves [1].
    """

    levels: tuple[int, ...]
    signs: tuple[int, ...]
    links: tuple[StoreyLink, ...]
    margin: float

    @property
    def left(self) -> float:
        """Sum of what the links leave [1]."""
        return sum(link.left for link in self.links)

    @property
    def holds(self) -> bool:
        """Whether each level answers the one below: else the signals are not those of one structure."""
        return links_hold(self.links)


def links_hold(links: Sequence[StoreyLink]) -> bool:
    """Return whether each level answers the one below as a storey on isolators does; the isolators' link first."""
    isolators, *storeys = links
    return isolators.left < ISOLATORS_LEFT and all(
        storey.left < STOREY_LEFT and storey.critical < _OVERDAMPED for storey in storeys
    )


def find_order(spectra: LevelSpectra, *, turn: bool = True) -> LevelOrder:
    """Return the order of levels that leaves least, and which signals are turned round.

    Args:
        spectra: of two signals or more, at most `MOST_LEVELS`.
        turn: whether signals may be turned round.
    """
    count = len(spectra.values)
    signs = (1,) * count
    order = _best(_Products.of(spectra))
    for _ in range(count if turn else 0):
        tried = [_turned(signs, i) for i in range(count)]
        found = [_best(_Products.of(spectra.signed(one))) for one in tried]
        best = min(range(count), key=lambda i: found[i][0])
        if found[best][0] > order[0] - _TURNED:
            break
        signs, order = tried[best], found[best]
    products = _Products.of(spectra.signed(signs))
    levels = order[1]
    if sum(signs) < 0 or (sum(signs) == 0 and signs[levels[0]] < 0):
        signs = tuple(-sign for sign in signs)  # all turned round together are none
    nearest = min((_left(products, other) for other in _neighbours(levels)), default=float("inf"))
    links = tuple(_links(products, levels, ()))
    return LevelOrder(levels, signs, links, nearest - sum(link.left for link in links))


def judge_order(spectra: LevelSpectra, levels: Sequence[int], masses: Sequence[float] = ()) -> tuple[StoreyLink, ...]:
    """Return how each level answers the one below, from below.

    Args:
        spectra: of the signals.
        levels: numbers of the signals, the table's first.
        masses: of the levels above the table, from below, in any one unit; equal if not given.
    """
    return tuple(_links(_Products.of(spectra), levels, masses))


@dataclass(frozen=True, eq=False)
class _Products:
    """Inner products of the signals: what every storey of every order is made of, (n, n) each."""

    whole: Array
    drift: Array
    rate: Array
    drifts: Array
    rates: Array

    @classmethod
    def of(cls, spectra: LevelSpectra) -> "_Products":
        values = spectra.values

        def product(one: NDArray[np.complex128], other: NDArray[np.complex128]) -> Array:
            return np.asarray(np.real(one.conj() @ other.T), dtype=np.float64)

        # of a drift d'' = a the spring carries -k d = k a / w^2, the damper -c d' = i c a / w
        drift = np.asarray(values / spectra.turning**2, dtype=np.complex128)
        rate = np.asarray(1j * values / spectra.turning, dtype=np.complex128)
        return cls(
            product(values, values),
            product(drift, values),
            product(rate, values),
            product(drift, drift),
            product(rate, rate),
        )

    def link(self, above: Sequence[int], upper: int, lower: int, masses: Sequence[float]) -> StoreyLink:
        """Return how the inertia of levels `above`, of such masses, follows the drift from `lower` to `upper`.

        Drift and rate are at right angles in every frequency: each is fitted by itself.
        """
        mass = np.array(masses)
        levels = list(above)
        inertia = float(mass @ self.whole[np.ix_(levels, levels)] @ mass)
        parts = []
        for along, own in ((self.drift, self.drifts), (self.rate, self.rates)):
            size = float(own[upper, upper] + own[lower, lower] - 2.0 * own[upper, lower])
            work = float((along[upper, levels] - along[lower, levels]) @ mass)
            parts.append((max(work, 0.0) / max(size, 1e-300), max(work, 0.0) ** 2 / max(size, 1e-300)))
        (stiffness, by_spring), (damping, by_damper) = parts
        left = 1.0 - (by_spring + by_damper) / max(inertia, 1e-300)
        return StoreyLink(max(left, 0.0), stiffness, damping, float(mass.sum()))


def _best(products: _Products) -> tuple[float, tuple[int, ...]]:
    """Return what the best order leaves, and that order: built from the top down, each set of levels above once."""
    every = frozenset(range(len(products.whole)))
    found = {(frozenset([top]), top): (0.0, (top,)) for top in every}
    for _ in range(len(every) - 1):
        longer: dict[tuple[frozenset[int], int], tuple[float, tuple[int, ...]]] = {}
        for (above, upper), (left, path) in found.items():
            levels = sorted(above)
            for lower in every - above:
                total = left + products.link(levels, upper, lower, [1.0] * len(levels)).left
                key = (above | {lower}, lower)
                if key not in longer or total < longer[key][0]:
                    longer[key] = (total, (*path, lower))
        found = longer
    left, path = min(found.values(), key=lambda one: one[0])
    return left, path[::-1]


def _links(products: _Products, levels: Sequence[int], masses: Sequence[float]) -> Iterator[StoreyLink]:
    scaled = np.array(masses) / np.mean(masses) if len(masses) else np.ones(len(levels) - 1)
    for i in range(1, len(levels)):
        yield products.link(levels[i:], levels[i], levels[i - 1], list(scaled[i - 1 :]))


def _left(products: _Products, levels: Sequence[int]) -> float:
    return sum(link.left for link in _links(products, levels, ()))


def _neighbours(levels: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """Yield the orders in which two levels have changed places."""
    for i, j in combinations(range(len(levels)), 2):
        other = list(levels)
        other[i], other[j] = other[j], other[i]
        yield tuple(other)


def _turned(signs: tuple[int, ...], which: int) -> tuple[int, ...]:
    return tuple(-sign if i == which else sign for i, sign in enumerate(signs))
