"""Samples behind the pictures of a discovery: what is left over a state, what a law adds, what was predicted."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.law import Law
from slipwise.discovery.law_objective import STRENGTH, FittedLaw
from slipwise.discovery.matching import product_at
from slipwise.discovery.result import Discovery
from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Objective
from slipwise.residual_map.curve import ResidualCurve, fit_curve
from slipwise.residual_map.states import DrivingState

#: Points of a cloud, and parts of the range of its state that share them evenly: what is rare is seen too.
_POINTS, _PARTS = 4000, 50
#: A sample whose noise, as seen through its carrier, is so many times the usual one says nothing, and is not drawn [1].
_NOISY = 3.0
#: A gate is open above this [1].
_OPEN = 0.5


@dataclass(frozen=True)
class Cloud:
    """Samples of what a curve over states has to go through.

    Attributes:
        states: (m,) of each state [SI].
        height: (m,) [unit of the port].
        curve: the curve of straight pieces through them, with its noise.
    """

    states: tuple[Array, ...]
    height: Array
    curve: ResidualCurve

    def thinned(self) -> "Cloud":
        """Return at most a few thousand of the samples."""
        chosen = thinned(self.states[0])
        return Cloud(tuple(s[chosen] for s in self.states), self.height[chosen], self.curve)


def thinned(values: Array) -> NDArray[np.intp]:
    """Choose a few thousand of the samples, evenly over the range of the values (m,) as far as there are any."""
    edges = np.linspace(float(values.min()), float(values.max()), _PARTS + 1)[1:-1]
    part = np.searchsorted(edges, values)
    most = _POINTS // _PARTS
    return np.sort(np.concatenate([p[:: max(1, len(p) // most)] for p in _places(part)]))


def _places(part: NDArray[np.intp]) -> list[NDArray[np.intp]]:
    return [p for i in range(_PARTS) if len(p := np.flatnonzero(part == i))]


def after(found: Discovery) -> Solution | None:
    """Return the fit with all laws; None where there is none."""
    return found.laws[-1].fitted.solution if found.laws else None


def law_states(law: FittedLaw) -> list[DrivingState]:
    """Return the states that drive a law with the lag that was fitted."""
    return law.objective.driving(law.law, law.values)


def law_cloud(law: Law) -> Cloud:
    """Return what is left with the law, and the law itself, over what it is multiplied by, at judged fitted samples.

    The curve has the knots of the candidate, and everything else is as the fit with the law has it: what other numbers
    can do for a law leaves the candidate's own curve open.
    """
    objective, splines = law.fitted.objective.plain, law.fitted.law.match.candidate.curve.splines
    driving = law_states(law.fitted)
    found = [(*law_heights(law, driving, i), _seen_noise(law, i)) for i in objective.fitted]
    kept = [np.isfinite(heights) for _, heights, _ in found]
    over = tuple(
        np.concatenate([states[k][chosen] for (states, _, _), chosen in zip(found, kept, strict=True)])
        for k in range(len(splines.knots))
    )
    height, noise = (
        np.concatenate([each[k][chosen] for each, chosen in zip(found, kept, strict=True)]) for k in (1, 2)
    )
    return Cloud(over, height, fit_curve(splines, over, 1.0 / noise, height / noise))


def law_heights(law: Law, driving: Sequence[DrivingState], place: int) -> tuple[list[Array], Array]:
    """Return the states of a law in a run, and what its curve has to go through there, (n, q) each.

    The height is NaN where the law does not act, or the sample is not judged or drowns in noise.

    Args:
        law: of a discovery.
        driving: what `law_states` gives.
        place: of the run.
    """
    fitted, fine = law.fitted, law.fitted.objective.plain.run(place).fine
    states = [s.values[place][::fine] for s in driving]
    form = fitted.values[STRENGTH] * product_at(fitted.law.match.forms, states, fitted.values)
    relation = fitted.law.match.candidate.port.relation
    of, noise = fitted.solution.residuals.block(relation, place), _seen_noise(law, place)
    kept = _wide(of.mask) & (fitted.law.opened[place][::fine] > _OPEN)
    kept &= np.abs(noise) < _NOISY * np.nanmedian(np.abs(noise))
    return states, np.where(kept, form + of.columns * noise, np.nan)


def _seen_noise(law: Law, place: int) -> Array:
    """Return the noise of a run over what a law is multiplied by, (n, q)."""
    port, plain = law.fitted.law.match.candidate.port, law.fitted.objective.plain
    carrier = port.carrier[place][:: plain.run(place).fine]
    noise = plain.layout.block(port.relation, place).noise
    return _wide(noise) / np.where(carrier == 0.0, np.nan, carrier)


def candidate_cloud(candidate: CurveCandidate) -> Cloud:
    """Return the same for a curve that is no law, of averaged samples, all else as the joint system has it."""
    *states, height = candidate.points
    return Cloud(tuple(states), height, candidate.curve)


def left_over(objective: Objective, solution: Solution, relation: str, state: DrivingState) -> tuple[Array, Array]:
    """Return a state and what a fit leaves in a relation [floors], (m,) each, at the judged samples of fitted runs."""
    places, left = [], []
    for of in solution.residuals.blocks(relation, objective.fitted):
        part, kept = of.columns, _wide(of.mask)
        places.append(np.broadcast_to(state.values[of.run][:: objective.run(of.run).fine], part.shape)[kept])
        left.append(part[kept])
    return np.concatenate(places), np.concatenate(left)


def predicted_forces(found: Discovery, place: int, *, with_laws: bool) -> Array:
    """Return the friction of every pad of a run, as the base fit or the fit with the laws predicts it, (n, p) [N]."""
    solution = after(found) if with_laws else None
    if solution is None:
        return found.base.solution.residuals.pad_forces[place]
    force = solution.residuals.pad_forces[place]
    for law in (law.fitted for law in found.laws):
        if law.law.match.candidate.port.relation == "pads":
            force = force + law.objective.force(place, law.law, law_states(law), law.values, solution.values)
    return force


def predicted_acceleration(found: Discovery, place: int, *, with_laws: bool) -> Array:
    """Return the girder's acceleration along x as its balance predicts it, (n,) [m/s^2]; measured where not judged."""
    return found.base.objective.run(place).channel("girder_ax") - _left(found, place, "girder", with_laws)


def predicted_load(found: Discovery, place: int, *, with_laws: bool) -> Array:
    """Return the load of all pads as the heave balance predicts it, (n,) [N]; measured where not judged."""
    return found.base.objective.run(place).load.sum(axis=1) - _left(found, place, "heave", with_laws)


def _left(found: Discovery, place: int, relation: str, with_laws: bool) -> Array:
    """Return what a balance leaves of a run (n,), in its own unit."""
    solution = (after(found) if with_laws else None) or found.base.solution
    of = solution.residuals.block(relation, place)
    return of.value * of.sigma


def _wide(values: NDArray) -> NDArray:
    return values.reshape(len(values), -1)
