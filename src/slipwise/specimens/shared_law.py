"""One posterior over several campaigns: what all specimens have, and what one has alone.

    size of an effect in specimen i = a_i (b + v) + o_i + u_i

b is one size for all, zero but for a few effects; o_i one that specimen i has alone; v and u_i are trifles, which all
have and each has, half of the variance that a trifle has in one campaign each. a_i is what one limit of all campaigns
is in limits of campaign i. Base numbers are each campaign's own. Given the shared sizes campaigns are independent, so
that each is integrated over its numbers and trifles by itself, and what remains is a sum over campaigns: a trifle that
all of them show alike adds up, and one that they do not show alike is a property of one specimen or none.

Prior: an effect that matters is as likely a property of the make as of one specimen. Trifles that are shared do not
average out, so that a small error which every campaign repeats is no evidence for an effect beyond its own trifle.

Sources: `evidence.posterior`; Higgins, Thompson, Spiegelhalter (2009), JRSS A 172 (random effects over studies).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.evidence.posterior import sample_large_sizes
from slipwise.evidence.prior import list_trifles
from slipwise.selection.columns import CandidateColumn
from slipwise.short_repr import short_repr
from slipwise.specimens.shared_columns import SharedColumns
from slipwise.specimens.specimen import SpecimenColumn, SpecimenStatistics, is_of_model

#: A term that is likelier than this to be no trifle in one campaign alone may be a property of its specimen [1].
_OWN = 0.01
#: Share of a trifle's variance that all specimens have alike [1].
_ALIKE = 0.5


@dataclass(frozen=True)
class OwnColumn:
    """A column of what one specimen has alone.

    Attributes:
        specimen: place of the campaign.
        place: of the column among those of the campaign.
    """

    specimen: int
    place: int


@short_repr
@dataclass(frozen=True)
class SharedLaw:
    """A posterior over several campaigns.

    Attributes:
        shared: columns of what all may have.
        own: columns of what one may have alone.
        sizes: (n, S + O) drawn of what is more than a trifle: of the shared, then of the own columns [limits].
        trifles: (S,) mean of what all have alike beside that [limits].
        precisions: for each campaign (K, K) of sizes, its numbers and own trifles integrated out.
        pulls: for each campaign (K,).
    """

    shared: SharedColumns
    own: tuple[OwnColumn, ...]
    sizes: Array
    trifles: Array
    precisions: tuple[Array, ...]
    pulls: tuple[Array, ...]

    def sizes_of(self, specimen: int) -> Array:
        """Return the mean sizes (K,) of all columns of a campaign [limits]."""
        mean, count = self.sizes.mean(axis=0), len(self.shared.columns)
        out = self.shared.parts[specimen] @ mean[:count]
        for o, size in zip(self.own, mean[count:], strict=True):
            if o.specimen == specimen:
                out[o.place] += size
        return out


def fit_shared_law(specimens: Sequence[SpecimenStatistics], shared: SharedColumns) -> SharedLaw:
    """Sample what specimens have together and alone.

    Args:
        specimens: the campaigns.
        shared: of `list_shared_columns`.
    """
    count = len(shared.columns)
    own = [
        OwnColumn(i, k)
        for i, s in enumerate(specimens)
        for k, c in enumerate(s.columns)
        if is_of_model(c) or s.chance.get(c.label, 0.0) >= _OWN
    ]
    total = count + len(own)
    precision, pulled = np.zeros((total, total)), np.zeros(total)
    reduced = [_integrate_numbers(s) for s in specimens]
    for i, (of, part) in enumerate(zip(reduced, shared.parts, strict=True)):
        b = np.zeros((len(part), total))
        b[:, :count] = part
        for at, o in enumerate(own, start=count):
            if o.specimen == i:
                b[o.place, at] = 1.0
        precision += b.T @ of[0] @ b
        pulled += b.T @ of[1]
    columns = [*map(_as_candidate, shared.columns), *(_as_own(specimens, o) for o in own)]
    trifle = np.sqrt(_ALIKE) * list_trifles(columns[:count])
    regular = precision[:count, :count] + np.diag(trifle**-2.0)
    solved = np.linalg.solve(regular, np.column_stack([precision[:count], pulled[:count]]))
    rest = precision - precision[:, :count] @ solved[:, :-1]
    sizes = sample_large_sizes(
        0.5 * (rest + rest.T), pulled - precision[:, :count] @ solved[:, -1], columns, _apart(specimens)
    )
    trifles = solved[:, -1] - solved[:, :-1] @ sizes.mean(axis=0)
    return SharedLaw(shared, tuple(own), sizes, trifles, tuple(of[0] for of in reduced), tuple(of[1] for of in reduced))


def _integrate_numbers(of: SpecimenStatistics) -> tuple[Array, Array]:
    """Return what a campaign says of its sizes (K, K), (K,), its numbers and what is trifling in it integrated out."""
    base = len(of.numbers)
    ridge = np.concatenate([of.ridge[:base], list_own_trifles(of) ** -2.0])
    solved = np.linalg.solve(of.whole + np.diag(ridge), np.column_stack([of.whole[:, base:], of.pull]))
    precision = of.whole[base:, base:] - of.whole[base:] @ solved[:, :-1]
    return 0.5 * (precision + precision.T), of.pull[base:] - of.whole[base:] @ solved[:, -1]


def list_own_trifles(of: SpecimenStatistics) -> Array:
    """Return the standard deviation (K,) of what a specimen has of every column by itself [limits]."""
    alone = [1.0 if c.gauge or c.label != c.effect else 1.0 - _ALIKE for c in of.columns]
    return np.sqrt(alone) * of.trifle


def _as_candidate(c: SpecimenColumn) -> CandidateColumn:
    strength = next(iter(c.step)) if len(c.step) == 1 else ""
    nothing = np.zeros(0, np.float32)
    return CandidateColumn(
        c.label, c.effect, c.gauge, c.form, strength, c.shape, 0.0, c.two_sided, 1.0, nothing, c.numbers
    )


def _as_own(specimens: Sequence[SpecimenStatistics], of: OwnColumn) -> CandidateColumn:
    c, name = specimens[of.specimen].columns[of.place], specimens[of.specimen].name
    return replace(_as_candidate(c), label=own_label(c.label, name), effect=own_label(c.effect, name))


def own_label(label: str, specimen: str) -> str:
    """Return how a term is called that one specimen has alone."""
    return f"{label} of {specimen}"


def _apart(specimens: Sequence[SpecimenStatistics]) -> set[tuple[str, str]]:
    """Return what cannot be in one model, in both orders: two laws in one place, shared or of one specimen."""
    out: set[tuple[str, str]] = set()
    for s in specimens:
        for a, b in s.apart:
            mine = own_label(a, s.name), own_label(b, s.name)
            out |= {(a, b), mine, (a, mine[1]), (mine[0], b)}
    return out
