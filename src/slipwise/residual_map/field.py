"""The residual of one relation at the samples by which it is judged, with the states that belong to them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.estimation.objective import Objective
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
        sigma: (m,) noise in the relation's unit.
        block: (m,) the motion of each sample, or the stretch of time where there is one motion only.
        picked: run -> (n, q) samples that are taken, q pads or 1.
        fine: instants per sample.
    """

    relation: str
    residual: Array
    sigma: Array
    block: NDArray[np.int64]
    picked: dict[int, NDArray[np.bool_]]
    fine: int

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
        return fit_curve(splines, states, carrier / self.sigma, self.residual, self.block)


def take_field(objective: Objective, residuals: Residuals, relation: str, thinned: int) -> ResidualField:
    """Take the residual of a relation.

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
    fine = objective.fitted_runs[0].fine
    return ResidualField(relation, residual, np.concatenate(sigmas), np.concatenate(block), picked, fine)
