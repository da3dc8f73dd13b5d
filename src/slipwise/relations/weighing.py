"""The noise of every relation as a model has it: errors of the velocity near reversals, and what filters took."""

from dataclasses import replace

import numpy as np

from slipwise.arrays import Array
from slipwise.model import Model
from slipwise.relations.girder_across import compute_noise_of_girder_across
from slipwise.relations.kinematics import CORRECTED, RIG_MOTIONS, STATES, compute_compliance, compute_pad_states
from slipwise.relations.measurement import apply_on_force, compute_change_by_faults
from slipwise.relations.noise import (
    compute_balance_noise,
    compute_law_noise_in_girder,
    compute_noise_across,
    compute_pad_noise,
    compute_reversal_noise,
    compute_ringing_noise,
)
from slipwise.relations.pad_law import drive_law, estimate_lost_velocity
from slipwise.relations.pad_stages import (
    LAW_FORCES,
    LOGGED_FORCES,
    compute_forces_along,
    compute_logged_forces,
    get_logger_filter,
    is_fault_of_friction,
    is_reversing,
)
from slipwise.relations.parameters import build_fitted_model
from slipwise.relations.setting import Weighing
from slipwise.relations.stages import Evaluation
from slipwise.simulation.predict import predictor

#: Rounds in which the velocity that the filter took is found. Each leaves about a tenth of what the one before was off:
#: after two, the noise of bridges that were tried is right to 0.5 %; rests show a gauge's noise to 9 % at best.
_ROUNDS = 2


def weigh(evaluation: Evaluation) -> Weighing:
    """Return the noise of every relation with the terms and numbers of an evaluation, of all runs.

    How the evaluation itself is weighed plays no part. What the logger's filter took from the velocity at reversals is
    what the law makes of the motion, so that is found first, in rounds: from the motion without it, then with it.
    """
    values = evaluation.values
    begun = Weighing(slip_delay=values.get("rig.late_slip", 0.0), weighed_by=dict(values))
    evaluation = evaluation.weighed(begun)
    for _ in range(_ROUNDS if evaluation.measurements.specimen.free else 0):
        begun = _with_lost_velocity(evaluation)
        evaluation = evaluation.weighed(begun)
    measurements, runs = evaluation.measurements, evaluation.of(CORRECTED).runs
    model = build_fitted_model(measurements.specimen, evaluation.terms, values)
    states, law_forces = evaluation.of(STATES), evaluation.of(LAW_FORCES)
    faults = tuple(term for term in evaluation.terms if is_fault_of_friction(term))
    inputs = evaluation.inputs(LOGGED_FORCES)
    plain = compute_logged_forces(inputs, states, law_forces, 0.0)
    slower, faster = (_compute_shifted_forces(evaluation, model, errors) for errors in (-1.0, 1.0))
    for forces in (plain, slower, faster):  # a delayed gauge shows its reversals, and their noise, later too
        for i, run in enumerate(runs):
            forces[i] = forces[i] + apply_on_force(faults, values, run, forces[i])[1]
    gradual = any(is_reversing(term) for term in evaluation.terms)
    reversal = [
        compute_reversal_noise(*each, gradual=gradual) for each in zip(runs, plain, slower, faster, strict=True)
    ]
    sigmas: dict[str, tuple[Array, ...]] = {}
    if measurements.forces_measured:
        sigmas["pads"] = tuple(compute_pad_noise(*each) for each in zip(runs, plain, reversal, strict=True))
    ringing: dict[str, tuple[Array, ...]] = {}
    if measurements.balanced:
        changed = [compute_change_by_faults(faults, values, run) for run in runs] if faults else []
        levels = compute_balance_noise(model, runs, values, reversal, changed)
        if not measurements.forces_measured:
            noise = [
                compute_law_noise_in_girder(model.specimen, *each) for each in zip(runs, plain, reversal, strict=True)
            ]
            levels["girder"] = [np.hypot(*each) for each in zip(levels["girder"], noise, strict=True)]
        sigmas |= {name: tuple(levels[name]) for name in measurements.relations if name in levels}
        rung = compute_ringing_noise(model, runs, values).items()
        ringing = {name: tuple(of) for name, of in rung if name in measurements.relations}
    if "across" in measurements.relations:
        sigmas["across"] = tuple(compute_noise_across(*each) for each in zip(runs, states, law_forces, strict=True))
    if "girder_y" in measurements.relations:
        each_run = zip(runs, states, law_forces, strict=True)
        sigmas["girder_y"] = tuple(compute_noise_of_girder_across(model.specimen, *each) for each in each_run)
    return replace(begun, sigmas=sigmas, ringing=ringing)


def _compute_shifted_forces(evaluation: Evaluation, model: Model, errors: float) -> list[Array]:
    """Return the pads' forces along x as logged, with velocities so many expected errors too large, per run (n, p) [N].

    Args:
        evaluation: with the runs.
        model: of its terms and numbers.
        errors: that are added, with their sign [1].
    """
    inputs, law = evaluation.inputs(LOGGED_FORCES), predictor(model)
    states = compute_pad_states(inputs, errors)
    motions = evaluation.of(RIG_MOTIONS) if law.asks_for_motion else None
    found = drive_law(law, evaluation.of(CORRECTED).runs, states, motions)
    return compute_logged_forces(inputs, states, found, 0.0)


def _with_lost_velocity(evaluation: Evaluation) -> Weighing:
    """Return the weighing with what the filter took from the velocity, and with the bounds of the pads' friction."""
    measurements, runs = evaluation.measurements, evaluation.of(CORRECTED).runs
    states, law_forces = evaluation.of(STATES), evaluation.of(LAW_FORCES)
    inputs = evaluation.inputs(LOGGED_FORCES)
    specimen = build_fitted_model(measurements.specimen, evaluation.terms, evaluation.values).built_specimen()
    soft, by = compute_compliance(measurements, specimen, makes_yaw=evaluation.makes_yaw), get_logger_filter(inputs)
    pairs = zip(compute_forces_along(inputs, states, law_forces), runs, strict=True)
    lost = tuple(estimate_lost_velocity(force, run, soft, by) for force, run in pairs)
    bounds = tuple(force.bound[:: run.fine] for force, run in zip(law_forces, runs, strict=True))
    return replace(evaluation.weighing, lost=lost, bounds=bounds)
