"""Yaw of the girder where no gauge shows it, from the friction that was measured on its pads.

    I psi'' = sum (y_i - y_c) F_i + sum (y_j - y_c) B_j - K_psi psi - C psi',   C = sum F_bi x_i^2 / |v_i|

Unequal buffers, an eccentric mass and unequal pads turn the girder, and pads at +y then slide at another speed than
those at -y, v_i = (v - y_i psi', x_i psi'). Friction along y damps the yaw: it is the share x_i psi'/|v_i| of the
pad's bound F_b. The bound is the law's: what was measured along x turns away from x at a reversal, and the logger's
filter draws it through zero there. Forces are measured with noise, so with equal pads yaw only makes the velocities
noisier: use it only where it improves the fit.
"""

import numpy as np

from slipwise.arrays import Array
from slipwise.jobs.machine_code import kept
from slipwise.relations.run_data import FitRun
from slipwise.rig import Specimen

#: Below this speed friction also holds the girder's yaw [m/s].
_SLOW = 1e-4
#: Steps per sample: at a reversal friction lets the girder yaw for some milliseconds only.
_STEPS = 4


@kept()
def _integrate(torque, bound, velocity, places, slow, stiffness, inertia, held, dt, angle, rate):  # pragma: no cover
    """Step the yaw by the implicit rule, which no damping can upset, between samples along straight lines."""
    psi = 0.0
    w = 0.0
    step = dt / _STEPS
    for i in range(len(torque)):
        before = max(i - 1, 0)
        if held[i]:
            w = 0.0
        else:
            for part in range(1, _STEPS + 1):
                now = part / _STEPS
                then = 1.0 - now
                along = now * velocity[i] + then * velocity[before]
                moment = now * torque[i] + then * torque[before] - stiffness * psi
                damping = 0.0
                for p in range(bound.shape[1]):
                    friction = now * bound[i, p] + then * bound[before, p]
                    speed = np.hypot(along - places[p, 1] * w, places[p, 0] * w)
                    damping += friction * places[p, 0] ** 2 / max(speed, slow)
                w = (w + step * moment / inertia) / (1.0 + step * damping / inertia)
                psi += step * w
        angle[i] = psi
        rate[i] = w


def compute_yaw(run: FitRun, specimen: Specimen, force: Array, bound: Array, buffers: Array) -> tuple[Array, Array]:
    """Return yaw [rad] and its rate [rad/s], (n,) each.

    Args:
        run: its times and velocities.
        specimen: places of pads and buffers, centre of gravity, inertia.
        force: (n, n_pads) measured friction along x [N].
        bound: (n, n_pads) friction of the pads whichever way they slide [N].
        buffers: (n, n_buffers) force of the girder on each buffer if it did not turn [N].
    """
    pads = np.array(specimen.pad_places)
    torque = force @ (pads[:, 1] - specimen.centre_y)
    stiffness = 0.0
    if specimen.buffer_stiffness:
        sides = np.array(specimen.buffer_places)[:, 1] - specimen.centre_y
        torque = torque + buffers @ sides
        along = np.array(specimen.buffer_places)[:, 0] - specimen.centre_x
        across = np.array([buffer.stiffness_y for buffer in specimen.buffers])
        stiffness = float(np.array(specimen.buffer_stiffness) @ sides**2 + across @ along**2)
    places = pads - np.array([specimen.centre_x, specimen.centre_y])
    angle, rate = np.zeros(len(torque)), np.zeros(len(torque))
    stuck, inertia = run.states.stuck, specimen.inertia[2]
    _integrate(torque, bound, run.velocity, places, _SLOW, stiffness, inertia, stuck, run.dt, angle, rate)
    return angle, rate
