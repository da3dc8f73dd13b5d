"""The mean residual in bins of one or two states while sliding to one side, with its error."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.comparison.cells import Samples
from slipwise.residual_map.curve import fit_curve
from slipwise.residual_map.splines import SplineBasis


@dataclass(frozen=True)
class MeanResidual:
    """Mean residual of the samples of one direction of sliding, in b bins.

    Attributes:
        mean: (b,) [floors]; NaN with fewer independent samples than asked for.
        error: (b,) its standard error; NaN there.
        few: (b,) mean residual of these bins, where they have any samples; NaN elsewhere.
        count: (b,) samples.
    """

    mean: Array
    error: Array
    few: Array
    count: NDArray[np.int64]


def compute_mean_residual(
    samples: Samples, kinds: Sequence[str], edges: Sequence[Array], direction: float, fewest: float
) -> MeanResidual:
    """Average a relation's residual in bins, over the samples that slide to one side and whose states are known.

    Args:
        samples: of the relation.
        kinds: one or two states.
        edges: of the bins of each; those of two are numbered row by row.
        direction: 1 for sliding to +x, -1 for sliding to -x.
        fewest: independent samples without which a bin has no error.
    """
    values = [samples.values[kind] for kind in kinds]
    used = (samples.values["direction"] - 1.0 == direction) & np.isfinite(values).all(axis=0)
    over = [v[used] for v in values]
    curve = fit_curve(SplineBasis(tuple(edges), degree=0), over, np.ones(int(used.sum())), samples.residual[used])
    enough = curve.count >= fewest * samples.spread
    mean = curve.heights()
    return MeanResidual(
        np.where(enough, mean, np.nan),
        np.where(enough, curve.errors(samples.spread), np.nan),
        np.where(enough | (curve.count == 0), np.nan, mean),
        curve.count,
    )
