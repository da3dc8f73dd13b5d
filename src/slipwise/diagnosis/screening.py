"""Screening: what each candidate could explain of the base fit's residual, without a simulation.

Every candidate is put into every relation it touches, at a small size, with its shape constants on a small grid; the
change of the residual is its column. What the base parameters could do is projected out (Frisch, Waugh 1933; Lovell
1963), limits of sign are kept, and the drop of the squared residual is the score (Rao 1948).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.diagnosis.initial_grid import shapes, strengths, two_sided
from slipwise.diagnosis.nonlinear_screening import MIN_GAIN, at_full_size
from slipwise.diagnosis.row_subset import on_screen
from slipwise.diagnosis.sensitivities import compute_column, compute_residual_with, small
from slipwise.estimation.base_fit import BaseFit
from slipwise.jobs.parallel import on_every_core
from slipwise.params import Parameter
from slipwise.regression.projection import make_projector
from slipwise.relations.parameters import Term

#: A column is taken anew where the strength that was found is this many times the one at which it was taken, so often,
#: and where the candidate explains at least `MIN_GAIN`.
_FAR_BEYOND, _ROUNDS = 2.5, 2
#: Step of a slope, as a share of the value.
_NEAR = 0.01


@dataclass(frozen=True)
class Screened:
    """A candidate's column.

    Attributes:
        term: the candidate.
        values: of its parameters where the score is best.
        gain: drop of the squared residual of the fitted runs; 0 where the strength has the wrong sign.
        absorbed: part of the candidate's own effect that base parameters could mimic [1].
        column: (q,) of unit length on the screened rows, base projected out, pointing the way that helps.
        length: of the step that the score asks for, before it was brought to unit length.
    """

    term: Term
    values: dict[str, float]
    gain: float
    absorbed: float
    column: Array
    length: float


def screen(base: BaseFit, terms: Sequence[Term], progress: Callable[[float], None] | None = None) -> list[Screened]:
    """Screen candidates against the base fit; best first.

    Args:
        base: the base fit.
        terms: candidates.
        progress: called with the share done.
    """
    left, project = _screened_base(base)
    residual = project(left)
    out: list[Screened] = []
    terms = sorted(terms, key=lambda t: -len(shapes(t.effect)))  # what takes longest first, or one core waits for it
    answers = on_every_core(lambda i: _numbers(_screened(base, terms[i], left, residual, project)), len(terms))
    for i, found in enumerate(answers):
        if found is not None:
            out.append(Screened(terms[i], **found))
        if progress:
            progress((i + 1) / len(terms))
    return sorted(out, key=lambda s: -s.gain)


def _screened_base(base: BaseFit) -> tuple[Array, Callable[[Array], Array]]:
    """Return the screened residual (q,) of a base fit, and the projection away from what its numbers can do."""
    objective, solution = base.objective, base.solution
    left = on_screen(objective, solution.residuals.stacked(objective.fitted))
    return left, make_projector(on_screen(objective, solution.inside))


def _numbers(found: Screened | None) -> dict[str, Any] | None:
    """Return a candidate's column without its term, whose functions cannot be sent from one process to another."""
    return None if found is None else {k: v for k, v in vars(found).items() if k != "term"}


def screen_shapes(base: BaseFit, term: Term, grid: list[dict[str, float]]) -> list[Screened]:
    """Screen one candidate at every point of a grid over its shape constants; best first.

    Args:
        base: a fit without the candidate.
        term: the candidate.
        grid: values of its shape constants.
    """
    left, project = _screened_base(base)
    residual = project(left)
    found = on_every_core(
        lambda i: [_numbers(s) for s in _at_shapes(base, term, grid[i : i + 1], left, residual, project)], len(grid)
    )
    return sorted((Screened(term, **s) for of in found for s in of if s), key=lambda s: -s.gain)


def _screened(
    base: BaseFit, term: Term, left: Array, residual: Array, project: Callable[[Array], Array]
) -> Screened | None:
    if not strengths(term.effect):
        return _replacing(base, term, left, residual, project)
    return _better(*_at_shapes(base, term, shapes(term.effect), left, residual, project))


def _at_shapes(
    base: BaseFit, term: Term, grid: list[dict[str, float]], left: Array | None, residual: Array,
    project: Callable[[Array], Array],
) -> list[Screened]:  # fmt: skip
    """Return what a candidate could explain at every point of a grid where it can be evaluated."""
    objective = base.objective
    adds_yaw = objective.adding(term).makes_yaw != objective.makes_yaw
    if adds_yaw:  # yaw that is made from measured forces is noise as well
        left = compute_residual_with(base, term, term.effect.neutral())
    out: list[Screened] = []
    for shape in grid:
        starts = [(p, small(term.effect, shape, p)) for p in strengths(term.effect)]
        found = _mixed(base, term, shape, starts, left, residual, project)
        for _ in range(_ROUNDS):
            if found is None or found.gain < MIN_GAIN * float(residual @ residual):
                break
            far = {p.name for p, start in starts if _is_far(p, start, found.values)}
            if not far:
                break
            starts = [(p, {**v, p.name: found.values[p.name]} if p.name in far else v) for p, v in starts]
            found = _mixed(base, term, shape, starts, left, residual, project)
        promising = found is not None and found.gain >= MIN_GAIN * float(residual @ residual)
        whole = at_full_size(base, term, shape, residual, project, adds_yaw=adds_yaw, promising=promising)
        if whole is not None and left is not None:
            values, there = whole
            step = project(there) - residual
            found = _better(found, _scored(term, values, residual, step, _absorbed(there - left, step)))
        out += [found] if found else []
    return out


def _better(*found: Screened | None) -> Screened | None:
    """Return what explains most of these."""
    return max((f for f in found if f is not None), key=lambda f: f.gain, default=None)


def _is_far(p: Parameter, start: Mapping[str, float], values: Mapping[str, float]) -> bool:
    """Return whether a strength that was found lies far beyond the one at which its column was taken."""
    off = float(p.neutral or 0.0)
    return abs(values[p.name] - off) > _FAR_BEYOND * abs(start[p.name] - off)


def _mixed(
    base: BaseFit, term: Term, shape: Mapping[str, float], starts: list[tuple[Parameter, dict[str, float]]],
    left: Array | None, residual: Array, project: Callable[[Array], Array],
) -> Screened | None:  # fmt: skip
    """Score a candidate of one shape with the columns taken at these strengths."""
    columns, kept, raw = [], [], 0.0
    for moved, start in starts:
        column = None if left is None else compute_column(base, term, moved, start, left)
        if column is None:
            continue
        clean = project(column)
        whole, rest = float(column @ column), float(clean @ clean)
        if rest < 1e-9 * whole or whole == 0.0:
            continue
        columns.append(clean)
        kept.append((moved, start))
        raw += whole
    return _best_mix(term, shape, columns, kept, residual, raw) if columns else None


def _replacing(
    base: BaseFit, term: Term, left: Array, residual: Array, project: Callable[[Array], Array]
) -> Screened | None:
    """Score a law that takes another's place: it is never absent, so a step of a fit from typical values tells."""
    values = term.effect.typical()
    there = compute_residual_with(base, term, values)
    if there is None:
        return None
    columns = []
    for p in term.effect.parameters:
        moved = compute_residual_with(base, term, {**values, p.name: values[p.name] * (1.0 + _NEAR)})
        if moved is not None:
            columns.append(project(moved - there))
    rest = project(there)
    absorbed = _absorbed(there - left, rest - residual)
    basis = np.linalg.qr(np.stack(columns, axis=1))[0]
    rest = rest - basis @ (basis.T @ rest)
    return _scored(term, values, residual, rest - residual, absorbed)


def _absorbed(whole: Array, clean: Array) -> float:
    """Return the part of a candidate's step that base parameters can mimic: what is not left of it without them [1]."""
    return 1.0 - float(clean @ clean) / max(float(whole @ whole), 1e-30)


def _scored(
    term: Term, values: dict[str, float], residual: Array, step: Array, absorbed: float, gain: float | None = None
) -> Screened | None:
    """Score what a step makes of the residual, if that is not known; None for no step at all."""
    length = float(np.sqrt(step @ step))
    if length == 0.0:
        return None
    if gain is None:
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
        bad = [k for k, a in zip(kept, amounts, strict=True) if a < 0.0 and not two_sided(starts[k][0])]
        if not bad:
            break
        kept = [k for k in kept if k not in bad]
    if not kept:  # the strength has the wrong sign: its column still tells how little of it would have been seen
        return _scored(term, starts[0][1], residual, columns[0], 1.0 - float(columns[0] @ columns[0]) / raw, gain=0.0)
    step = matrix[:, kept] @ amounts
    values = {**term.effect.neutral(), **shape}
    for k, amount in zip(kept, amounts, strict=True):
        p, start = starts[k]
        off = float(p.neutral or 0.0)
        values[p.name] = float(np.clip(off + amount * (start[p.name] - off), p.low, p.high))
    clean = float(sum(c @ c for c in columns))
    return _scored(term, values, residual, step, 1.0 - clean / raw)
