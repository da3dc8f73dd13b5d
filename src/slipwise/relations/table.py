"""What a fit leaves of every relation, as one table: its order when it is stacked, and its sums of squares."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from slipwise.arrays import Array, Mask
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True, eq=False)
class Block:
    """The residual of one relation in one run.

    Attributes:
        relation: "pads", "girder" ...
        run: place of the run.
        name: of the run.
        motion: number of the motion: a repeat has that of the run which it repeats.
        role: of the run: "fit", "repeat" or "holdout".
        time: (n,) [s].
        dt: its step [s].
        value: (n,) or (n, p) measured less predicted [standard deviation of the noise]; zero where not judged.
        sigma: standard deviation of the noise in the relation's unit, broadcastable to `value`; 1 before it is known.
        mask: of the shape of `value`: samples by which the relation is judged.
    """

    relation: str
    run: int
    name: str
    motion: int
    role: str
    time: Array
    dt: float
    value: Array
    sigma: Array
    mask: Mask

    @property
    def fitted(self) -> bool:
        """Whether a fit may look at it."""
        return self.role != "holdout"

    @property
    def squares(self) -> float:
        """Sum of the squared residuals [noise variance]."""
        return float(np.sum(self.value**2))

    @property
    def count(self) -> int:
        """How many samples are judged."""
        return int(np.count_nonzero(self.mask))

    @property
    def columns(self) -> Array:
        """Residual as (n, p), p = 1 for a relation that is no pads'."""
        return self.value.reshape(len(self.time), -1)

    @property
    def noise(self) -> Array:
        """Standard deviation of the noise of every residual, of the shape of `value`, in the relation's unit."""
        return np.broadcast_to(self.sigma, self.value.shape)


@short_repr
@dataclass(frozen=True, eq=False)
class Residuals:
    """Residuals of every relation in every run that was evaluated, in units of the noise.

    Attributes:
        table: a block of each relation and run, in the order in which they are stacked.
        pad_forces: per run (n, p) friction along x that is predicted [N].
    """

    table: tuple[Block, ...] = ()
    pad_forces: tuple[Array, ...] = field(default=())

    @cached_property
    def _at(self) -> dict[tuple[str, int], Block]:
        return {(block.relation, block.run): block for block in self.table}

    @cached_property
    def relations(self) -> tuple[str, ...]:
        """Names of the relations, in the order in which they are stacked."""
        return tuple(dict.fromkeys(block.relation for block in self.table))

    @property
    def is_empty(self) -> bool:
        """Whether no residuals were kept."""
        return not self.table

    @property
    def nbytes(self) -> int:
        """Memory of the residuals and the predicted forces [bytes]."""
        return sum(block.value.nbytes for block in self.table) + sum(force.nbytes for force in self.pad_forces)

    def block(self, relation: str, run: int) -> Block:
        """Return the block of one relation in the run at a place."""
        return self._at[relation, run]

    def blocks(self, relations: Sequence[str] | str | None = None, runs: Sequence[int] | None = None) -> list[Block]:
        """Return blocks in the order in which they are stacked: by relation, then by run.

        Args:
            relations: which, in this order, or one; those that are there, if not given.
            runs: places, in this order; every run that was evaluated, if not given.
        """
        names = self.relations if relations is None else (relations,) if isinstance(relations, str) else relations
        places = sorted({block.run for block in self.table}) if runs is None else runs
        return [self._at[name, run] for name in names if name in self.relations for run in places]

    def of(self, relation: str) -> tuple[Array, ...]:
        """Return the residuals of one relation, per run (n,), or (n, p) of pads."""
        return tuple(block.value for block in self.blocks(relation))

    def stacked(self, runs: Sequence[int], relations: Sequence[str] | str | None = None) -> Array:
        """Return all residuals of these runs in one vector (m,); arguments as for `blocks`."""
        return np.concatenate([block.value.ravel() for block in self.blocks(relations, runs)])

    def rows(self, runs: Sequence[int], relations: Sequence[str] | None = None) -> Iterator[tuple[slice, Block]]:
        """Yield each block with its rows in the stacked vector; arguments as for `blocks`."""
        start = 0
        for block in self.blocks(relations, runs):
            yield slice(start, start + block.value.size), block
            start += block.value.size

    def by_motion(self, relation: str) -> dict[int, list[Block]]:
        """Return the blocks of one relation in the fitted runs by the number of their motion."""
        out: dict[int, list[Block]] = {}
        for block in self.blocks(relation):
            if block.fitted:
                out.setdefault(block.motion, []).append(block)
        return out

    def squares(self, relation: str, runs: Sequence[int]) -> float:
        """Return the sum of the squared residuals of one relation over some runs [noise variance]."""
        return sum(self._at[relation, run].squares for run in runs)

    def count(self, relation: str, runs: Sequence[int]) -> int:
        """Return by how many samples of some runs a relation is judged."""
        return sum(self._at[relation, run].count for run in runs)

    def mean_square(self, relation: str, runs: Sequence[int]) -> float:
        """Return the mean squared residual over the judged samples of some runs [noise variance]; 0 without any."""
        return self.squares(relation, runs) / max(self.count(relation, runs), 1)

    def level(self, relation: str, runs: Sequence[int]) -> float:
        """Return the rms of the residual over the judged samples of some runs [standard deviation of the noise]."""
        return float(np.sqrt(self.mean_square(relation, runs)))

    def cost(self, runs: Sequence[int], relations: Sequence[str] | str | None = None) -> float:
        """Return the sum of the squared residuals over some runs [noise variance]; arguments as for `stacked`."""
        left = self.stacked(runs, relations)
        return float(left @ left)

    def changes_by_run(self, other: "Residuals") -> list[float]:
        """Return the sum of the squared differences to other residuals of the same runs, one for each run."""
        return [
            sum(float(np.sum((other.block(of.relation, run).value - of.value) ** 2)) for of in self.blocks(runs=[run]))
            for run in sorted({block.run for block in self.table})
        ]

    def filled(self, values: Mapping[str, Sequence[Array]], pad_forces: Sequence[Array]) -> "Residuals":
        """Return the table with other residuals.

        Args:
            values: relation -> per run, for the first runs of the table, or all of them.
            pad_forces: per run (n, p) friction along x that is predicted [N].
        """
        table = tuple(
            replace(block, value=values[block.relation][block.run])
            for block in self.table
            if block.run < len(values[block.relation])
        )
        return Residuals(table, tuple(pad_forces))

    def less(self, columns: Mapping[str, Sequence[Array]]) -> "Residuals":
        """Return the residuals less what is added to the predictions.

        Args:
            columns: relation -> per run, of the shape of its residual, in noise.
        """
        table = tuple(
            replace(block, value=block.value - columns[block.relation][block.run])
            if block.relation in columns
            else block
            for block in self.table
        )
        return replace(self, table=table)
