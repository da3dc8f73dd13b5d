"""Least squares over many relations by their normal equations: small matrices, whatever the number of rows.

Explanations touch few relations each, and weights are one number for a relation; so products of columns are kept per
relation, and weighing, projecting and asking what is left of a relation costs no pass over the rows.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array

#: Columns (n, k) of one explanation in the relations that it touches.
Block = Mapping[str, Array]


@dataclass(frozen=True)
class Part:
    """Products of one relation's columns.

    Attributes:
        index: (k,) numbers of the columns that the relation has.
        squares: (k, k) X'X.
        along: (k,) X'r.
        power: r'r.
        count: rows.
    """

    index: NDArray[np.int64]
    squares: Array
    along: Array
    power: float
    count: int


def build_equations(
    blocks: Sequence[Block], residual: Mapping[str, Array]
) -> tuple[dict[str, Part], NDArray[np.int64]]:
    """Make the products of all blocks' columns; give them and the number of the first column of each block."""
    widths = [next((columns.shape[1] for columns in block.values()), 0) for block in blocks]
    first = np.cumsum([0, *widths])
    parts = {}
    for name, left in residual.items():
        here = [i for i, block in enumerate(blocks) if name in block]
        index = np.concatenate([np.arange(first[i], first[i + 1]) for i in here]) if here else np.zeros(0, dtype=int)
        matrix = np.concatenate([blocks[i][name] for i in here], axis=1) if here else np.zeros((len(left), 0))
        parts[name] = Part(index.astype(np.int64), matrix.T @ matrix, matrix.T @ left, float(left @ left), len(left))
    return parts, first


def weigh_equations(parts: Mapping[str, Part], weight: Mapping[str, float], count: int) -> tuple[Array, Array]:
    """Return the normal equations (count, count), (count,) of all rows, weighed by their relations' weights."""
    squares, along = np.zeros((count, count)), np.zeros(count)
    for name, part in parts.items():
        square = weight[name] ** 2
        squares[np.ix_(part.index, part.index)] += square * part.squares
        along[part.index] += square * part.along
    return squares, along


def get_left_over(part: Part, solution: Array) -> float:
    """Return the mean square that a solution leaves in one relation."""
    own = solution[part.index]
    return max(part.power - 2.0 * float(own @ part.along) + float(own @ part.squares @ own), 0.0) / max(part.count, 1)


def invert_regularised(squares: Array) -> Array:
    """Invert normal equations; directions that the data do not determine get no step."""
    norm = np.sqrt(np.diag(squares))
    norm[norm == 0.0] = 1.0
    values, vectors = np.linalg.eigh(squares / np.outer(norm, norm))
    kept = values > 1e-11 * float(values.max(initial=1e-300))
    return ((vectors[:, kept] / values[kept]) @ vectors[:, kept].T) / np.outer(norm, norm)
