"""What a `balance` hook is given: measured states of a run, and what the model says of the buffers.

The balances of a rigid girder tie the instruments together without any law of friction:

    heave   sum N = m (g + a_z)                        + balance["heave"]
    pitch   (N_A + N_C) - (N_B + N_D) = ...            + balance["pitch"]
    roll    (N_A + N_B) - (N_C + N_D) = ...            + balance["roll"]
    warp    N_A - N_B - N_C + N_D = constant           + balance["warp"], of more pads also balance["warp_2"] ...
    girder  m a_x + sum F + F_buffers + balance["girder"] = 0

A hook returns what its effect adds, each (n,) [N]; what it does not name it does not touch.
"""

from dataclasses import dataclass

from slipwise.arrays import Array
from slipwise.rig import Specimen
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class BalanceStates:
    """Measured states of one run.

    Attributes:
        time: (n,) [s], uniform.
        specimen: the rig with the values of the fit at hand.
        slip: (n, 2) of the girder over the table at the sliding plane [m].
        velocity: (n, 2) its rate [m/s].
        load: (n, n_pads) [N].
        pad_force: (n, n_pads, 2) measured, of the girder on the pads [N]; zero across where it is not measured.
        girder_acceleration: (n, 3) absolute, at the centre of gravity [m/s^2].
        table_acceleration: (n, 3) absolute [m/s^2].
        buffer_force: (n, 2) of the girder on all buffers, as the model has it [N].
        buffer_size: (n, n_buffers) size of the force on each buffer [N].
        heave_rate: (n,) vertical rate of the girder over the table [m/s], up.
    """

    time: Array
    specimen: Specimen
    slip: Array
    velocity: Array
    load: Array
    pad_force: Array
    girder_acceleration: Array
    table_acceleration: Array
    buffer_force: Array
    buffer_size: Array
    heave_rate: Array
