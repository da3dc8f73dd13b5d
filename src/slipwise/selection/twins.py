"""Twins of a campaign: its own fitted model, motions and noise, with one more effect in it.

A twin is no replay. Its residual is that of the fit, drawn again, less the column of the effect: products of columns
tell what a posterior would have said of it.
"""

from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.evidence.posterior import Effort, Posterior, compute_posterior
from slipwise.evidence.statistics import Statistics, restrict
from slipwise.selection.weighed_model import WeighedModel

#: Of one twin among many.
_EFFORT = Effort(chains=2, sweeps=20, draws=100, rounds=2)


@dataclass(frozen=True)
class Twin:
    """One effect in a campaign of the same model, motions and noise.

    Attributes:
        draw: number of the noise.
        sizes: (k,) of every column in it beside the model's own effects [limits].
    """

    draw: int
    sizes: Array


def make_twin(weighed: WeighedModel, place: int, size: float, draw: int) -> Twin:
    """Return a twin with one column in it.

    Args:
        weighed: of the campaign.
        place: of the column among those of the candidates.
        size: of it [limits].
        draw: number of the noise.
    """
    sizes = np.zeros(weighed.statistics.products.shape[1])
    sizes[weighed.statistics.base + place] = size
    return Twin(draw, sizes)


def compute_posterior_of_twin(weighed: WeighedModel, twin: Twin) -> Posterior:
    """Return what a posterior says of a twin."""
    every, columns = range(len(weighed.columns)), weighed.columns[weighed.planted :]
    statistics = compute_statistics_of_twin(weighed, twin)
    sought = restrict(statistics, range(len(statistics.rows)), every[weighed.planted :])
    return compute_posterior(sought, columns, weighed.tolerances, weighed.apart, _EFFORT)


def compute_statistics_of_twin(weighed: WeighedModel, twin: Twin) -> Statistics:
    """Return the products with the residual of a twin.

    What a model lacks stands in its residual with the opposite sign of its column.
    """
    of, noise = weighed.statistics, weighed.noise[twin.draw]
    inside = -(weighed.own + twin.sizes)
    pulls = noise + of.products @ inside
    squares = of.fitted + 2.0 * noise @ inside + np.einsum("i,kij,j->k", inside, of.products, inside)
    beside = twin.sizes[of.base :]
    shown = np.einsum("i,kij,j->k", beside, weighed.left_by_base, beside) * np.maximum(of.samples, 1.0)
    return replace(of, pulls=pulls, squares=squares, fitted=of.fitted + np.maximum(shown, 0.0))
