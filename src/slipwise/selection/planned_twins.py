"""What campaigns like one at hand would say of an effect that is there: twins drawn from sufficient statistics.

A twin is what a fit of the base would leave if one effect of a given size were there, beside small imperfections of
everything and the gauges' noise. Only its products with slopes and columns are drawn, for the posterior asks for no
more: nothing is replayed, and a thousand twins take less than a second. Each is weighed as `posterior` weighs a
campaign, with one effect at most that matters: all other sizes are integrated out, and what may take the one place is
summed over, not sampled.

    y = -X (b + u) + e,   b one column's size,   u trifles of everything,   e white, of unit variance

Source: `evidence.posterior`; Atkinson, Donev, Tobias, Optimum Experimental Designs, with SAS, 2007, chapter 20.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import log_ndtr, ndtr

from slipwise.arrays import Array
from slipwise.evidence.calibration import Calibration
from slipwise.evidence.decision import EVEN_ODDS, LISTED, compute_chance_to_matter
from slipwise.evidence.posterior import make_normal_system
from slipwise.evidence.prior import Prior, list_trifles
from slipwise.evidence.statistics import Statistics, compute_left_by_base
from slipwise.selection.columns import CandidateColumn
from slipwise.selection.inclusion import MATTERS, SEEN, Inclusion, make_evidence
from slipwise.selection.proposals import LIKELY, LIKELY_FLOORS, LIKELY_LIMITS

#: Least eigenvalue of products of columns, of their largest: below it is round-off [1].
_ROUND_OFF = 1e-12
#: By how much the limits of materiality of a rig as built and of its model differ: standard deviation, of five rigs of
#: the bench whose mass, law and springs are some percent off; median of 25 effects 0.08, largest 0.33 [logarithm].
_RIG_AS_BUILT = 0.1
#: A model is taken to be better with an effect that is there by so many standard errors [1].
_BEYOND_DOUBT = 10.0


@dataclass(frozen=True)
class TwinWeighing:
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
        worth_a_refit: (K,) size from which a model is refitted with it [limits].
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
    worth_a_refit: Array
    odds: Array
    one_sided: NDArray[np.bool_]


def prepare_weighing(
    statistics: Statistics, columns: Sequence[CandidateColumn], tolerances: Mapping[int, tuple[float, float]]
) -> TwinWeighing:
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
    trifle = list_trifles(columns)
    system = make_normal_system(statistics, tolerances, np.ones(len(statistics.rows)), trifle)
    whole, inside = system.whole, slice(base, None)
    solved = np.linalg.solve(system.regular, whole[:, inside]).T
    response = np.eye(len(whole))[inside] - solved
    weights = 1.0 / prior.compute_coarsening(statistics.rows)
    values, axes = np.linalg.eigh(np.tensordot(weights**2, statistics.products, 1))
    noise = axes * np.sqrt(np.where(values > _ROUND_OFF * values[-1], values, 0.0))
    shown = np.array([np.diag(left) for left in compute_left_by_base(statistics)]).max(axis=0)
    floor = np.sqrt(np.maximum(shown, 1e-300))  # what one limit leaves in the relation that shows it best
    return TwinWeighing(
        labels,
        gauge,
        whole[inside, inside] - solved @ whole[:, inside],
        response,
        whole[:, inside],
        noise,
        trifle,
        np.maximum(MATTERS, SEEN / floor),
        np.maximum(LIKELY_LIMITS, LIKELY_FLOORS / floor),
        np.log(prior.chance / shares),
        np.array([not c.two_sided for c in columns]),
    )


def draw_pulls(weighing: TwinWeighing, planted: int, size: float, count: int, rng: np.random.Generator) -> Array:
    """Return what twins with one effect pull on every column, (n, K).

    Args:
        weighing: of `prepare_weighing`.
        planted: place of the column that is there; it has either sign where the effect may have.
        size: of it on the rig as modelled [limits]; on the rig as built the limit lies a little off.
        count: of the twins.
        rng: generator.
    """
    sizes = weighing.trifle * rng.standard_normal((count, len(weighing.labels)))
    sizes = np.where(weighing.one_sided, np.abs(sizes), sizes)
    sign = 1.0 if weighing.one_sided[planted] else rng.choice([-1.0, 1.0], count)
    sizes[:, planted] = sign * size * np.exp(_RIG_AS_BUILT * rng.standard_normal(count))
    pull = sizes @ weighing.pushed.T + rng.standard_normal((count, len(weighing.noise))) @ weighing.noise.T
    return pull @ weighing.response.T


@dataclass(frozen=True)
class TwinEvidence:
    """What the posterior of each twin says of one term.

    Attributes:
        matters: (n,) probability that it is of `inclusion.MATTERS` limits and `SEEN` floors.
        likely: (n,) probability that it is so large that a refit would be made with it.
        spread: (n,) standard deviation of its size where it is there, over the mean [1].
    """

    matters: Array
    likely: Array
    spread: Array


def weigh(weighing: TwinWeighing, pulls: Array) -> dict[str, TwinEvidence]:
    """Return term -> what the posterior of each twin says of it.

    Args:
        weighing: of `prepare_weighing`.
        pulls: (n, K) of `draw_pulls`.
    """
    prior = Prior()
    own = np.maximum(np.diag(weighing.precision), 0.0)
    curvature = own[:, None] + np.array(prior.large) ** -2.0  # (K, widths)
    deviation = 1.0 / np.sqrt(curvature)
    mean = pulls[:, :, None] / curvature
    one_sided = weighing.one_sided[:, None]
    value = 0.5 * (mean / deviation) ** 2 - np.log(np.array(prior.large) * np.sqrt(curvature))
    value += weighing.odds[:, None] + np.log(prior.widths)
    value = np.where(one_sided, value + np.log(2.0) + log_ndtr(mean / deviation), value)
    top = np.maximum(value.max(axis=(1, 2)), 0.0)[:, None, None]
    chance = np.exp(value - top)
    chance /= chance.sum(axis=(1, 2), keepdims=True) + np.exp(-top)
    inside = np.maximum(ndtr(mean / deviation), 1e-12)

    def beyond(least: Array) -> Array:
        above, below = ndtr((mean - least[:, None]) / deviation), ndtr((-mean - least[:, None]) / deviation)
        return np.sum(chance * np.where(one_sided, above / inside, above + below), axis=2)

    matters, likely = beyond(weighing.least), beyond(weighing.worth_a_refit)
    present = np.sum(chance, axis=2)
    first, second = np.sum(chance * np.abs(mean), axis=2), np.sum(chance * (mean**2 + deviation**2), axis=2)
    out: dict[str, TwinEvidence] = {}
    for label in dict.fromkeys(weighing.labels):
        at = [k for k, other in enumerate(weighing.labels) if other == label]
        there = np.maximum(present[:, at].sum(axis=1), 1e-12)
        size, square = first[:, at].sum(axis=1) / there, second[:, at].sum(axis=1) / there
        spread = np.sqrt(np.maximum(square - size**2, 0.0)) / np.maximum(size, 1e-12)
        out[label] = TwinEvidence(matters[:, at].sum(axis=1), likely[:, at].sum(axis=1), spread)
    return out


@dataclass(frozen=True)
class TwinVerdict:
    """What would be said of each twin.

    Attributes:
        named: (n,) effect that is named; "" for none.
        listed: (n,) effect that is said to be there, whether or not it matters; "" for none.
    """

    named: tuple[str, ...]
    listed: tuple[str, ...]


def decide_twins(
    weighing: TwinWeighing, evidence: Mapping[str, TwinEvidence], effects: Mapping[str, str], chances: Calibration
) -> TwinVerdict:
    """Decide of each twin as `evidence.decision` does, of a fit that is better with the effect beyond any doubt.

    Args:
        weighing: of `prepare_weighing`.
        evidence: of `weigh`.
        effects: term -> name of its effect.
        chances: the calibration.
    """
    gauge = dict(zip(weighing.labels, weighing.gauge, strict=True))
    labels = list(evidence)
    likely = np.stack([evidence[label].likely for label in labels], axis=1)
    named, listed = [], []
    for twin, best in enumerate(likely.argmax(axis=1)):
        name = effects[labels[best]]
        own = [label for label in labels if effects[label] == name]
        matters = sum(float(evidence[label].matters[twin]) for label in own)
        spread = float(evidence[labels[best]].spread[twin])
        sure = Inclusion(matters, matters, matters, spread, 1.0, 0.0, 1.0)
        of = make_evidence(sure, lead=_BEYOND_DOUBT, gauge=bool(gauge[labels[best]]))
        tried = sum(float(evidence[label].likely[twin]) for label in own) >= LIKELY
        is_named = tried and compute_chance_to_matter(of, chances) >= EVEN_ODDS
        named.append(name if is_named else "")
        listed.append(name if is_named or (tried and chances.present(of) >= LISTED) else "")
    return TwinVerdict(tuple(named), tuple(listed))
