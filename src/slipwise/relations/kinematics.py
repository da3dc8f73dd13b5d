"""What moved: the runs without their gauges' faults, the girder's yaw, and the states of every pad."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.rig_motion import rig_motion
from slipwise.relations.evaluation_times import Instants, evaluate_states_at_instants
from slipwise.relations.girder import compute_buffer_forces, compute_rigid_rotation
from slipwise.relations.inverse_filter import Spectrum
from slipwise.relations.measurement import compute_noise_scale, compute_raised_noise, is_on_force_gauge, without
from slipwise.relations.parameters import YAW_INERTIA, Term, build_fitted_model
from slipwise.relations.run_data import FitRun, interpolate_finely
from slipwise.relations.setting import Measurements
from slipwise.relations.stages import Inputs, Stage
from slipwise.relations.yaw import compute_yaw
from slipwise.rig import Specimen
from slipwise.rig.frame import frame_push
from slipwise.simulation.predict import predictor

#: Numbers of the rig on which yaw depends, and on which the table's pitch moves the girder.
_YAW_NUMBERS = ("rig.mass", "rig.buffer_stiffness", YAW_INERTIA)
_TABLE_PITCH_NUMBERS = ("rig.centre_height",)


def is_fault_of_motion(term: Term) -> bool:
    """Return whether a term is a fault of a gauge that is taken out of what was measured."""
    return term.effect.port == "gauge" and not is_on_force_gauge(term)


def is_pitching_table(term: Term) -> bool:
    """Return whether a term moves the girder over the table without slip."""
    return term.effect.port == "table" and "balance" in term.effect.hooks


def is_changing_torque(term: Term) -> bool:
    """Return whether the yaw depends on a term's numbers: how much pads differ is in the forces that were measured."""
    return term.effect.port == "buffer" or (bool(term.effect.turns) and "rig" in term.effect.hooks)


@dataclass(frozen=True, eq=False)
class Corrected:
    """Runs without their gauges' faults, but for those of friction.

    Attributes:
        runs: with what the table's pitch adds taken out too.
        scale: relation or channel -> by how much the noise has grown with the correction, where it has [1].
    """

    runs: tuple[FitRun, ...]
    scale: Mapping[str, float]


def _correct(inputs: Inputs) -> Corrected:
    faults = [term for term in inputs.terms if is_fault_of_motion(term)]
    table_pitch = [term for term in inputs.terms if is_pitching_table(term)]
    runs, values, around = inputs.of(SYNCHRONISED), inputs.values, inputs.around
    for term in faults:
        runs = tuple(without(term, values, run, around) for run in runs)
    if table_pitch:
        model = build_fitted_model(inputs.measurements.specimen, table_pitch, values, _TABLE_PITCH_NUMBERS)
        runs = tuple(run.without_table_pitch(compute_rigid_rotation(model, run)) for run in runs)
    return Corrected(runs, compute_noise_scale(faults, values, inputs.runs[0]) if faults else {})


def _synchronise(inputs: Inputs) -> tuple[FitRun, ...]:
    delay = inputs.weighed("slip_delay")
    return inputs.runs if delay == 0.0 else tuple(run.slip_delay_corrected(delay) for run in inputs.runs)


def _raise_noise(inputs: Inputs) -> dict[str, Spectrum]:
    return compute_raised_noise(inputs.terms, inputs.values, inputs.runs[0])


def _make_yaw(inputs: Inputs) -> list[tuple[Array, Array]]:
    runs = inputs.of(CORRECTED).runs
    if not inputs.makes_yaw:
        return [(run.states.yaw, run.states.yaw_rate) for run in runs]
    model = build_fitted_model(inputs.measurements.specimen, inputs.terms, inputs.values, _YAW_NUMBERS)
    specimen, law, bounds = model.built_specimen(), predictor(model), inputs.weighed("bounds")
    found = []
    for i, run in enumerate(runs):
        law.rest(run.rest_before)
        still = np.zeros(len(run.time))
        buffers = compute_buffer_forces(law, run, still, still)
        force = _whole(run, specimen, buffers)
        found.append(compute_yaw(run, specimen, force, bounds[i] if bounds else np.abs(force), buffers))
    return found


def compute_pad_states(inputs: Inputs, errors: float = 0.0) -> list[Instants]:
    """Return the states of every pad in the runs.

    Args:
        inputs: of a stage.
        errors: number of expected errors that are added to the velocity, and to the slip between samples [1].
    """
    runs, measurements, lost = inputs.of(CORRECTED).runs, inputs.measurements, inputs.weighed("lost")
    pads = np.array(measurements.specimen.pad_places)[measurements.pads_here]
    round_about = np.stack([-pads[:, 1], pads[:, 0]], axis=1)[None]
    alike = not (inputs.makes_yaw or runs[0].states.has_yaw)
    here = slice(1 if alike else None)  # a girder without yaw moves over every pad alike
    pitch_slip = inputs.values.get("rig.pitch_slip", 0.0)
    out = []
    for place, run in enumerate(runs):
        velocity = run.states.pad_velocity[:, here].copy()
        velocity[:, :, 0] += pitch_slip * measurements.pitch_rates[place][:, None]
        velocity[:, :, 0] += errors * run.states.pad_velocity_errors[:, here]
        slip = run.states.pad_slip[:, here]
        if inputs.makes_yaw:
            angle, rate = inputs.of(YAW)[place]
            velocity = velocity + rate[:, None, None] * round_about
            slip = slip + angle[:, None, None] * round_about
        out.append(evaluate_states_at_instants(run, velocity, slip, lost[place][:, here] if lost else None, errors))
    return out


def _rig_motions(inputs: Inputs) -> list[Array]:
    return [interpolate_finely(rig_motion(run.states), run.fine) for run in inputs.of(CORRECTED).runs]


#: The runs with slip and accelerations synchronised.
SYNCHRONISED = Stage("synchronised runs", _synchronise)
#: The runs without the faults of their gauges, but for those of friction.
CORRECTED = Stage("corrected runs", _correct, lambda t: is_fault_of_motion(t) or is_pitching_table(t))
#: Channel -> by how much taking its fault out has raised the power of its noise; see `compute_raised_noise`.
RAISED = Stage("raised noise", _raise_noise, is_fault_of_motion)
#: Yaw [rad] and its rate [rad/s] of every run, (n,) each: measured, made from the forces, or none.
YAW = Stage("yaw", _make_yaw, is_changing_torque)
#: States of every pad at the instants at which the laws are evaluated, one `Instants` of every run.
STATES = Stage("states of the pads", compute_pad_states)
#: Motion of the rig at the instants, (f, 3) of every run.
RIG_MOTIONS = Stage("motion of the rig", _rig_motions)


def compute_compliance(measurements: Measurements, specimen: Specimen, *, makes_yaw: bool) -> Array:
    """Return the acceleration of pad i for a force along x on pad j, (p, p) [1/kg], with yaw where it is known.

    A pad that was not measured is taken to hold the girder as the measured ones do.

    Args:
        measurements: which pads were measured, and whether yaw was.
        specimen: as built.
        makes_yaw: whether yaw is made from the measured forces.
    """
    here = measurements.pads_here
    places = np.array(specimen.pad_places)[here, 1] - specimen.centre_y
    by_yaw = np.outer(places, places) / specimen.inertia[2]
    has_yaw = makes_yaw or measurements.runs[0].states.has_yaw
    every = len(specimen.pads) / len(here)
    return every / specimen.mass + (by_yaw if has_yaw else np.zeros_like(by_yaw))


def _whole(run: FitRun, specimen: Specimen, buffers: Array) -> Array:
    """Return the pads' forces (n, p) [N]; where one gauge is invalid, what the girder's balance leaves it."""
    force = run.force
    bad = np.stack([run.invalid.get(f"pad_{p}_Fx", np.zeros(len(force), dtype=bool)) for p in run.pads], axis=1)
    alone = bad & (bad.sum(axis=1, keepdims=True) == 1)
    if not alone.any():
        return force
    others = np.where(bad, 0.0, force).sum(axis=1)
    push = frame_push(run.record, specimen) - buffers.sum(axis=1)
    rest = push - specimen.mass * run.channel("girder_ax") - others
    return np.where(alone, rest[:, None], force)
