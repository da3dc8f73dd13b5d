"""A table that follows its command whatever the girder does.

The table's joints have an armature of 1e10 kg (kg m^2), so that forces of the girder hardly move it. Hardly is not
enough where a mean force acts for long: 200 N m turn such a table by 8e-6 rad within half a minute, and the girder
slides down on it. What a step has left of the command is therefore added before MuJoCo integrates.
"""

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.places import TABLE_ARMATURE

#: The table's degrees of freedom come first: x, y, z, pitch.
_TABLE_DOFS = 4


@compilable
def follow_command(u: Array, command: Array, qacc: Array, constraint_force: Array) -> None:
    """Return the table exactly the acceleration that it is told.

    Args:
        u: the law's numbers.
        command: (4,) acceleration of the table along x, y, z and in pitch [m/s^2, rad/s^2].
        qacc: accelerations of the degrees of freedom [m/s^2, rad/s^2]; changed.
        constraint_force: generalised forces of all constraints [N, N m]; changed, for MuJoCo integrates from them where
            joints are damped.
    """
    for dof in range(_TABLE_DOFS):
        wanting = command[dof] - qacc[dof]
        qacc[dof] += wanting
        constraint_force[dof] += u[TABLE_ARMATURE] * wanting
