"""Motion of the rig as it was measured, for laws that depend on it: how the girder rocks, and how the table moves.

Nobody measures how fast a stiff girder rocks on its pads: it is what the pads give way under the loads that they carry,
as the vertical rate of the girder is.
"""

import numpy as np
from scipy.integrate import cumulative_trapezoid

from slipwise.arrays import Array
from slipwise.campaign.states import States
from slipwise.signals.ends import in_frequency

#: Above this frequency what is left of the loads is noise, whose rate nobody wants [Hz].
_HIGHEST = 100.0


def shortening_rate(force: Array, dt: float, stiffness: float, lag: float) -> Array:
    """Return the rate at which a spring beside a damper gives way under a force.

    Args:
        force: (n,) [N].
        dt: step [s].
        stiffness: of the spring [N/m].
        lag: damping over stiffness [s]: the damper carries load before the spring has given way.
    """
    smooth = in_frequency(force, dt, lambda f: 1.0 / (1.0 + (f / _HIGHEST) ** 8) / (1.0 + 2j * np.pi * f * lag), 64)
    return np.gradient(smooth, dt) / stiffness


def rig_motion(states: States) -> Array:
    """Return what laws may know of the rig's motion (n, 3), in the order of `effects.RIG_MOTION`.

    The rocking rate [rad/s] of the girder over the table, positive where the pads at +x give way; velocity [m/s] and
    acceleration [m/s^2] of the table along x. What was not measured is zero.
    """
    out = np.zeros((len(states.time), 3))
    specimen = states.specimen
    arms = np.array(specimen.pad_places)[:, 0] - specimen.centre_x
    if specimen.free and states.pads == specimen.pads and specimen.pitch_stiffness > 0.0:
        lag = specimen.pad_damping / specimen.pad_stiffness
        out[:, 0] = shortening_rate(states.load @ arms, states.dt, specimen.pitch_stiffness, lag)
    table = np.nan_to_num(states.table_acceleration[:, 0])
    out[:, 1] = cumulative_trapezoid(table, dx=states.dt, initial=0.0)
    out[:, 2] = table
    return out
