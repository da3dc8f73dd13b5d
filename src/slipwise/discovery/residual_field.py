"""The residual of one relation on thinned samples, with what base parameters can do to it taken out.

Columns are projected away from the Jacobian of everything that was fitted (Frisch, Waugh 1933; Lovell 1963), so that
what is found cannot be had by other base parameters or another size of what was named.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.diagnosis.screening import basis_of
from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Problem
from slipwise.evidence.left_out import motions

Array = NDArray[np.float64]
#: Every so manieth sample is screened; blocks into which a single motion is cut to be left out by turns.
_THINNED, _BLOCKS = 5, 8


@dataclass(frozen=True)
class ResidualField:
    """The residual of a relation at the samples by which it is judged.

    Attributes:
        relation: its name.
        residual: (m,) in noise, base parameters projected out.
        basis: (m, k) orthonormal, of what they can do.
        sigma: (m,) noise in the relation's unit.
        group: (m,) which motion a sample belongs to.
        picked: run -> (n, q) samples that are taken, q pads or 1.
        fine: instants per sample.
    """

    relation: str
    residual: Array
    basis: Array
    sigma: Array
    group: NDArray[np.int64]
    picked: dict[int, NDArray[np.bool_]]
    fine: int

    @property
    def excess(self) -> float:
        """Squared residual above that of noise [1]."""
        return float(self.residual @ self.residual) - len(self.residual)

    def at_samples(self, values: Sequence[Array]) -> Array:
        """Return what is known at the instants, per run of all (f, q), at the samples that are taken, (m,)."""
        return np.concatenate([values[i][:: self.fine][picked] for i, picked in self.picked.items()])

    def projected(self, columns: Array) -> Array:
        """Project columns (m, c), in noise, away from the base parameters."""
        return columns - self.basis @ (self.basis.T @ columns)


def residual_field(problem: Problem, solution: Solution, relation: str, thinned: int = _THINNED) -> ResidualField:
    """Take the residual of a relation.

    Args:
        problem: with its noise.
        solution: of a fit, with slopes of its own.
        relation: of the problem.
        thinned: every so manieth sample is taken.
    """
    parts, sigmas, kept, group = [], [], [], []
    picked: dict[int, NDArray[np.bool_]] = {}
    groups = {i: g for g, members in enumerate(motions(problem)) for i in members}
    alone = len(set(groups.values())) == 1
    for i in problem.fitted:
        part = solution.residuals.parts[relation][i]
        wide = part.reshape(len(part), -1)
        judged = problem.runs[i].judged[relation].reshape(len(part), -1)
        taken = np.zeros_like(judged)
        taken[::thinned] = judged[::thinned]
        sigma = np.asarray(problem.sigmas[relation][i])
        sigmas.append(np.broadcast_to(sigma[:, None] if sigma.ndim == 1 else sigma, wide.shape)[taken])
        block = np.linspace(0.0, _BLOCKS * (1.0 - 1e-9), len(part)).astype(np.int64) if alone else groups[i]
        group.append(np.broadcast_to(np.reshape(block, (-1, 1)), wide.shape)[taken])
        parts.append(wide[taken])
        kept.append(taken.ravel())
        picked[i] = taken
    basis = basis_of(solution.inside[_rows(problem, solution, relation)][np.concatenate(kept)])
    residual = np.concatenate(parts)
    return ResidualField(
        relation, residual - basis @ (basis.T @ residual), basis, np.concatenate(sigmas), np.concatenate(group),
        picked, problem.runs[problem.fitted[0]].fine,
    )  # fmt: skip


def _rows(problem: Problem, solution: Solution, relation: str) -> slice:
    """Return where a relation stands in the stacked residual of the fitted runs."""
    first = 0
    for name in problem.relations:
        size = sum(solution.residuals.parts[name][i].size for i in problem.fitted)
        if name == relation:
            return slice(first, first + size)
        first += size
    raise KeyError(relation)
