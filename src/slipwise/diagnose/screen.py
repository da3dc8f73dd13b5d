"""Screening: what each candidate could explain of the base fit's residual, without a simulation.

Every candidate is put into every relation it touches, at a small size, with its shape constants on a small grid; the
change of the residual is its column. What the base parameters could do is projected out (Frisch, Waugh 1933; Lovell
1963), limits of sign are kept, and the drop of the squared residual is the score (Rao 1948).
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise.effects import Effect
from slipwise.errors import SlipwiseError
from slipwise.fit.base import BaseFit
from slipwise.fit.terms import Term
from slipwise.params import Parameter

Array = NDArray[np.float64]
#: Size at which a column is taken, as a share of the typical size.
_SMALL = 0.3
#: Step of a slope, as a share of the value.
_NEAR = 0.01
#: Most points of the grid over shape constants.
_MOST_POINTS = 5
#: Multiples of a constant's typical value that are tried: a fit that begins a decade off ends in a valley of its own.
_NEARBY = (0.33, 1.0, 3.0)
_FAR = (0.035, 0.2, 1.0, 5.0, 28.0)
#: A constant whose bounds are this far apart may be far from typical [1].
_WIDE = 100.0
#: Frequencies at which a resonance is tried [Hz].
_LEAST_HERTZ, _MOST_HERTZ, _RESONANCES = 5.0, 30.0, 14
#: A resonance is tried with this many times its typical damping, so that it is seen from a neighbouring frequency.
_BROAD = 3.0


@dataclass(frozen=True)
class Screened:
    """A candidate's column.

    Attributes:
        term: the candidate.
        values: of its parameters where the score is best.
        gain: drop of the squared residual of the fitted runs.
        absorbed: part of the candidate's own effect that base parameters could mimic [1].
        column: (m,) of unit length, base projected out, pointing the way that helps.
        length: of the step that the score asks for, before it was brought to unit length.
    """

    term: Term
    values: dict[str, float]
    gain: float
    absorbed: float
    column: Array
    length: float


def strengths(effect: Effect) -> list[Parameter]:
    """Give the parameters that are zero when the effect is absent."""
    return [p for p in effect.parameters if p.neutral is not None]


def screen(base: BaseFit, terms: list[Term], progress: Callable[[float], None] | None = None) -> list[Screened]:
    """Screen candidates against the base fit; best first.

    Args:
        base: the base fit.
        terms: candidates.
        progress: called with the share done.
    """
    project = projector(base.solution.jacobian)
    left = base.solution.residuals.stacked(base.problem.fitted, base.problem.relations)
    residual = project(left)
    out: list[Screened] = []
    for i, term in enumerate(terms):
        found = _screened(base, term, left, residual, project)
        if found is not None:
            out.append(found)
        if progress:
            progress((i + 1) / len(terms))
    return sorted(out, key=lambda s: -s.gain)


def projector(jacobian: Array) -> Callable[[Array], Array]:
    """Give the projection away from the columns (m, k) of a Jacobian."""
    scale = np.sqrt(np.einsum("ij,ij->j", jacobian, jacobian))
    kept = jacobian[:, scale > 0.0] / scale[scale > 0.0]
    basis, triangle = np.linalg.qr(kept)
    basis = basis[:, np.abs(np.diag(triangle)) > 1e-9]
    return lambda v: v - basis @ (basis.T @ v)


def _screened(
    base: BaseFit, term: Term, left: Array, residual: Array, project: Callable[[Array], Array]
) -> Screened | None:
    if not strengths(term.effect):
        return _replacing(base, term, residual, project)
    best: Screened | None = None
    for shape in shapes(term.effect):
        columns, starts, raw = [], [], 0.0
        for moved in strengths(term.effect):
            start = _at(term.effect, shape, moved)
            column = _column(base, term, moved, start, left)
            if column is None:
                continue
            clean = project(column)
            whole, rest = float(column @ column), float(clean @ clean)
            if rest < 1e-9 * whole or whole == 0.0:
                continue
            columns.append(clean)
            starts.append((moved, start))
            raw += whole
        if not columns:
            continue
        found = _best_mix(term, shape, columns, starts, residual, raw)
        if found is not None and (best is None or found.gain > best.gain):
            best = found
    return best


def _replacing(base: BaseFit, term: Term, residual: Array, project: Callable[[Array], Array]) -> Screened | None:
    """Score a law that takes another's place: it is never absent, so a step of a fit from typical values tells."""
    values = term.effect.typical()
    there = _residual(base, term, values)
    if there is None:
        return None
    columns = []
    for p in term.effect.parameters:
        moved = _residual(base, term, {**values, p.name: values[p.name] * (1.0 + _NEAR)})
        if moved is not None:
            columns.append(project(moved - there))
    rest = project(there)
    basis = np.linalg.qr(np.stack(columns, axis=1))[0]
    rest = rest - basis @ (basis.T @ rest)
    return _scored(term, values, residual, rest - residual, 0.0)


def _scored(term: Term, values: dict[str, float], residual: Array, step: Array, absorbed: float) -> Screened | None:
    """Score what a step makes of the residual; None for no step at all."""
    length = float(np.sqrt(step @ step))
    if length == 0.0:
        return None
    gain = float(residual @ residual - (residual + step) @ (residual + step))
    # Hundreds of columns are kept: four bytes a number are enough to compare them.
    column: Any = (step / length).astype(np.float32)
    return Screened(term, values, gain, absorbed, column, length)


def _best_mix(
    term: Term, shape: Mapping[str, float], columns: list[Array], starts: list, residual: Array, raw: float
) -> Screened | None:
    """Fit the strengths within their limits of sign."""
    matrix = np.stack(columns, axis=1)
    kept = list(range(len(columns)))
    while kept:
        part = matrix[:, kept]
        amounts = -np.linalg.lstsq(part.T @ part, part.T @ residual, rcond=1e-10)[0]
        bad = [k for k, a in zip(kept, amounts, strict=True) if a < 0.0 and not _two_sided(starts[k][0])]
        if not bad:
            break
        kept = [k for k in kept if k not in bad]
    if not kept:
        return None
    step = matrix[:, kept] @ amounts
    values = {**term.effect.neutral(), **shape}
    for k, amount in zip(kept, amounts, strict=True):
        p, start = starts[k]
        off = float(p.neutral or 0.0)
        values[p.name] = float(np.clip(off + amount * (start[p.name] - off), p.low, p.high))
    clean = float(sum(c @ c for c in columns))
    return _scored(term, values, residual, step, 1.0 - clean / raw)


def _two_sided(p: Parameter) -> bool:
    return p.low < float(p.neutral or 0.0) < p.high


def _at(effect: Effect, shape: Mapping[str, float], moved: Parameter) -> dict[str, float]:
    """Give an effect's values with one strength at a small size, the others absent."""
    values = {**effect.neutral(), **shape}
    off = float(moved.neutral or 0.0)
    typical = moved.typical if moved.typical != off else _like_others(effect, moved)
    values[moved.name] = float(np.clip(off + _SMALL * (typical - off), moved.low, moved.high))
    return values


def _like_others(effect: Effect, moved: Parameter) -> float:
    """Give a typical size for a strength that is usually absent: that of its siblings of the same unit."""
    for p in strengths(effect):
        if p.unit == moved.unit and p.typical != p.neutral:
            return p.typical
    return float(moved.neutral or 0.0) + 0.2 * (moved.high - float(moved.neutral or 0.0))


def _column(base: BaseFit, term: Term, moved: Parameter, values: dict[str, float], left: Array) -> Array | None:
    """Give the change of the residual.

    Undoing a fault moves noise about, and half way between moved and unmoved noise there is less of it: a column that
    looked one way only would find a false gain. Both ways together do not.
    """
    there = _residual(base, term, values)
    if there is None:
        return None
    off = float(moved.neutral or 0.0)
    back = 2.0 * off - values[moved.name]
    if term.effect.port == "gauge" and moved.low <= back <= moved.high:
        other = _residual(base, term, {**values, moved.name: back})
        return None if other is None else 0.5 * (there - other)
    return there - left


def _residual(base: BaseFit, term: Term, values: Mapping[str, float]) -> Array | None:
    problem = base.problem.adding(term)
    keyed = {f"{term.label}.{k}": v for k, v in values.items()}
    try:
        found = problem.residuals({**base.solution.values, **keyed}, fitted_only=True)
    except SlipwiseError:
        return None
    stacked = found.stacked(problem.fitted, problem.relations)
    return stacked if np.isfinite(stacked).all() else None


def shapes(effect: Effect) -> list[dict[str, float]]:
    """Give a small grid over the constants that switch nothing: typical, and some multiples of it."""
    if effect.port == "gauge":  # the form of a gauge's fault hardly changes its column, but for a sign; refits free it
        typical = {p.name: p.typical for p in effect.parameters if p.neutral is None}
        either = [p for p in effect.parameters if p.neutral is None and p.low < 0.0 < p.high and p.typical != 0.0]
        return [typical, *({**typical, p.name: -p.typical} for p in either)]
    axes = []
    for p in effect.parameters:
        if p.neutral is not None:
            continue
        if p.typical == 0.0:
            points = [0.0]
        elif p.unit == "Hz":  # a resonance is found only from nearby
            points = [float(x) for x in np.geomspace(max(p.low, _LEAST_HERTZ), min(p.high, _MOST_HERTZ), _RESONANCES)]
        elif p.low < 0.0 < p.high:
            points = [p.typical * f for f in (1.0, -1.0, 0.3, -0.3)]
        else:
            factors = _FAR if p.low > 0.0 and p.high > _WIDE * p.low else _NEARBY
            points = sorted({float(np.clip(p.typical * f, p.low, p.high)) for f in factors})
        axes.append((p.name, points, p.typical))
    if not axes:
        return [{}]
    whole = [dict(zip([a[0] for a in axes], c, strict=True)) for c in product(*(a[1] for a in axes))]
    if len(whole) <= _MOST_POINTS:
        return whole
    broad = _BROAD if any(p.unit == "Hz" and p.neutral is None for p in effect.parameters) else 1.0
    highest = {p.name: p.high for p in effect.parameters}
    centre = {a[0]: min(broad * a[2], highest[a[0]]) if a[2] > 0.0 else a[2] for a in axes}
    return [centre, *({**centre, name: x} for name, points, middle in axes for x in points if x != middle)]
