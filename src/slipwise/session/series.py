"""Measured and predicted side by side, of one balance in one run: what a curve, a loop or a residual is drawn of."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.comparison.component_level import NAMES
from slipwise.estimation.objective import Problem
from slipwise.relations.girder import buffers_along, predicted_balances
from slipwise.relations.measurement import acts_on_force, on_force
from slipwise.relations.table import Residuals
from slipwise.rig.load_basis import WARPS
from slipwise.session.state import State
from slipwise.simulation.predict import predictor

Array = NDArray[np.float64]
#: Balances whose two sides are channels; of the others only the residual has a meaning, in floors.
_TWO_SIDED = ("girder", "heave", "pitch", "roll", *WARPS, "storeys")


@dataclass(frozen=True)
class Series:
    """One balance in one run.

    Attributes:
        relation: "pads", "girder" ...
        run: name.
        labels: of the columns: pads, or one column.
        unit: SI unit, or "1" for a residual in floors.
        time: (n,) [s].
        measured: (n, c).
        predicted: (n, c); NaN where nothing is predicted: of friction, where a pad sticks.
        floor: standard deviation of the noise of one sample, of each column, in the unit.
    """

    relation: str
    run: str
    labels: tuple[str, ...]
    unit: str
    time: Array
    measured: Array
    predicted: Array
    floor: tuple[float, ...]

    @property
    def residual(self) -> Array:
        """Measured minus predicted (n, c)."""
        return self.measured - self.predicted


def series_of(problem: Problem, state: State, residuals: Residuals, place: int, relation: str) -> Series:
    """Return one balance of one run.

    Args:
        problem: of the state.
        state: whose numbers.
        residuals: of the state.
        place: of the run.
        relation: one of `problem.relations`.
    """
    run = problem.runs[place]
    part = residuals.parts[relation][place].reshape(len(run.time), -1)
    noise = np.broadcast_to(problem.sigmas[relation][place], part.shape)
    floor = tuple(float(np.sqrt(np.mean(column**2))) for column in noise.T)
    labels = run.pads if part.shape[1] == len(run.pads) and part.shape[1] > 1 else (NAMES[relation][0],)
    if relation == "pads":
        # a pad that sticks carries what is asked of it: of the law only its bound is known there
        predicted = np.where(
            np.broadcast_to(_columns(run.judged["pads"]), part.shape), residuals.pad_forces[place], np.nan
        )
        return Series(relation, run.name, run.pads, "N", run.time, run.force, predicted, floor)
    if relation not in _TWO_SIDED:
        whole = tuple(1.0 for _ in floor)
        return Series(relation, run.name, labels, "1", run.time, part, np.zeros_like(part), whole)
    predicted, measured = _both_sides(problem, state, residuals, place)
    sides = (measured[relation][:, None], predicted[relation][:, None])
    return Series(relation, run.name, labels, NAMES[relation][1], run.time, *sides, floor)


def _columns(judged: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return flags (n,) or (n, c) as columns."""
    return judged.reshape(len(judged), -1)


def _both_sides(
    problem: Problem, state: State, residuals: Residuals, place: int
) -> tuple[dict[str, Array], dict[str, Array]]:
    """Return what the balances of a girder predict and what was measured, faults of gauges taken out."""
    values, count = state.values, place + 1
    model = problem.model(values)
    runs, _ = problem.kinematics.corrected(values, count)
    yaw = problem.kinematics.yaw_of_runs(values, count)
    faults = [t for t in problem.terms if t.effect.port == "gauge" and acts_on_force(t)]
    law = predictor(model)
    for run, turned in zip(runs[:count], yaw, strict=True):
        law.rest(run.rest_before)
        buffers = buffers_along(law, run, *turned)
    force, _ = on_force(faults, values, runs[place], residuals.pad_forces[place], problem.kinematics.around)
    return predicted_balances(model, runs[place], force, buffers, values)
