"""One posterior over the sizes of everything that may be missing.

    r = y + J d + X u + X b + e

with the averaged residual y of a fit, the slopes J of its numbers d, and the columns X of every candidate in units of
materiality. Every candidate is there as a trifle: u is normal with the deviation `Prior.trifle`, and integrated out.
Few matter beyond that: b is zero but for some places, each of which one candidate takes, at one of its forms, as large
as one of the widths `Prior.large`. Small imperfections are therefore always in the model and never named, and whatever
explains the same competes at once. A relation counts as at most `Prior.independent` samples: a model's own small errors
are systematic, and with every sample the posterior would be sure of nonsense.

The places are sampled one after the other with all sizes integrated out (collapsed Gibbs), on the products of columns
alone; a place that is taken by one of two candidates that look alike passes from one to the other in one step.

Sources: George, McCulloch (1993), JASA 88 (spike and slab); Wang et al. (2020), JRSS B 82 (a sum of single effects);
Cui et al. (2024), Nature Genetics 56:162 (a background of small causes beside few large ones); Miller, Dunson (2019),
JASA 114 (coarsened posterior).
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.evidence.prior import (
    OF_MODEL,
    ColumnGroups,
    Competing,
    Ints,
    Prior,
    compute_log_odds,
    group_columns,
    list_trifles,
)
from slipwise.evidence.sampler import sample_places
from slipwise.evidence.statistics import Statistics, compute_left_by_base
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class Posterior:
    """Samples of what matters.

    Attributes:
        labels: (T,) of the terms.
        effects: (T,) names of their effects.
        sizes: (n, T) size of every term [limits of materiality]; 0 where it is no more than a trifle.
        seen: (n, T) what a fit of the base would leave of it in the relation that shows it best [floors].
        forms: (n, T) number of the form; -1 where it is no more than a trifle.
        strengths: (n, K) size of every column [limits].
        level: (r,) what is left of every relation [noise variance].
        gain: (K,) what each column would explain beside the mean of all others [nats].
        alone: (K,) what it would explain if nothing else were more than a trifle [nats].
    """

    labels: tuple[str, ...]
    effects: tuple[str, ...]
    sizes: Array
    seen: Array
    forms: Ints
    strengths: Array
    level: Array
    gain: Array
    alone: Array


@dataclass(frozen=True)
class Effort:
    """How thoroughly a posterior is sampled.

    Attributes:
        chains: that begin apart, half of them with what is in the model.
        sweeps: of each.
        draws: of the sizes.
        rounds: how often what is left of a relation is estimated.
    """

    chains: int = 6
    sweeps: int = 60
    draws: int = 1600
    rounds: int = 3


#: For what is looked at on the way.
QUICK = Effort(chains=2, sweeps=30, draws=150, rounds=2)
#: For an estimate of what is left of a relation.
_ON_THE_WAY = Effort(chains=2, sweeps=15, draws=60)


def compute_posterior(
    statistics: Statistics,
    columns: Sequence[Competing],
    tolerances: Mapping[int, tuple[float, float]],
    apart: Collection[tuple[str, str]] = (),
    effort: Effort | None = None,
) -> Posterior:
    """Sample what is missing.

    What chains that begin apart have visited is weighed by its posterior, which is known up to a constant: no chain
    needs to pass from one explanation to another that shares nothing with it (Clyde, Ghosh, Littman 2011, Journal of
    Computational and Graphical Statistics 20).

    Args:
        statistics: products of residual, slopes and columns.
        columns: of the candidates, in units of materiality.
        tolerances: place of a base number -> how far its rated value lies from the fitted one, and its standard
            deviation about that [its scale].
        apart: labels of terms that cannot be in one model, in both orders.
        effort: how thoroughly it is sampled.
    """
    prior, effort = Prior(), effort or Effort()
    places = _prepare_places(columns, apart)
    trifle = list_trifles(columns)
    inside = slice(statistics.base, None)
    counts = np.maximum(statistics.rows, 1.0)
    level = np.maximum(statistics.fitted / counts, prior.floor)
    for remaining in reversed(range(effort.rounds)):
        last = not remaining
        system = make_normal_system(statistics, tolerances, level, trifle)
        whole, pull = system.whole, system.pull
        solved = np.linalg.solve(system.regular, np.column_stack([whole[:, inside], pull]))
        precision = np.ascontiguousarray(whole[inside, inside] - whole[inside] @ solved[:, :-1])
        pulled = pull[inside] - whole[inside] @ solved[:, -1]
        taken, sizes = _sample(places, precision, pulled, effort if last else _ON_THE_WAY)
        mean = sizes.mean(axis=0)
        everything = solved[:, -1] - solved[:, :-1] @ mean
        everything[inside] += mean
        if last:
            break
        left = statistics.squares + 2.0 * statistics.pulls @ everything
        left += np.einsum("i,kij,j->k", everything, statistics.products, everything)
        level = np.maximum(left / counts, prior.floor)
    own = np.maximum(np.diag(precision), 1e-12)
    mean = sizes.mean(axis=0)
    gain, alone = (0.5 * pull**2 / own for pull in (pulled - precision @ mean + own * mean, pulled))
    return _as_posterior(statistics, places.forms, taken, sizes, level, gain, alone)


@dataclass(frozen=True)
class _Places:
    """What may take a place, before any data."""

    forms: ColumnGroups
    odds: Array
    excludes: NDArray[np.bool_]
    one_sided: NDArray[np.bool_]
    as_fitted: Ints


def _prepare_places(columns: Sequence[Competing], apart: Collection[tuple[str, str]]) -> _Places:
    prior, forms = Prior(), group_columns(columns)
    odds = compute_log_odds(forms, columns)
    excludes = np.eye(len(forms.labels), dtype=np.bool_)
    for one, other in apart:
        if one in forms.labels and other in forms.labels:
            excludes[forms.labels.index(one), forms.labels.index(other)] = True
    one_sided = np.array([not c.two_sided for c in columns])
    as_fitted = np.full(prior.places, -1)
    present = np.flatnonzero(forms.number == OF_MODEL)[: prior.places]
    as_fitted[: len(present)] = present
    return _Places(forms, odds, excludes, one_sided, as_fitted)


def sample_large_sizes(
    precision: Array, pulled: Array, columns: Sequence[Competing], apart: Collection[tuple[str, str]] = ()
) -> Array:
    """Sample the sizes (n, K) of what is more than a trifle; 0 where a column is none [limits].

    Args:
        precision: (K, K) that data give of the sizes of all columns, numbers and trifles integrated out.
        pulled: (K,) pull of the data on them.
        columns: of the candidates, in units of materiality.
        apart: labels of terms that cannot be in one model, in both orders.
    """
    return _sample(_prepare_places(columns, apart), np.ascontiguousarray(precision), pulled, Effort())[1]


def _sample(places: _Places, precision: Array, pulled: Array, effort: Effort) -> tuple[Ints, Array]:
    """Return forms of the places (n, p), and sizes (n, K)."""
    prior, forms = Prior(), places.forms
    widths, odds_of = np.array(prior.large), np.log(prior.widths)
    none = np.full(prior.places, -1)
    visited = [
        sample_places(
            precision, pulled, forms.columns, forms.length, forms.owner, places.excludes, places.odds, widths, odds_of,
            places.one_sided, places.as_fitted if chain % 2 == 0 else none, effort.sweeps, chain,
        )
        for chain in range(effort.chains)
    ]  # fmt: skip
    return _draw(precision, pulled, forms, widths, places.one_sided, visited, effort.draws)


@dataclass(frozen=True)
class NormalSystem:
    """What data and prior say of base numbers and trifles where nothing matters beside them.

    Attributes:
        whole: (k, k) precision that the data give.
        regular: (k, k) the same with that of the prior.
        pull: (k,) of the data.
    """

    whole: Array
    regular: Array
    pull: Array


def make_normal_system(
    statistics: Statistics, tolerances: Mapping[int, tuple[float, float]], level: Array, trifle: Array
) -> NormalSystem:
    """Weigh the products of all relations.

    Args:
        statistics: products of residual, slopes and columns.
        tolerances: as of `compute_posterior`.
        level: (r,) what is left of every relation [noise variance].
        trifle: (K,) of `list_trifles`.
    """
    base = statistics.base
    weights = 1.0 / (level * Prior().compute_coarsening(statistics.rows))
    whole = np.tensordot(weights, statistics.products, 1)
    pull = -weights @ statistics.pulls
    ridge = np.concatenate([1e-6 * np.diag(whole)[:base] + 1e-9, trifle**-2.0])
    for place, (off, deviation) in tolerances.items():
        ridge[place] += deviation**-2.0
        pull[place] += off * deviation**-2.0
    return NormalSystem(whole, whole + np.diag(ridge), pull)


def _draw(
    precision: Array, pulled: Array, forms: ColumnGroups, widths: Array, one_sided: NDArray[np.bool_],
    visited: Sequence[tuple[Ints, Ints, Array]], draws: int,
) -> tuple[Ints, Array]:  # fmt: skip
    """Draw from what was visited, each once, by its posterior: forms of the places (n, p), and sizes (n, K)."""
    taken, width, worth = (np.concatenate(parts) for parts in zip(*visited, strict=True))
    code = np.sort(np.where(taken >= 0, taken * len(widths) + width, -1), axis=1)
    states, first = np.unique(code, axis=0, return_index=True)
    chance = np.exp(worth[first] - worth[first].max())
    rng = np.random.default_rng(0)
    picked = rng.choice(len(states), size=draws, p=chance / chance.sum())
    sizes = np.zeros((draws, len(pulled)))
    for state in np.unique(picked):
        at = np.flatnonzero(picked == state)
        own = states[state][states[state] >= 0]
        members = [
            (j, widths[c % len(widths)])
            for c in own
            for j in forms.columns[c // len(widths)][: forms.length[c // len(widths)]]
        ]
        if not members:
            continue
        j = np.array([m[0] for m in members])
        known = precision[np.ix_(j, j)] + np.diag([m[1] ** -2.0 for m in members])
        curvatures, axes = np.linalg.eigh(0.5 * (known + known.T))
        curvatures = np.maximum(curvatures, widths[-1] ** -2.0)  # what the data say of nothing is round-off
        middle = axes @ ((axes.T @ pulled[j]) / curvatures)
        found = middle + rng.standard_normal((len(at), len(j))) @ (axes / np.sqrt(curvatures)).T
        sizes[np.ix_(at, j)] = np.where(one_sided[j], np.maximum(found, 0.0), found)
    return np.where(states[picked] >= 0, states[picked] // len(widths), -1), sizes


def _as_posterior(
    statistics: Statistics, forms: ColumnGroups, taken: Ints, sizes: Array, level: Array, gain: Array, alone: Array
) -> Posterior:
    shape = len(taken), len(forms.labels)
    size, seen = np.zeros(shape), np.zeros(shape)
    chosen = np.full(shape, -1)
    rest = compute_left_by_base(statistics)
    for f in np.unique(taken[taken >= 0]):
        at = np.flatnonzero((taken == f).any(axis=1))
        members = forms.columns[f, : forms.length[f]]
        b = sizes[np.ix_(at, members)]
        t = forms.owner[f]
        size[at, t] = np.sqrt(np.sum(b**2, axis=1))
        squares = np.einsum("si,kij,sj->sk", b, rest[:, members][:, :, members], b)
        seen[at, t] = np.sqrt(np.maximum(squares.max(axis=1), 0.0))
        chosen[at, t] = forms.number[f]
    return Posterior(forms.labels, forms.effects, size, seen, chosen, sizes, level, gain, alone)
