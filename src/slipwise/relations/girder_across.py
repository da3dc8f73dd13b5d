"""The girder's balance along y where no pad's friction was measured: what all bearings carry together across.

    m a_y = -(sum F_y + F_b,y + sum m_i a_i,y)

F_y is the law's for the measured slip along x and y. Where a pad is slow the direction of its velocity is noise: only
fast samples are held against the law. Where pads have gauges across, `across` holds the law against those.
"""

import numpy as np

from slipwise.arrays import Array
from slipwise.relations.evaluation_times import Instants
from slipwise.relations.girder_stages import GIRDER_NUMBERS, is_on_girder
from slipwise.relations.kinematics import CORRECTED
from slipwise.relations.noise import compute_noise_of_law_across
from slipwise.relations.pad_law import log_force
from slipwise.relations.pad_stages import LAW_FORCES, divide_by_noise, get_logger_filter
from slipwise.relations.parameters import build_fitted_model
from slipwise.relations.run_data import FitRun, interpolate_finely
from slipwise.relations.stages import Inputs, Stage
from slipwise.relations.transverse_friction import predict_logged_across
from slipwise.rig import Specimen
from slipwise.rig.frame import frame_push, storey_channels
from slipwise.simulation.predict import PadForces, Predictor, predictor


def _buffers_across(law: Predictor, run: FitRun) -> Array:
    """Return the force of the girder on all buffers along y (n,) [N]."""
    specimen = law.model.specimen
    if not specimen.buffers:
        return np.zeros(len(run.time))
    slip, rate = (
        np.repeat(interpolate_finely(of, run.fine)[:, None], len(specimen.buffers), axis=1)
        for of in (run.states.slip, run.states.velocity)
    )
    time = np.linspace(run.time[0], run.time[-1], len(slip))
    return log_force(law.buffers(time, slip, rate)[:, :, 1], run, None, averaged=False).sum(axis=1)


def _leave_across(inputs: Inputs) -> list[Array]:
    model = build_fitted_model(inputs.measurements.specimen, inputs.terms, inputs.values, GIRDER_NUMBERS)
    law, by = predictor(model), get_logger_filter(inputs)
    mass, out = model.built_specimen().mass, []
    for i, (run, force) in enumerate(zip(inputs.of(CORRECTED).runs, inputs.of(LAW_FORCES), strict=True)):
        law.rest(run.rest_before)
        held = predict_logged_across(run, force, by).sum(axis=1) + _buffers_across(law, run)
        predicted = (frame_push(run.record, model.specimen, "y") - held) / mass
        out.append(divide_by_noise(inputs, "girder_y", i, run.record["girder_ay"] - predicted, run))
    return out


#: Residual of the girder's balance along y, per run (n,) [noise].
GIRDER_ACROSS = Stage("girder across", _leave_across, is_on_girder)


def compute_noise_of_girder_across(specimen: Specimen, run: FitRun, state: Instants, law_forces: PadForces) -> Array:
    """Return the noise of the balance along y (n,) [m/s^2]: accelerometers, slip on buffers, and the law's direction.

    Args:
        specimen: its masses and buffers.
        run: its gauges.
        state: of the pads at the instants.
        law_forces: of the law for these states.
    """
    levels = [specimen.mass * run.noise.get("girder_ay", 0.0)]
    pairs = zip(specimen.storeys, storey_channels(specimen.storeys, "y"), strict=True)
    levels += [storey.mass * run.noise.get(name, 0.0) for storey, name in pairs]
    levels.append(0.1 * sum(buffer.stiffness_y for buffer in specimen.buffers) * run.noise.get("slip_y", 0.0))
    law = compute_noise_of_law_across(run, state, law_forces).sum(axis=1)  # all pads turn at once
    return np.hypot(float(np.linalg.norm(levels)), law) / specimen.mass
