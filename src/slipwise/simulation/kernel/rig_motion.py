"""Motion of the rig in a simulation, for laws that depend on it; `campaign.rig_motion` gives what was measured."""

from math import isnan

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.places import GIRDER_DOF, RATE_AGE, TABLE_DOF, TABLE_VELOCITY


@compilable
def rig_motion(u: Array, qvel: Array) -> tuple[float, float, float]:
    """Return girder's pitch rate over the table [rad/s], the table's velocity [m/s] and acceleration [m/s^2] along x.

    The acceleration of the step at hand is not known before it is solved: this is that of the step before.
    """
    rocking_rate = 0.0
    if int(u[GIRDER_DOF]) >= 0:
        rocking_rate = qvel[int(u[GIRDER_DOF + 4])]
    velocity = 0.0
    acceleration = 0.0
    if int(u[TABLE_DOF]) >= 0:
        velocity = qvel[int(u[TABLE_DOF])]
        if not isnan(u[TABLE_VELOCITY]):  # as it is in the first step
            acceleration = (velocity - u[TABLE_VELOCITY]) / u[RATE_AGE]
        u[TABLE_VELOCITY] = velocity
    return rocking_rate, velocity, acceleration
