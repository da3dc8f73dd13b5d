"""Residuals of a girder's balances, whitened and in units of their noise."""

from collections.abc import Mapping

import numpy as np

from slipwise.arrays import Array
from slipwise.relations.girder import BALANCES, compute_buffer_forces, compute_motion_residual, predict_balances
from slipwise.relations.inverse_filter import whiten_again
from slipwise.relations.kinematics import CORRECTED, RAISED, YAW, is_pitching_table
from slipwise.relations.measurement import apply_gauge_faults
from slipwise.relations.noise import (
    compute_driven_noise_in_pitch,
    compute_heave_level,
    compute_noise_shares,
    whiten_residual,
    with_masked_noise,
)
from slipwise.relations.pad_stages import MEASURED_FRICTION, divide_by_noise
from slipwise.relations.parameters import PITCH_INERTIA, ROLL_INERTIA, YAW_INERTIA, Term, build_fitted_model
from slipwise.relations.stages import Evaluation, Inputs, Stage
from slipwise.simulation.predict import predictor

#: Numbers of the rig on which the balances depend.
GIRDER_NUMBERS = (
    "rig.mass", "rig.centre_height", "rig.buffer_stiffness", YAW_INERTIA, PITCH_INERTIA, ROLL_INERTIA,
)  # fmt: skip


def is_fault_of_girder_gauge(term: Term) -> bool:
    """Return whether a term is a fault of the girder's accelerometer along x."""
    return term.effect.port == "gauge" and "girder_ax" in term.targets


def is_on_girder(term: Term) -> bool:
    """Return whether the balances depend on a term, beside what it does to the measured channels."""
    hooks = term.effect.hooks
    return term.effect.port == "buffer" or "balance" in hooks or "rig" in hooks or is_fault_of_girder_gauge(term)


def _leave_of_motion(inputs: Inputs) -> list[Array]:
    corrected, raised, delay = inputs.of(CORRECTED), inputs.of(RAISED), inputs.values["rig.late_slip"]
    return [compute_motion_residual(run, delay, corrected.scale, raised) for run in corrected.runs]


def _leave_of_balances(inputs: Inputs) -> dict[str, list[Array]]:
    faults = [term for term in inputs.terms if is_fault_of_girder_gauge(term)]
    own = [term for term in inputs.terms if not is_fault_of_girder_gauge(term)]
    measurements, values, corrected = inputs.measurements, inputs.values, inputs.of(CORRECTED)
    runs, scale, yaw, raised = corrected.runs, corrected.scale, inputs.of(YAW), inputs.of(RAISED)
    sigmas, ringing = inputs.weighed("sigmas"), inputs.weighed("ringing")
    shares = compute_noise_shares(measurements.specimen, runs[0]) if raised else {}
    model = build_fitted_model(measurements.specimen, own, values, GIRDER_NUMBERS)
    law = predictor(model)
    out: dict[str, list[Array]] = {name: [] for name in measurements.relations if name in BALANCES}
    masked = 0.0
    if "heave" in out and sigmas:
        masked = 1.0 - (compute_heave_level(model, runs[0], scale) / float(np.min(sigmas["heave"][0]))) ** 2
    driven: list[Array | None] = [None] * len(runs)
    if "pitch" in out and sigmas and any(is_pitching_table(term) for term in own):
        driven = [*compute_driven_noise_in_pitch(model, runs, values)]
    for i, (run, (force, _)) in enumerate(zip(runs, inputs.of(MEASURED_FRICTION), strict=True)):
        law.rest(run.rest_before)
        predicted, measured = predict_balances(model, run, force, compute_buffer_forces(law, run, *yaw[i]), values)
        for name in out:
            if name == "motion":
                left = inputs.of(MOTION)[i]
            elif name == "girder" and faults:  # put on what is predicted: a filter has no inverse
                shown = run.record.replaced(girder_ax=predicted[name])
                left = inputs.runs[i].channel("girder_ax") - apply_gauge_faults(faults, values, shown)["girder_ax"]
            else:
                left = (measured[name] - predicted[name]) / scale.get(name, 1.0)
                left = whiten_again(left, run, raised, shares.get(name, {}))
            if name in ringing:
                left = np.where(run.ringing, 0.0, left)  # whitening looks both ways: not at what a lifted pad does
                more = driven[i] if name == "pitch" else None
                left = whiten_residual(left, run, float(np.min(sigmas[name][i])), ringing[name][i], more)
            left = divide_by_noise(inputs, name, i, left, run)
            out[name].append(with_masked_noise(left, masked) if name == "heave" else left)
    return out


def compute_balance_sides(evaluation: Evaluation, place: int) -> tuple[dict[str, Array], dict[str, Array]]:
    """Return what the balances of one run predict and what was measured, faults of gauges taken out, (n,) each.

    Args:
        evaluation: of an objective.
        place: of the run.
    """
    inputs = evaluation.inputs(BALANCES_LEFT)
    own = [term for term in inputs.terms if not is_fault_of_girder_gauge(term)]
    model = build_fitted_model(inputs.measurements.specimen, own, inputs.values, GIRDER_NUMBERS)
    law, runs, yaw = predictor(model), inputs.of(CORRECTED).runs, inputs.of(YAW)
    buffers = np.zeros((0, 0))
    for i in range(place + 1):  # what a buffer remembers goes on from run to run
        law.rest(runs[i].rest_before)
        buffers = compute_buffer_forces(law, runs[i], *yaw[i])
    return predict_balances(model, runs[place], inputs.of(MEASURED_FRICTION)[place][0], buffers, inputs.values)


#: Residual of the girder's motion against the slip, per run (n,), whitened.
MOTION = Stage("motion", _leave_of_motion)
#: Residual of every balance of the girder, relation -> per run (n,) [noise].
BALANCES_LEFT: Stage[Mapping[str, list[Array]]] = Stage("balances", _leave_of_balances, is_on_girder)
