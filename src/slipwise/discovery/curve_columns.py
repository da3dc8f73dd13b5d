"""Curves as columns: what pieces of a curve over a state, at a port and a gate, change in the averaged residual.

They are averaged as the columns of all candidates are: beside those they compete in one system.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, vstack

from slipwise.arrays import Array
from slipwise.estimation.objective import Objective
from slipwise.residual_map.ports import EVERYWHERE, Gate, Port
from slipwise.residual_map.splines import SplineBasis, choose_knots
from slipwise.residual_map.states import DrivingState
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.short_repr import short_repr

#: Knots over one state, over the slip (a plate may be grooved), and over each of two.
_KNOTS, _KNOTS_OF_SLIP, _KNOTS_OF_TWO = 12, 60, 6
#: Every n-th sample tells where knots lie.
_THINNED = 5


@short_repr
@dataclass(frozen=True)
class Dependence:
    """On which states a force may depend, and how it may enter.

    Attributes:
        states: one, or two.
        port: how it enters.
        gate: on which pads, and which way.
        opened: per run (f, p) 1 where the gate is open; None where it always is.
    """

    states: tuple[DrivingState, ...]
    port: Port
    gate: Gate = EVERYWHERE
    opened: Sequence[Array] | None = None


@short_repr
@dataclass(frozen=True)
class CurveColumns:
    """Pieces of a curve as columns.

    Attributes:
        splines: of which the curve is made, K of them.
        columns: (q, K) change of the averaged residual of the port's relation by a height of one [noise].
        count: (K,) samples at each spline.
    """

    splines: SplineBasis
    columns: Array
    count: NDArray[np.int64]


def make_curve_columns(objective: Objective, rows: AveragedRows, of: Dependence) -> CurveColumns:
    """Return the columns of a curve.

    Args:
        objective: of the fit.
        rows: how its residuals are averaged.
        of: on what the curve depends.
    """
    relation, parts = of.port.relation, []
    blocks = [(at, b) for at, b in objective.layout.rows(objective.fitted) if b.relation == relation]
    judged = [b.mask.reshape(len(b.time), -1) for _, b in blocks]
    sampled = [
        [_spread(s.values[b.run], objective.run(b.run).fine, mask.shape) for s in of.states]
        for (_, b), mask in zip(blocks, judged, strict=True)
    ]
    knots = tuple(
        choose_knots(
            np.concatenate([v[k][m][::_THINNED] for v, m in zip(sampled, judged, strict=True)]), _count(of.states, k)
        )
        for k in range(len(of.states))
    )
    splines = SplineBasis(knots, degree=1)
    for (_, b), mask, values in zip(blocks, judged, sampled, strict=True):
        fine = objective.run(b.run).fine
        carrier = of.port.carrier[b.run] if of.opened is None else of.port.carrier[b.run] * of.opened[b.run]
        force = _spread(carrier, fine, mask.shape)
        factor = np.where(mask, -force / b.noise.reshape(mask.shape), 0.0).ravel()
        pieces = splines.columns([v.ravel() for v in values])
        pieces.data = pieces.data * np.repeat(factor, np.diff(pieces.indptr))
        parts.append(pieces)
    stacked: Any = csr_array(vstack(parts, format="csr"))
    count = np.bincount(stacked.indices[stacked.data != 0.0], minlength=stacked.shape[1])
    return CurveColumns(splines, rows.average_sparse(relation, stacked, blocks[0][0].start), count)


def average_over_rows(objective: Objective, rows: AveragedRows, relation: str, values: Sequence[Array]) -> Array:
    """Return the mean of what is known at the instants, per run of all (f, p), over each averaged row of a relation."""
    blocks = [(at, b) for at, b in objective.layout.rows(objective.fitted) if b.relation == relation]
    first, out, start = 0, [np.zeros(0)], blocks[0][0].start
    known = np.concatenate(
        [_spread(values[b.run], objective.run(b.run).fine, b.columns.shape).ravel() for _, b in blocks]
    )
    for each in rows.series:
        here, first = first, first + len(each.edges)
        if rows.relation[here] == rows.relations.index(relation):
            out.append(np.add.reduceat(known[each.rows - start], each.edges) * each.weight**2)
    return np.concatenate(out)


def _spread(values: Array, fine: int, shape: tuple[int, ...]) -> Array:
    """Return values at the instants (f, q) at the samples of a relation, for every pad."""
    sampled = values[::fine]
    return sampled[:, : shape[1]] if sampled.shape[1] > shape[1] else np.broadcast_to(sampled, shape)


def _count(states: Sequence[DrivingState], place: int) -> int:
    if len(states) > 1:
        return _KNOTS_OF_TWO
    return _KNOTS_OF_SLIP if states[place].name == "slip" else _KNOTS
