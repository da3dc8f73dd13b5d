"""Which faults stand: one posterior in which all faults of gauges and all disturbances of the balances compete.

It is the posterior of a diagnosis, over balances that need no law of friction. Small faults of every gauge are always
in it; few faults matter, and what matters is a fault's least size. What is likely is taken out of the records with its
fitted size, and its column is taken again there.
"""

from collections import Counter
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.evidence.posterior import Effort, Posterior, compute_posterior
from slipwise.evidence.statistics import compute_left_by_base
from slipwise.instruments.balances_case import Case, Point, start
from slipwise.instruments.disturbances import alternatives
from slipwise.instruments.fault_columns import label_of
from slipwise.instruments.linearised_balances import LinearBalances, linearise, linearise_base
from slipwise.instruments.size_fit import SizeFit, compute_gain, fit_sizes

#: Likelier than this to be more than a trifle: it is taken out of the records; its column is taken again.
_LIKELY, _TAKEN_AGAIN = 0.2, 0.05
#: A delay is named in the place of a filter that explains more, unless it is less likely than this beside it.
_UNLIKELY = 0.05
#: On the way: many chains, for of two faults that explain the same each finds but one.
_QUICK = Effort(chains=6, sweeps=20, draws=200, rounds=2)
#: A lag that would explain so much is tried at these sizes [nats, least sizes].
_WORTH_A_LOOK, _FULL_SIZES = 0.5, (-20.0, -12.5, -8.0, -5.0, 5.0, 8.0, 12.5, 20.0)
#: Columns whose cosine is more than this are one column [1].
_ALIKE = 0.999
#: Linearisations at most, and the change of a size at which no further one is needed [1].
_ROUNDS, _RESTED = 4, 0.05


@dataclass(frozen=True)
class FaultPosterior:
    """What the balances say of all faults.

    Attributes:
        first: fit of the rig's constants alone.
        last: fit with what is likely.
        posterior: over all candidates.
        shown: (n, T) what a fit of the constants leaves of every term in the balance that may accuse and shows it
            best [floors].
    """

    first: SizeFit
    last: SizeFit
    posterior: Posterior
    shown: Array

    @property
    def linear(self) -> LinearBalances:
        """The last linearisation."""
        return self.last.linear


def fit_base(case: Case) -> SizeFit:
    """Fit the constants of the rig alone; noise is that of the balances with these constants."""
    begun = fit_sizes(linearise_base(case, start(case)), [])
    return fit_sizes(linearise_base(case, begun.point), [])


def compute_fault_posterior(case: Case, first: SizeFit) -> FaultPosterior:
    """Return what the balances say of all faults.

    Args:
        case: what is judged.
        first: its fit of constants alone.
    """
    physics = alternatives(case.runs, case.relations, case.effects, case.specimen)
    linear = linearise(case, first.point, physics)
    late = _list_late(linear)
    if late:  # before anything is taken out: what stands first would keep its place
        linear = linearise(case, first.point, physics, linear, late)
    for _ in range(_ROUNDS):
        apart = _list_alike(linear)
        quick = compute_posterior(linear.statistics, linear.columns, linear.tolerances, apart, _QUICK)
        point = fit_sizes(linear, choose_likely(linear, quick)).point
        if _is_near(linear.point, point):
            break
        in_place = {label_of(suspect): (size / suspect.least,) for suspect, size in linear.point.sizes}
        linear = linearise(case, point, physics, linear, _sizes(linear, quick) | in_place)
    posterior = compute_posterior(linear.statistics, linear.columns, linear.tolerances, _list_alike(linear))
    last = fit_sizes(linear, choose_likely(linear, posterior))
    return FaultPosterior(first, last, posterior, _shown(case, linear, posterior))


def _list_alike(linear: LinearBalances) -> set[tuple[str, str]]:
    """Return the pairs of candidates that do the same in these balances, in both orders: only one of them is there."""
    inside = slice(linear.statistics.base, None)
    products = np.tensordot(linear.statistics.rows.clip(1.0) ** -1.0, linear.statistics.products, 1)[inside, inside]
    length = np.sqrt(np.maximum(np.diag(products), 1e-300))
    alike = np.argwhere(np.abs(products) > _ALIKE * np.outer(length, length))
    labels = [c.label for c in linear.columns]
    return {(labels[i], labels[j]) for i, j in alike if labels[i] != labels[j]}


def _list_late(linear: LinearBalances) -> dict[str, tuple[float, ...]]:
    """Return the label of each lag that would explain something -> sizes at which its column is taken [least sizes].

    What a gauge does that lags by a third of a period is not told by a small lag.
    """
    alone = fit_sizes(linear, [])
    return {
        c.label: _FULL_SIZES
        for i, c in enumerate(linear.columns)
        if c.suspect is not None and c.suspect.unit == "s" and compute_gain(alone, i) > _WORTH_A_LOOK
    }


def _sizes(linear: LinearBalances, posterior: Posterior) -> dict[str, tuple[float, ...]]:
    """Return the label of each fault that may be more than a trifle -> its size where it is [least sizes]."""
    found: dict[str, tuple[float, ...]] = {}
    for t, label in enumerate(posterior.labels):
        at = posterior.forms[:, t] != -1
        own = [i for i, c in enumerate(linear.columns) if c.label == label and c.gauge]
        if own and np.mean(at) > _TAKEN_AGAIN:
            found[label] = (float(posterior.strengths[np.ix_(at, own)].sum(axis=1).mean()),)
    return {label: size for label, size in found.items() if size[0]}


def choose_likely(linear: LinearBalances, posterior: Posterior) -> list[int]:
    """Return the numbers of the columns of what is drawn together most often, without what is unlikely in it."""
    chance = np.mean(posterior.forms != -1, axis=0)
    kept = np.where(chance > _LIKELY, posterior.forms, -1)
    often = Counter(map(tuple, kept.tolist())).most_common(1)[0][0]
    at = {(posterior.labels[t], plain_form(linear, posterior, t)) for t, form in enumerate(often) if form >= 0}
    return [i for i, c in enumerate(linear.columns) if (c.label, c.form) in at]


def plain_form(linear: LinearBalances, posterior: Posterior, term: int) -> int:
    """Return the likeliest form of a term: a delay in the place of a filter, unless it is unlikely beside it."""
    there = posterior.forms[:, term]
    forms, counts = np.unique(there[there != -1], return_counts=True)
    share = dict(zip(forms.tolist(), (counts / counts.sum()).tolist(), strict=True))
    best = max(share, key=lambda form: share[form])
    own = {c.form: c.suspect for c in linear.columns if c.label == posterior.labels[term]}
    suspect = own[best]
    if suspect is None or not suspect.effect.plainer:
        return best
    plain = [form for form, s in own.items() if s is not None and not s.effect.plainer]
    likeliest = max(plain, key=lambda form: share.get(form, 0.0), default=best)
    return likeliest if share.get(likeliest, 0.0) > _UNLIKELY else best


def _is_near(before: Point, after: Point) -> bool:
    was, now = ({s.key: z / s.least for s, z in point.sizes} for point in (before, after))
    return was.keys() == now.keys() and all(abs(z - was[k]) < _RESTED * max(1.0, abs(z)) for k, z in now.items())


def _shown(case: Case, linear: LinearBalances, posterior: Posterior) -> Array:
    """Return what the constants leave of every term in the balance that may accuse and shows it best, (n, T)."""
    accuses = {r.name for r in case.relations if r.accuses}
    rest = compute_left_by_base(linear.statistics)[[name in accuses for name in linear.relations]]
    out = np.zeros_like(posterior.sizes)
    for t, label in enumerate(posterior.labels):
        for form in np.unique(posterior.forms[:, t][posterior.forms[:, t] != -1]):
            at = np.flatnonzero(posterior.forms[:, t] == form)
            own = np.array(linear.list_places(label, int(form)))
            b = posterior.strengths[np.ix_(at, own)]
            squares = np.einsum("si,kij,sj->sk", b, rest[:, own][:, :, own], b)
            out[at, t] = np.sqrt(np.maximum(squares.max(axis=1, initial=0.0), 0.0))
    return out
