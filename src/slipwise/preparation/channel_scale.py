"""By which factor a channel is too large, as the balances say: any factor, not only one near 1.

Every relation of `slipwise.relations.rigid_balances` that may accuse is linear in each channel, so the factor f of one
channel, or of a card of cells, follows from least squares with the constants of the rig free:

    r - u + u / f + sum of constant * term = 0,    u: what the channel puts into the relation r as it stands
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.preparation.gauge_groups import group_gauges
from slipwise.relations.balance_rows import (
    PreparedRun,
    Stack,
    list_changed_rows,
    list_constants,
    stack_rows,
    with_records,
)
from slipwise.relations.rigid_balances import Relation
from slipwise.rig import Specimen

#: A relation is known no better than this share of what goes into it, and the mass than this share of itself [1].
_LEAST, _MASS = 0.002, 0.01
#: How often relations are weighed anew by what is left in them.
_ROUNDS = 6


@dataclass(frozen=True)
class ChannelScale:
    """What the relations say of the scale of one channel or card.

    Attributes:
        factor: by which it is too large; 0 where no positive one helps [1].
        left: relation -> root mean square of what is left, over the size of what goes into it [1].
        own: relations that look at the channel.
    """

    factor: float
    left: Mapping[str, float]
    own: tuple[str, ...]


@dataclass(frozen=True)
class System:
    """The relations of runs as they stand.

    Attributes:
        runs: smoothed.
        usable: relations that may accuse.
        specimen: rated.
        stacked: residuals, and the columns of the constants.
        sizes: relation -> channel -> root mean square of what it puts into the relation.
        centred: whether means are left out run by run: then a tared cell, or gravity in an accelerometer, is no matter.
    """

    runs: list[PreparedRun]
    usable: Sequence[Relation]
    specimen: Specimen
    stacked: Stack
    sizes: Mapping[str, Mapping[str, float]]
    centred: bool

    def part(self, names: Sequence[str]) -> dict[str, Array]:
        """Return what channels put into the relations, relation -> (n,)."""
        silent = with_records(self.runs, lambda r: r.replaced(**{name: 0.0 * r[name] for name in names}))
        rated = _rated(self.usable, self.specimen)
        changed = list_changed_rows(silent, self.usable, self.specimen, rated, self.stacked, frozenset(names))
        return {name: -self.rows(name, rows) for name, rows in changed.items() if rows.any()}

    def rows(self, name: str, values: Array) -> Array:
        """Return rows of a relation (n,), without their means where the system is centred."""
        if not self.centred:
            return values
        run = self.stacked.run_of[name]
        return values - (np.bincount(run, weights=values) / np.maximum(np.bincount(run), 1))[run]

    def divided(self, names: Sequence[str], factor: float, *, centred: bool) -> "System":
        """Return the system with channels divided by a factor."""
        runs = divide_channels(self.runs, names, factor)
        stacked = stack_rows(runs, self.usable, self.specimen, _rated(self.usable, self.specimen))
        sizes = {
            relation: {name: size / factor if name in names else size for name, size in of.items()}
            for relation, of in self.sizes.items()
        }
        return replace(self, runs=runs, stacked=stacked, sizes=sizes, centred=centred)


def find_system(runs: list[PreparedRun], usable: Sequence[Relation], specimen: Specimen) -> System:
    """Evaluate the relations, centred; those that hold at too few samples to be told from a constant stay out."""
    stacked = stack_rows(runs, usable, specimen, _rated(usable, specimen))
    enough = [relation for relation in usable if _is_told(relation, stacked, len(runs))]
    if len(enough) < len(usable):
        usable, stacked = enough, stack_rows(runs, enough, specimen, _rated(enough, specimen))
    bare = System(runs, usable, specimen, stacked, {}, centred=True)
    single = [names[0] for names in group_gauges(runs[0].record).values() if len(names) == 1]
    sizes: dict[str, dict[str, float]] = {name: {} for name in stacked.residual}
    for channel in single:
        for name, rows in bare.part((channel,)).items():
            sizes[name][channel] = _rms(rows)
    return replace(bare, sizes=sizes)


def _is_told(relation: Relation, stacked: Stack, runs: int) -> bool:
    """Return whether a relation has more rows than its constants, a scale and the mean of every run take up."""
    return len(stacked.residual.get(relation.name, ())) > len(relation.terms) + 1 + runs


def divide_channels(runs: Sequence[PreparedRun], names: Sequence[str], factor: float) -> list[PreparedRun]:
    """Return runs with channels divided by a factor."""
    return with_records(runs, lambda r: r.replaced(**{name: r[name] / factor for name in names}))


def estimate_channel_scale(system: System, names: Sequence[str], *, mass_known: bool) -> ChannelScale:
    """Fit the constants, and the scale of channels by what they put into each relation.

    Args:
        system: the relations.
        names: one channel or the cells of a card; none leaves every channel as it is.
        mass_known: whether the mass stays as rated: it multiplies an acceleration, and means nothing before that is
            nearly right.
    """
    base, part = system.stacked.base, system.part(names) if names else {}
    constants = [name for name in base if not (name == "mass" and mass_known)]
    size = {n: _usual(of.values()) for n, of in system.sizes.items()}
    rows, target = {}, {}
    for n, residual in system.stacked.residual.items():
        none = np.zeros(len(residual))
        columns = [system.rows(n, base[c][n][:, 0]) if n in base[c] else none for c in constants]
        rows[n] = np.column_stack([*columns, part.get(n, none)]) / size[n]
        target[n] = (part.get(n, none) - system.rows(n, residual)) / size[n]
    squares = {n: of.T @ of / len(of) for n, of in rows.items()}
    along = {n: of.T @ target[n] / len(of) for n, of in rows.items()}
    left = {n: max(_rms(values), _LEAST) for n, values in target.items()}
    solution = np.zeros(len(constants) + 1)
    for _ in range(_ROUNDS):
        matrix = np.sum([squares[n] / left[n] ** 2 for n in rows], axis=0)
        right = np.sum([along[n] / left[n] ** 2 for n in rows], axis=0)
        if "mass" in constants:  # what is fitted is its change
            matrix[constants.index("mass"), constants.index("mass")] += 1.0 / (_MASS * system.specimen.mass) ** 2
        unit = 1.0 / np.sqrt(np.maximum(np.diag(matrix), 1e-300))
        solution = unit * (np.linalg.pinv(matrix * np.outer(unit, unit), hermitian=True) @ (right * unit))
        left = {n: max(_rms(target[n] - rows[n] @ solution), _LEAST) for n in rows}
    inverse = float(solution[-1])
    if inverse <= 0.0:
        return ChannelScale(0.0, left, tuple(part))
    # what goes into a relation is smaller too where a channel was too large
    after = {n: _usual(v * inverse if c in names else v for c, v in of.items()) for n, of in system.sizes.items()}
    return ChannelScale(1.0 / inverse, {n: left[n] * size[n] / after[n] for n in rows}, tuple(part))


def _rated(usable: Sequence[Relation], specimen: Specimen) -> dict[str, float]:
    return {**dict.fromkeys(list_constants(usable), 0.0), "mass": specimen.mass}


def _usual(sizes: Iterable[float]) -> float:
    """Return size of what usually goes into a relation: of two channels the smaller, for one may be far too large."""
    return float(np.quantile(list(sizes), 0.5, method="lower"))


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
