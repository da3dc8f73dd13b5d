"""The residual of one relation at the samples by which it is judged, with the states and carriers that belong to them.

Columns may be projected away from the Jacobian of everything that was fitted (Frisch, Waugh 1933; Lovell 1963), so that
what is found cannot be had by other base parameters or another size of what was named.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Objective
from slipwise.regression.projection import basis_of, project_away
from slipwise.relations.table import Residuals
from slipwise.residual_map.curve import ResidualCurve, fit_curve
from slipwise.residual_map.splines import SplineBasis

#: Blocks into which a single motion is cut, to be left out by turns.
_BLOCKS = 8


@dataclass(frozen=True)
class ResidualField:
    """The residual of a relation in the fitted runs, at m of the samples by which it is judged.

    Attributes:
        relation: its name.
        residual: (m,) in noise.
        base: (m, k) orthonormal, of what base parameters can do, taken out of the residual; k = 0 where they are not.
        sigma: (m,) noise in the relation's unit.
        block: (m,) the motion of each sample, or the stretch of time where there is one motion only.
        picked: run -> (n, q) samples that are taken, q pads or 1.
        fine: instants per sample.
    """

    relation: str
    residual: Array
    base: Array
    sigma: Array
    block: NDArray[np.int64]
    picked: dict[int, NDArray[np.bool_]]
    fine: int

    @property
    def excess(self) -> float:
        """Squared residual above that of noise [1]."""
        return float(self.residual @ self.residual) - len(self.residual)

    def at_samples(self, values: Sequence[Array]) -> Array:
        """Return what is known at the instants, per run of all (f, q), at the samples that are taken, (m,)."""
        return np.concatenate([values[i][:: self.fine][picked] for i, picked in self.picked.items()])

    def fit(self, splines: SplineBasis, states: Sequence[Array], carrier: Array | float = 1.0) -> ResidualCurve:
        """Return the curve over states that the residual asks for, in the relation's unit over that of the carrier.

        Args:
            splines: of which the curve is made.
            states: at the samples, (m,) each.
            carrier: (m,) what the curve is multiplied by.
        """
        return fit_curve(splines, states, carrier / self.sigma, self.residual, self.block, self.base)


def take_field(objective: Objective, residuals: Residuals, relation: str, thinned: int) -> ResidualField:
    """Take the residual of a relation of which nothing is projected out.

    Args:
        objective: with its noise.
        residuals: of a fit.
        relation: of the objective.
        thinned: every n-th sample is taken.
    """
    parts, sigmas, block = [], [], []
    picked: dict[int, NDArray[np.bool_]] = {}
    blocks = residuals.blocks(relation, objective.fitted)
    alone = len({of.motion for of in blocks}) == 1
    for of in blocks:
        wide = of.columns
        judged = of.mask.reshape(wide.shape)
        taken = np.zeros_like(judged)
        taken[::thinned] = judged[::thinned]
        parts.append(wide[taken])
        sigmas.append(of.noise.reshape(wide.shape)[taken])
        number = np.linspace(0.0, _BLOCKS * (1.0 - 1e-9), len(wide)).astype(np.int64) if alone else of.motion
        block.append(np.broadcast_to(np.reshape(number, (-1, 1)), wide.shape)[taken])
        picked[of.run] = taken
    residual = np.concatenate(parts)
    base = np.zeros((len(residual), 0))
    fine = objective.fitted_runs[0].fine
    return ResidualField(relation, residual, base, np.concatenate(sigmas), np.concatenate(block), picked, fine)


def project_base_out(field: ResidualField, objective: Objective, solution: Solution) -> ResidualField:
    """Return a field without what the numbers of a fit can do.

    Args:
        field: the residual of the fit.
        objective: of the fit.
        solution: of the fit, with slopes of its own.
    """
    rows = [at for at, of in solution.residuals.rows(objective.fitted) if of.relation == field.relation]
    kept = np.concatenate([picked.ravel() for picked in field.picked.values()])
    base = basis_of(solution.inside[rows[0].start : rows[-1].stop][kept])
    return replace(field, residual=project_away(base, field.residual), base=base)
