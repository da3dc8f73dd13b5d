"""Whether a candidate keeps any of what its column promises: a screen's straight lines know no bounds."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from slipwise.diagnosis.initial_grid import strengths
from slipwise.diagnosis.row_subset import on_screen
from slipwise.diagnosis.screening import Screened
from slipwise.diagnosis.sensitivities import compute_residual_with
from slipwise.estimation.base_fit import BaseFit
from slipwise.jobs.parallel import on_every_core

#: Parts of the way that are gone, and the share of what a straight line promises there that is enough [1].
_PARTS, _ENOUGH = (1.0, 0.25), 0.1
#: Candidates that are looked at so.
_LEADING = 12
#: Where promises are not kept: other numbers would have to leave their bounds, or only another gauge's noise is read.
_PORTS = ("gauge", "girder")


def keeps_its_gain(base: BaseFit, found: Screened) -> bool:
    """Go towards what a screen has found, base parameters within their bounds, and tell whether anything is gained.

    Laws of friction are believed: far from straight, they may gain nothing here and all in a fit.

    Args:
        base: the base fit.
        found: the candidate.
    """
    if found.term.effect.port not in _PORTS:
        return True
    solution, objective = base.solution, base.objective
    left = on_screen(objective, solution.residuals.stacked(objective.fitted))
    cost = float(left @ left)
    there = compute_residual_with(base, found.term, found.values)
    if there is None or cost - float(there @ there) > _ENOUGH * found.gain:
        return True
    step = -np.linalg.lstsq(solution.normal, on_screen(objective, solution.jacobian).T @ (there - left), rcond=1e-12)[0]
    off = {p.name: float(p.neutral or 0.0) for p in strengths(found.term.effect)}
    for part in _PARTS:
        moved = {
            f.key: float(np.clip(solution.values[f.key] + part * s * f.scale, f.low, f.high))
            for f, s in zip(base.free, step, strict=True)
        }
        values = {k: v + (1.0 - part) * (off.get(k, v) - v) for k, v in found.values.items()}
        ended = compute_residual_with(base, found.term, values, moved)
        if ended is None:
            return True
        promised = found.gain * part * (2.0 - part)
        if cost - float(ended @ ended) > _ENOUGH * promised:
            return True
    return False


def with_bounds_checked(base: BaseFit, found: Sequence[Screened], least: float) -> list[Screened]:
    """Return candidates, best first, those of the leading ones that keep nothing of their promise without a gain.

    Args:
        base: the base fit.
        found: candidates, best first.
        least: gain that is worth a refit [1].
    """
    leading = [s for s in found if s.gain > least][:_LEADING]
    kept = on_every_core(lambda i: keeps_its_gain(base, leading[i]), len(leading))
    broken = {id(s) for s, keeps in zip(leading, kept, strict=True) if not keeps}
    return sorted((replace(s, gain=0.0) if id(s) in broken else s for s in found), key=lambda s: -s.gain)
