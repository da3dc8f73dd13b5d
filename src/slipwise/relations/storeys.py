"""What a frame on the girder pushes it, predicted from the girder's own motion: the balance that sees the frame.

    -sum m_i a_i = -sum_j G_j P_j(s) (G_j a + H_j t'' - G_j g t) - sum m_i g t
    P_j(s) = (2 z w s + w^2) / (s^2 + 2 z w s + w^2)

G_j = sum m_i f_ij and H_j = sum m_i f_ij (z_i - h) of the frame's modes f_j on a base that does not move, with unit
modal masses; a is the girder's acceleration and t its pitch, which follows from the loads on the pads' springs; the
weight of the floors pulls along the tilted base. Damping is that of each mode by itself.

Source: Chopra, Dynamics of Structures, chapters 12 and 13: modal analysis of a frame on a moving base.
"""

import numpy as np

from slipwise.arrays import Array
from slipwise.relations.run_data import FitRun
from slipwise.rig import Specimen
from slipwise.rig.frame import frame_push
from slipwise.rig.load_basis import basis_of
from slipwise.rig.storeys import frame_modes
from slipwise.signals.oscillator import oscillator


def predict_push(run: FitRun, specimen: Specimen) -> Array:
    """Return the force of the storeys on the girder along x that its motion calls up (n,) [N].

    They begin at rest; where a record begins in motion, as the measured push fits best.

    Args:
        run: with girder_ax and the loads of all pads.
        specimen: as built.
    """
    moment = (run.load @ basis_of(specimen).rigid[1]) * specimen.half_spacing[0]
    push = compute_push_from_rest(
        run.record["girder_ax"], (moment - moment[0]) / specimen.pitch_stiffness, run.dt, specimen
    )
    return push if run.states.at_rest[0] else push + _rung_on(frame_push(run.record, specimen) - push, run, specimen)


def compute_push_from_rest(acceleration: Array, pitch: Array, dt: float, specimen: Specimen) -> Array:
    """Return the force of the storeys on the girder along x (n,) [N].

    Args:
        acceleration: (n,) of the girder along x [m/s^2].
        pitch: (n,) of the girder about y [rad].
        dt: sampling step [s].
        specimen: as built.
    """
    heights = np.array([storey.z for storey in specimen.storeys]) - specimen.centre_height
    masses = np.array([storey.mass for storey in specimen.storeys])
    turning = np.gradient(np.gradient(pitch, dt), dt)
    push = -masses.sum() * specimen.gravity * pitch
    for mode in frame_modes(specimen.storeys):
        lever = float((masses * heights) @ mode.shape)
        driven = mode.share * (specimen.gravity * pitch - acceleration) - lever * turning
        turn = 2.0 * np.pi * mode.frequency
        for order, factor in ((1, 2.0 * mode.damping * turn), (0, turn**2)):
            push += mode.share * factor * oscillator(driven, dt, mode.frequency, mode.damping, order)
    return push


def _rung_on(left: Array, run: FitRun, specimen: Specimen) -> Array:
    """Return how the frame rings on from before the record began (n,) [N]: what fits best to the rest of its push."""
    after = run.time - run.time[0]
    columns = []
    for mode in frame_modes(specimen.storeys):
        turn = 2.0 * np.pi * mode.frequency
        swing = np.sqrt(max(1.0 - mode.damping**2, 1e-6)) * turn * after
        decay = np.exp(-mode.damping * turn * after)
        columns += [decay * np.cos(swing), decay * np.sin(swing)]
    matrix = np.column_stack(columns)
    kept = run.judged["storeys"]
    if np.count_nonzero(kept) < len(columns):
        return np.zeros(len(left))
    return np.asarray(matrix @ np.linalg.lstsq(matrix[kept], left[kept], rcond=None)[0], dtype=np.float64)


def compute_noise_in_push(run: FitRun, specimen: Specimen) -> Array:
    """Return what the noise of the girder's accelerometer adds to the predicted push: the frame rings with it.

    Returns:
        spectrum (m,) at the frequencies of a real transform, as the variance of white noise of that height [N^2].
    """
    turn = 2.0 * np.pi * np.fft.rfftfreq(len(run.time), run.dt)
    gain = np.zeros(len(turn), dtype=complex)
    for mode in frame_modes(specimen.storeys):
        w = 2.0 * np.pi * mode.frequency
        spring = w**2 + 2j * mode.damping * w * turn
        gain += mode.share**2 * spring / (spring - turn**2)
    return (run.noise.get("girder_ax", 0.0) * np.abs(gain)) ** 2
