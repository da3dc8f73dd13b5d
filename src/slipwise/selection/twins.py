"""What campaigns like one at hand would say of an effect that is there: twins drawn from sufficient statistics.

A twin is what a fit of the base would leave if one effect of a given size were there, beside small imperfections of
everything and the gauges' noise. Only its products with slopes and columns are drawn, for the posterior asks for no
more: nothing is replayed, and a thousand twins take less than a second. Each is weighed as `posterior` weighs a
campaign, with one effect at most that matters: all other sizes are integrated out, and what may take the one place is
summed over, not sampled.

    y = -X (b + u) + e,   b one column's size,   u trifles of everything,   e white, of unit variance

Source: `selection.posterior`; Atkinson, Donev, Tobias, Optimum Experimental Designs, with SAS, 2007, chapter 20.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import log_ndtr, ndtr

from slipwise.arrays import Array
from slipwise.selection.columns import CandidateColumn
from slipwise.selection.inclusion import MATTERS, SEEN
from slipwise.selection.posterior import Prior
from slipwise.selection.statistics import Statistics, compute_left_by_base

#: Least eigenvalue of products of columns, of their largest: below it is round-off [1].
_ROUND_OFF = 1e-12


@dataclass(frozen=True)
class Weighing:
    """How a posterior would weigh any residual with these products, the residual itself not yet known.

    Attributes:
        labels: (K,) term of every column.
        gauge: (K,) whether it is a fault of gauges.
        precision: (K, K) that the data give of the sizes of all columns.
        response: (K, b + K) by which a weighted pull becomes that on the columns, base numbers and trifles integrated
            out.
        pushed: (b + K, K) weighted products: what a size of a column pulls.
        noise: (b + K, b + K) root of the covariance of the weighted pull of white noise.
        trifle: (K,) standard deviation of what is always there [limits].
        least: (K,) size from which a column matters and is seen [limits].
        odds: (K,) logarithm of the prior of each column against none.
        one_sided: (K,) whether a size is at least zero.
    """

    labels: tuple[str, ...]
    gauge: NDArray[np.bool_]
    precision: Array
    response: Array
    pushed: Array
    noise: Array
    trifle: Array
    least: Array
    odds: Array
    one_sided: NDArray[np.bool_]


def prepare_weighing(
    statistics: Statistics, columns: Sequence[CandidateColumn], tolerances: Mapping[int, tuple[float, float]]
) -> Weighing:
    """Return how residuals with these products are weighed.

    Args:
        statistics: products of slopes and columns; what they say of a residual is not looked at.
        columns: of the candidates, in units of materiality.
        tolerances: of base numbers, as for `compute_posterior`.
    """
    prior, base = Prior(), statistics.base
    labels = tuple(c.label for c in columns)
    gauge = np.array([c.gauge for c in columns], bool)
    forms = {label: len({c.form for c in columns if c.label == label}) for label in labels}
    within = {(c.label, c.form): sum((o.label, o.form) == (c.label, c.form) for o in columns) for c in columns}
    terms = {c.effect: len({o.label for o in columns if o.effect == c.effect}) for c in columns}
    shares = np.array([terms[c.effect] * forms[c.label] * within[c.label, c.form] for c in columns], float)
    trifle = np.where(gauge, prior.trifle_of_gauges, prior.trifle) / np.sqrt([forms[label] for label in labels])
    weights = 1.0 / np.maximum(1.0, statistics.rows / prior.independent)
    whole = np.tensordot(weights, statistics.products, 1)
    ridge = np.concatenate([1e-6 * np.diag(whole)[:base] + 1e-9, trifle**-2.0])
    for place, (_, deviation) in tolerances.items():
        ridge[place] += deviation**-2.0
    inside = slice(base, None)
    solved = np.linalg.solve(whole + np.diag(ridge), whole[:, inside]).T
    response = np.eye(len(whole))[inside] - solved
    values, axes = np.linalg.eigh(np.tensordot(weights**2, statistics.products, 1))
    noise = axes * np.sqrt(np.where(values > _ROUND_OFF * values[-1], values, 0.0))
    shown = np.array([np.diag(left) for left in compute_left_by_base(statistics)]).max(axis=0)
    return Weighing(
        labels,
        gauge,
        whole[inside, inside] - solved @ whole[:, inside],
        response,
        whole[:, inside],
        noise,
        trifle,
        np.maximum(MATTERS, SEEN / np.sqrt(np.maximum(shown, 1e-300))),
        np.log(prior.chance / shares),
        np.array([not c.two_sided for c in columns]),
    )


def draw_pulls(weighing: Weighing, planted: int, size: float, count: int, rng: np.random.Generator) -> Array:
    """Return what twins with one effect pull on every column, (n, K).

    Args:
        weighing: of `prepare_weighing`.
        planted: place of the column that is there; it has either sign where the effect may have.
        size: of it [limits].
        count: of the twins.
        rng: generator.
    """
    sizes = weighing.trifle * rng.standard_normal((count, len(weighing.labels)))
    sizes = np.where(weighing.one_sided, np.abs(sizes), sizes)
    sign = 1.0 if weighing.one_sided[planted] else rng.choice([-1.0, 1.0], count)
    sizes[:, planted] = sign * size
    pull = sizes @ weighing.pushed.T + rng.standard_normal((count, len(weighing.noise))) @ weighing.noise.T
    return pull @ weighing.response.T


def weigh(weighing: Weighing, pulls: Array) -> dict[str, Array]:
    """Return term -> (n,) probability that it is the one that matters and is seen.

    Args:
        weighing: of `prepare_weighing`.
        pulls: (n, K) of `draw_pulls`.
    """
    prior = Prior()
    own = np.maximum(np.diag(weighing.precision), 0.0)
    worth, large = [], []
    for width, odds in zip(prior.large, np.log(prior.widths), strict=True):
        curvature = own + width**-2.0
        deviation = 1.0 / np.sqrt(curvature)
        mean, sure = pulls / curvature, pulls * deviation
        value = 0.5 * sure**2 - np.log(width * np.sqrt(curvature)) + weighing.odds + odds
        above = ndtr((mean - weighing.least) / deviation)
        below = ndtr((-mean - weighing.least) / deviation)
        inside = ndtr(mean / deviation)
        value = np.where(weighing.one_sided, value + np.log(2.0) + log_ndtr(sure), value)
        large.append(np.where(weighing.one_sided, above / np.maximum(inside, 1e-12), above + below))
        worth.append(value)
    every = np.stack(worth, axis=2)  # (n, K, widths)
    top = np.maximum(every.max(axis=(1, 2)), 0.0)
    chance = np.exp(every - top[:, None, None])
    chance /= (chance.sum(axis=(1, 2)) + np.exp(-top))[:, None, None]
    matters = np.sum(chance * np.stack(large, axis=2), axis=2)
    out: dict[str, Array] = {}
    for column, label in enumerate(weighing.labels):
        out[label] = out.get(label, 0.0) + matters[:, column]
    return out
