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
from slipwise.estimation.objective import Objective

Array = NDArray[np.float64]
#: Every n-th sample is screened; blocks into which a single motion is cut to be left out by turns.
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


def residual_field(objective: Objective, solution: Solution, relation: str, thinned: int = _THINNED) -> ResidualField:
    """Take the residual of a relation.

    Args:
        objective: with its noise.
        solution: of a fit, with slopes of its own.
        relation: of the objective.
        thinned: every n-th sample is taken.
    """
    parts, sigmas, kept, group = [], [], [], []
    picked: dict[int, NDArray[np.bool_]] = {}
    rows = [(at, of) for at, of in solution.residuals.rows(objective.fitted) if of.relation == relation]
    alone = len({of.motion for _, of in rows}) == 1
    for _, of in rows:
        wide = of.columns
        judged = of.mask.reshape(wide.shape)
        taken = np.zeros_like(judged)
        taken[::thinned] = judged[::thinned]
        sigmas.append(of.noise.reshape(wide.shape)[taken])
        block = np.linspace(0.0, _BLOCKS * (1.0 - 1e-9), len(wide)).astype(np.int64) if alone else of.motion
        group.append(np.broadcast_to(np.reshape(block, (-1, 1)), wide.shape)[taken])
        parts.append(wide[taken])
        kept.append(taken.ravel())
        picked[of.run] = taken
    basis = basis_of(solution.inside[rows[0][0].start : rows[-1][0].stop][np.concatenate(kept)])
    residual = np.concatenate(parts)
    return ResidualField(
        relation, residual - basis @ (basis.T @ residual), basis, np.concatenate(sigmas), np.concatenate(group),
        picked, objective.fitted_runs[0].fine,
    )  # fmt: skip
