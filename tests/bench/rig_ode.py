"""A second, independent simulator of the rig: `simulate(settings, motion)` gives true, noise-free channels.

It shares no code with the library: penalty pads instead of contacts with constraints, a stiff elastic-plastic stick
instead of a friction-loss constraint, explicit 20 us steps instead of a solver.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from bench.law_drivers import fresh_driver
from bench.law_states import fresh_memory
from bench.motions import Motion
from bench.rig_loop import MIDDLE, PER_PAD, run
from bench.settings import GRAVITY, PAD_SIGN_X, PAD_SIGN_Y, PADS, Settings

Array = NDArray[np.float64]
STEP = 2.0e-5
EVERY = 10
SETTLE = 0.3
_PAD_MEMORY = 8
_LONG_REST = 1800.0
#: Half-space of steel: dT = sqrt(D/pi)/ks * integral of q(t - u)/sqrt(u) du. Source: physics P3.
DIFFUSIVITY = 4.44e-6
CONDUCTIVITY = 18.0

COLUMNS: tuple[str, ...] = (
    *("table_ax", "table_ay", "table_az", "girder_ax", "girder_ay", "girder_az", "girder_az_1", "girder_az_2"),
    *("slip_x", "slip_y", "slip_vx", "slip_vy", "yaw", "pitch", "roll", "pitch_acceleration", "roll_acceleration"),
    *(f"pad_{pad}_{part}" for pad in PADS for part in ("N", "Fx", "Fy", "vx", "Fx_base", "Fy_base")),
    *(f"buffer_{number}_F{axis}" for number in "12" for axis in "xy"),
)


@dataclass
class Memory:
    """What survives from run to run: slid distance and work of each pad, largest excursion of each buffer."""

    distance: Array = field(default_factory=lambda: np.zeros(4))
    largest: Array = field(default_factory=lambda: np.zeros(2))


def heat_kernel(terms: int = 12) -> tuple[Array, Array]:
    """Give rates [1/s] and weights [K m^2/J] of exponentials that together make the half-space kernel.

    1/sqrt(u) = pi^-1/2 times the integral of s^-1/2 exp(-u s) ds, with equal steps of log s from 5e-5/s to 4000/s.
    """
    log_rates, spacing = np.linspace(np.log(5.0e-5), np.log(4.0e3), terms, retstep=True)
    rates = np.exp(log_rates)
    weights = np.sqrt(rates / np.pi) * spacing * np.sqrt(DIFFUSIVITY / np.pi) / CONDUCTIVITY
    return rates, weights


def rest_place(settings: Settings) -> Array:
    """Give the static place of the girder (x, y, z, roll, pitch, yaw): weight on four springs of uneven height."""
    p = settings
    rx = 0.5 * p.spacing_x * np.array(PAD_SIGN_X) - p.centre_x
    ry = 0.5 * p.spacing_y * np.array(PAD_SIGN_Y) - p.centre_y
    down = np.stack([np.ones(4), ry, -rx])  # (3, 4): how z, roll and pitch lift the girder above each pad
    weight = np.array([p.mass * GRAVITY, 0.0, 0.0])
    lift = np.linalg.solve(p.pad_stiffness * down @ down.T, p.pad_stiffness * down @ np.array(p.seating) - weight)
    return np.array([0.0, 0.0, lift[0], lift[1], lift[2], 0.0])


def simulate(
    settings: Settings, motion: Motion, memory: Memory | None = None, step: float = STEP, every: int = EVERY
) -> dict[str, Array]:
    """Shake the rig and give its true channels, one value every `every` steps.

    Args:
        settings: the rig with its hidden effects.
        motion: table motion.
        memory: what is left from the runs before; changed in place. None: a new specimen.
        step: of the integration [s]; 20 us, half of it to see the numerical error.
        every: steps for a row of the result.

    Returns:
        "time" [s] and `COLUMNS`, each (rows,), in SI units with the signs of the contract (N compression; Fx force of
        the girder on the pad, positive when sliding to +x; buffer force positive when the girder is at +x).
        "pad_A_vx" is the pad's true slip speed, "pad_A_Fx_base" what the base law makes of the pad's load and of the
        slip at the middle of the pads (with `yaw_known`: at the pad).
        Accelerations of the girder are what an accelerometer there feels, weight excluded; "pitch_acceleration" is
        relative to the table.
    """
    memory = Memory() if memory is None else memory
    rates, weights = heat_kernel()
    pads = np.zeros((4, _PAD_MEMORY + rates.size))
    pads[:, 4] = _LONG_REST
    pads[:, 6] = memory.distance
    buffers = np.zeros((2, 4))
    buffers[:, 1] = memory.largest
    table = np.ascontiguousarray(np.stack([motion.ax, motion.ay, motion.az], axis=1))
    steps = int(round(motion.duration / step))
    out = np.zeros((-(-steps // every), MIDDLE + 4 * PER_PAD + 4))
    settle = int(round(SETTLE / step))
    start = rest_place(settings)
    memories = (fresh_memory(0.25 * settings.mass * GRAVITY), fresh_driver())
    run(settings, start, table, motion.step, step, settle, steps, every, pads, buffers, rates, weights, *memories, out)
    memory.distance = pads[:, 6].copy()
    memory.largest = buffers[:, 1].copy()
    channels = {name: np.ascontiguousarray(out[:, i]) for i, name in enumerate(COLUMNS)}
    time: Array = step * every * np.arange(out.shape[0], dtype=np.float64)
    return {"time": time, **channels}
