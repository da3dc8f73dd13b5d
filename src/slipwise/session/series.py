"""Measured and predicted side by side, of one balance in one run: what a curve, a loop or a residual is drawn of.

Where no pad's friction was measured, "pads" is what all bearings carry together, as the inertia above them says.
"""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.comparison.component_level import NAMES
from slipwise.estimation.objective import Objective
from slipwise.relations.base_shear import pair_forces
from slipwise.relations.girder_stages import compute_balance_sides
from slipwise.relations.table import Residuals
from slipwise.rig.load_basis import WARPS
from slipwise.session.state import SessionState
from slipwise.short_repr import short_repr

#: The column of "pads" where no pad's friction was measured.
ALL_BEARINGS = "all bearings"
#: Balances whose two sides are channels; of the others only the residual has a meaning, in floors.
_TWO_SIDED = ("girder", "heave", "pitch", "roll", *WARPS, "storeys")


@short_repr
@dataclass(frozen=True)
class Series:
    """One balance in one run.

    Attributes:
        relation: "pads", "girder" ...
        run: name.
        labels: of the columns: pads, or one column; `ALL_BEARINGS` where no pad's friction was measured.
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


def list_balances(objective: Objective) -> list[str]:
    """Return the names of the balances that can be looked at."""
    return list(dict.fromkeys(["pads", *objective.relations]))


def series_of(objective: Objective, state: SessionState, residuals: Residuals, place: int, relation: str) -> Series:
    """Return one balance of one run.

    Args:
        objective: of the state.
        state: whose numbers.
        residuals: of the state.
        place: of the run.
        relation: one of `list_balances`.
    """
    run = objective.run(place)
    if relation == "pads" and not run.forces_measured:
        measured, predicted = pair_forces(run, residuals, place)
        noise = residuals.block("girder", place).noise * run.states.specimen.mass
        level = float(np.sqrt(np.mean(noise**2)))
        return Series(relation, run.name, (ALL_BEARINGS,), "N", run.time, measured, predicted, (level,))
    of = residuals.block(relation, place)
    part, noise = of.columns, of.noise.reshape(len(run.time), -1)
    floor = tuple(float(np.sqrt(np.mean(column**2))) for column in noise.T)
    labels = run.pads if part.shape[1] == len(run.pads) and part.shape[1] > 1 else (NAMES[relation][0],)
    if relation == "pads":
        # a pad that sticks carries what is asked of it: of the law only its bound is known there
        predicted = np.where(of.mask, residuals.pad_forces[place], np.nan)
        return Series(relation, run.name, run.pads, "N", run.time, run.force, predicted, floor)
    if relation not in _TWO_SIDED:
        whole = tuple(1.0 for _ in floor)
        return Series(relation, run.name, labels, "1", run.time, part, np.zeros_like(part), whole)
    predicted, measured = compute_balance_sides(objective.evaluation(state.values), place)
    sides = (measured[relation][:, None], predicted[relation][:, None])
    return Series(relation, run.name, labels, NAMES[relation][1], run.time, *sides, floor)
