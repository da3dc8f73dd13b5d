"""The frame of the step loop: floors that move sideways on columns, each over the one below.

A floor moves with the girder's frame, which turns, and beside it by u. Columns push it with k and c of the difference
to the floor below; what a floor is pushed by in all is what it pushes the girder back, at its own height:

    m_i a_i = S_i,    force on the girder -S_i at z_i,    and its weight m_i (g + a_z) stands at u_i.

Source: a shear building; Chopra, Dynamics of Structures, chapter 9.
"""

from numba import njit

from slipwise_benchmarks.parts import COLUMNS, DASHPOTS, FLOOR_MASS, FLOOR_Z

#: Columns of a floor's memory: place and speed beside the girder along x and y, and its absolute accelerations.
SWAY, SWAY_SPEED, FELT = 0, 2, 4


@njit(cache=True)
def frame_mass(storeys):
    """Mass of all floors [kg]."""
    mass = 0.0
    for i in range(storeys.shape[0]):
        mass += storeys[i, FLOOR_MASS]
    return mass


@njit(cache=True)
def frame_forces(storeys, floors, height, felt_z, total):
    """Add what the floors do to the girder to `total` (forces, then moments) and keep their accelerations.

    Args:
        storeys: (s, 4) rows of `slipwise_benchmarks.parts`.
        floors: (s, 6) memory of the floors; the accelerations are changed in place.
        height: of the centre of gravity above the sliding plane [m].
        felt_z: what an accelerometer on the girder feels upwards, at the step before [m/s^2].
        total: (6,) forces [N] and moments [N m] on the girder about its centre of gravity, changed in place.
    """
    count = storeys.shape[0]
    for axis in range(2):
        for i in range(count):
            row = storeys[i]
            off = floors[i, SWAY + axis] - (floors[i - 1, SWAY + axis] if i else 0.0)
            rate = floors[i, SWAY_SPEED + axis] - (floors[i - 1, SWAY_SPEED + axis] if i else 0.0)
            pull = row[COLUMNS] * off + row[DASHPOTS] * rate
            floors[i, FELT + axis] = -pull / row[FLOOR_MASS]
            if i:
                floors[i - 1, FELT + axis] += pull / storeys[i - 1, FLOOR_MASS]
    for i in range(count):
        mass, arm = storeys[i, FLOOR_MASS], storeys[i, FLOOR_Z] - height
        weight = mass * (9.80665 + felt_z)
        for axis in range(2):
            push = -mass * floors[i, FELT + axis]
            total[axis] += push
            # about +y: nose down at +x; about +x: up at +y
            turn = 1.0 if axis == 0 else -1.0
            total[4 - axis] += turn * (arm * push + weight * floors[i, SWAY + axis])


@njit(cache=True)
def sway(storeys, floors, height, felt, turn, step):
    """Move the floors on by a step.

    Args:
        storeys: as in `frame_forces`.
        floors: as there.
        height: as there.
        felt: what accelerometers at the girder's centre of gravity feel along x and y [m/s^2].
        turn: its angular accelerations about x and y in space [rad/s^2].
        step: [s].
    """
    for i in range(storeys.shape[0]):
        arm = storeys[i, FLOOR_Z] - height
        for axis in range(2):
            carried = felt[axis] + (arm * turn[1] if axis == 0 else -arm * turn[0])
            floors[i, SWAY_SPEED + axis] += step * (floors[i, FELT + axis] - carried)
            floors[i, SWAY + axis] += step * floors[i, SWAY_SPEED + axis]
