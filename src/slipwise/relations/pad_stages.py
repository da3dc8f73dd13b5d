"""Friction of the pads: what the law gives, what a logger would have written, and what is left of the measured one."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.effects import FRICTION_PORTS
from slipwise.relations.evaluation_times import Instants
from slipwise.relations.kinematics import CORRECTED, RIG_MOTIONS, STATES
from slipwise.relations.measurement import apply_on_force, is_on_force_gauge
from slipwise.relations.pad_law import compute_stick_share, drive_law, log_force, sum_forces_along
from slipwise.relations.parameters import ZERO, Term, build_fitted_model
from slipwise.relations.run_data import FitRun
from slipwise.relations.stages import Inputs, Stage
from slipwise.relations.transverse_friction import predict_logged_across
from slipwise.signals.filters import LowPass
from slipwise.simulation.predict import PadForces, predictor

_LAW_NUMBERS = ("rig.shear_strength",)
#: Where a model has its own memory of slip, or nothing is fitted yet [m].
_SHORT_STICK = 1e-6


def is_on_pads(term: Term) -> bool:
    """Return whether the law of the pads depends on a term."""
    return (term.effect.port in FRICTION_PORTS and bool(term.effect.instant_hooks)) or "rig" in term.effect.hooks


def is_reversing(term: Term) -> bool:
    """Return whether a term says over which slip friction turns round."""
    return bool(term.effect.reverses)


def is_fault_of_friction(term: Term) -> bool:
    """Return whether a term is a fault of gauges of friction: it is put on what is predicted."""
    return term.effect.port == "gauge" and is_on_force_gauge(term)


@dataclass(frozen=True, eq=False)
class PadResiduals:
    """What is left of the pads' friction along x.

    Attributes:
        left: per run (n, p) [noise]; empty where friction was not measured.
        predicted: per run (n, p), faults of the gauges included [N].
    """

    left: list[Array]
    predicted: list[Array]


def get_logger_filter(inputs: Inputs) -> LowPass | None:
    """Return the logger's filter where the campaign knows none; else None."""
    frequency = inputs.values.get("rig.logger")
    return None if frequency is None else LowPass(frequency)


def _drive_law(inputs: Inputs) -> list[PadForces]:
    model = build_fitted_model(inputs.measurements.specimen, inputs.terms, inputs.values, _LAW_NUMBERS)
    law = predictor(model)
    motions = inputs.of(RIG_MOTIONS) if law.asks_for_motion else None
    return drive_law(law, inputs.of(CORRECTED).runs, inputs.of(STATES), motions)


def compute_forces_along(inputs: Inputs, states: Sequence[Instants], law_forces: Sequence[PadForces]) -> list[Array]:
    """Return the pads' forces along x at the instants, per run (f, p) [N].

    Args:
        inputs: of a stage that sees the terms that reverse.
        states: of the pads, per run.
        law_forces: of the law for these states.
    """
    length = inputs.values.get("rig.stick_length", inputs.measurements.runs[0].scales.length * _SHORT_STICK)
    damping = inputs.values.get("rig.stick_damping", 0.0)
    shares = [None if inputs.terms else compute_stick_share(state, length, damping) for state in states]
    return [sum_forces_along(*each) for each in zip(law_forces, states, shares, strict=True)]


def compute_logged_forces(
    inputs: Inputs, states: Sequence[Instants], law_forces: Sequence[PadForces], delay: float
) -> list[Array]:
    """Return the pads' forces along x as a logger would have written them, per run (n, p) [N].

    Args:
        inputs: of a stage that sees the terms that reverse.
        states: of the pads, per run.
        law_forces: of the law for these states.
        delay: of the gauges of friction [s].
    """
    by, zero, averaged = get_logger_filter(inputs), inputs.values.get(ZERO, 0.0), not inputs.terms
    forces = zip(compute_forces_along(inputs, states, law_forces), inputs.of(CORRECTED).runs, strict=True)
    return [zero + log_force(force, run, by, averaged=averaged, delay=delay) for force, run in forces]


def _log(inputs: Inputs) -> list[Array]:
    delay = inputs.values.get("rig.late_force", 0.0)
    return compute_logged_forces(inputs, inputs.of(STATES), inputs.of(LAW_FORCES), delay)


def _measured_friction(inputs: Inputs) -> list[tuple[Array, Array]]:
    runs = inputs.of(CORRECTED).runs
    if not inputs.measurements.forces_measured:  # balances hold what the law says instead
        return [(force, np.zeros_like(force)) for force in inputs.of(LOGGED_FORCES)]
    forces = inputs.of(LOGGED_FORCES) if inputs.terms else [run.force for run in runs]
    pairs = zip(runs, forces, strict=True)
    return [apply_on_force(inputs.terms, inputs.values, run, force, inputs.around) for run, force in pairs]


def _leave_of_pads(inputs: Inputs) -> PadResiduals:
    if not inputs.measurements.forces_measured:
        return PadResiduals([], inputs.of(LOGGED_FORCES))
    left, predicted = [], []
    faults = inputs.of(MEASURED_FRICTION)
    for i, (run, force) in enumerate(zip(inputs.of(CORRECTED).runs, inputs.of(LOGGED_FORCES), strict=True)):
        offset = faults[i][1]
        predicted.append(force + offset)
        left.append(divide_by_noise(inputs, "pads", i, run.force - force - offset, run))
    return PadResiduals(left, predicted)


def _leave_across(inputs: Inputs) -> list[Array]:
    by = get_logger_filter(inputs)
    pairs = zip(inputs.of(CORRECTED).runs, inputs.of(LAW_FORCES), strict=True)
    sides = ((run, run.across - predict_logged_across(run, force, by)) for run, force in pairs)
    return [divide_by_noise(inputs, "across", i, side, run) for i, (run, side) in enumerate(sides)]


def divide_by_noise(inputs: Inputs, relation: str, place: int, left: Array, run: FitRun) -> Array:
    """Return a residual in units of its noise, as it is before that is known; zero where it is not judged."""
    sigmas = inputs.weighed("sigmas")
    return np.where(run.judged[relation], left / sigmas[relation][place] if sigmas else left, 0.0)


#: Force and bound of every pad at the instants, one `PadForces` of every run.
LAW_FORCES = Stage("forces of the law", _drive_law, is_on_pads)
#: Friction along x as a logger would have written it, per run (n, p) [N].
LOGGED_FORCES = Stage("forces as logged", _log, is_reversing)
#: Measured friction along x without its gauges' faults, and what they add to the predicted one, (n, p) each [N].
MEASURED_FRICTION = Stage("measured friction", _measured_friction, is_fault_of_friction)
#: Residual and prediction of friction along x.
PADS = Stage("pads", _leave_of_pads)
#: Residual of friction along y, per run (n, p) [noise].
ACROSS = Stage("across", _leave_across)
