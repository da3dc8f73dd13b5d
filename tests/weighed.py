"""What a posterior was computed from, of made columns whose causes are known."""

from collections.abc import Mapping, Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.effects import Effect, catalogue
from slipwise.evidence.posterior import compute_posterior
from slipwise.relations.parameters import Term
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.columns import CandidateColumn
from slipwise.selection.statistics import compute_statistics
from slipwise.selection.units import Moved
from slipwise.selection.weighed_model import DRAWS, BaseNumber, WeighedModel

ROWS = 3000
#: Strength of an effect of the catalogue that stands for a made column.
STRENGTHS = {"heating": "share", "breakaway": "rise", "run_in": "rise", "guide_drag": "damping", "slide_tilt": "tilt"}


def waves(count: int, seed: int = 0) -> Array:
    """Give columns (q, count) that hardly resemble each other, of two floors each."""
    return 2.0 * np.random.default_rng(seed).standard_normal((ROWS, count))


def noise(seed: int = 9) -> Array:
    """Give noise of one floor."""
    return np.random.default_rng(seed).standard_normal(ROWS)


def column(name: str, values: Array, *, form: int = 0, unit: float = 0.02) -> CandidateColumn:
    """Give a column of an effect of the catalogue that changes the residual by one limit of materiality."""
    effect = catalogue()[name]
    neutral = float(effect.parameter(STRENGTHS[name]).neutral or 0.0)
    small = values.astype(np.float32)
    return CandidateColumn(name, name, False, form, STRENGTHS[name], {}, neutral, True, unit, small)


#: What one unit of the only number of a base model changes (q, 1).
BASE_SLOPE = waves(1, 5)


def weigh(
    left: Array,
    columns: Sequence[CandidateColumn],
    units: Mapping[tuple[str, str], Moved] | None = None,
    number: float = 1.0e4,
) -> WeighedModel:
    """Give what is kept of a base model that leaves this residual, with one number of its own and no effect in it."""
    zeros = np.zeros(ROWS, np.int64)
    rows = AveragedRows((), ("pads",), zeros, zeros, np.ones(ROWS), np.array([float(ROWS)]))
    slopes = BASE_SLOPE
    statistics = compute_statistics(rows, left, left, slopes, np.ones(1, bool), columns)
    every = np.column_stack([slopes, *(c.column for c in columns)])
    signs = np.random.default_rng(4).choice([-1.0, 1.0], size=(DRAWS, ROWS))
    redrawn = ((signs * left) @ every)[:, None]
    posterior = compute_posterior(statistics, columns, {})
    return WeighedModel(
        statistics,
        tuple(columns),
        {},
        frozenset(),
        posterior,
        np.zeros(every.shape[1]),
        redrawn,
        dict(units or {}),
        (BaseNumber("rig.mass", number, 100.0),),
    )


def terms_of(columns: Sequence[CandidateColumn]) -> list[Term]:
    """Give the candidates to which columns belong."""
    known: Mapping[str, Effect] = catalogue()
    return [Term(known[name]) for name in dict.fromkeys(c.effect for c in columns)]
