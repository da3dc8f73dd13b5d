"""What the last posterior of a campaign was computed from, without the columns themselves, and its noise drawn again.

Products of columns are all that a posterior asks for: what it would have said of another residual, of this model's
noise with one more effect in it, needs no column and no replay.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from slipwise.arrays import Array
from slipwise.evidence.posterior import Posterior
from slipwise.evidence.statistics import Statistics, compute_left_by_base
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.columns import CandidateColumn
from slipwise.selection.linearisation import Linearisation
from slipwise.selection.units import Moved
from slipwise.short_repr import short_repr

#: Stretches of a series whose residual changes sign together, and how many times noise is drawn.
_STRETCHES, DRAWS = 16, 20


@dataclass(frozen=True)
class BaseNumber:
    """A number that is fitted whatever is missing.

    Attributes:
        key: "rig.mass", "shear_rate.rate" ...
        value: as it was fitted [SI].
        scale: one unit of its slope in the products [SI].
    """

    key: str
    value: float
    scale: float


@short_repr
@dataclass(frozen=True)
class WeighedModel:
    """A final model with everything beside it, as products.

    Attributes:
        statistics: products of residual, slopes and columns.
        columns: of candidates, then those of the model's own effects, without what they change.
        tolerances: of the numbers that are fitted, as of `compute_posterior`.
        apart: labels of terms that cannot be in one model, in both orders.
        posterior: over all this.
        own: (k,) sizes of the model's own effects as they were fitted, 0 for all else: by minus this the residual
            without them differs from that of the fit [limits].
        noise: (d, r, k) products of columns with the residual of the fit, drawn again.
        units: (label, strength) of a candidate -> what some size of it moves.
        numbers: that stand before the columns in the products.
        planted: so many of the first columns are put into twins only; no posterior looks for them.
    """

    statistics: Statistics
    columns: tuple[CandidateColumn, ...]
    tolerances: Mapping[int, tuple[float, float]]
    apart: frozenset[tuple[str, str]]
    posterior: Posterior
    own: Array
    noise: Array
    units: Mapping[tuple[str, str], Moved]
    numbers: tuple[BaseNumber, ...]
    planted: int = 0

    @cached_property
    def left_by_base(self) -> Array:
        """What a fit of the base numbers leaves of the products of columns, (r, K, K), a judged sample each."""
        return compute_left_by_base(self.statistics)


def keep_weighed_model(
    here: Linearisation,
    posterior: Posterior,
    units: Mapping[tuple[str, str], Moved],
    apart: frozenset[tuple[str, str]],
    planted: int = 0,
) -> WeighedModel:
    """Keep of a linearisation and its posterior what later questions need.

    Args:
        here: the last linearisation.
        posterior: at it.
        units: of `compute_units`.
        apart: labels of terms that cannot be in one model, in both orders.
        planted: so many of the first columns are put into twins only.
    """
    own = np.zeros(here.statistics.products.shape[1])
    own[len(own) - len(here.own) :] = [1.0 / c.unit for c in here.own]
    signs = _draw_signs(here.rows)
    noise = np.empty((len(signs), *here.statistics.pulls.shape))
    every = np.column_stack([here.slopes.astype(np.float32), *(c.column for c in here.columns)])
    for k in range(len(here.rows.relations)):
        at = np.flatnonzero(here.rows.relation == k)
        noise[:, k] = (signs[:, at] * here.fitted[at]).astype(np.float32) @ every[at]
    bare = tuple(replace(c, column=np.zeros(0, np.float32)) for c in here.columns)
    solution = here.hypothesis.solution
    numbers = tuple(BaseNumber(f.key, solution.values[f.key], f.scale) for f in here.numbers)
    return WeighedModel(here.statistics, bare, here.tolerances, apart, posterior, own, noise, units, numbers, planted)


def _draw_signs(rows: AveragedRows) -> Array:
    """Return signs (d, q) that turn a residual round, stretch by stretch: what is correlated in it stays so.

    Source: Liu (1988), Annals of Statistics 16 (wild bootstrap); Shao (2010), JASA 105 (in blocks).
    """
    rng = np.random.default_rng(0)
    out: list[Array] = []
    for series in rows.series:
        count = len(series.edges)
        stretch = np.arange(count) * _STRETCHES // max(count, 1)
        out.append(rng.choice([-1.0, 1.0], size=(DRAWS, _STRETCHES))[:, stretch])
    return np.concatenate([np.zeros((DRAWS, 0)), *out], axis=1)
