"""A second, independent simulator of the rig: `simulate(settings, motion)` gives true, noise-free channels.

It shares no code with the library: penalty pads instead of contacts with constraints, a stiff elastic-plastic stick
instead of a friction-loss constraint, explicit 20 us steps instead of a solver.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise_benchmarks.law_drivers import fresh_driver
from slipwise_benchmarks.law_states import fresh_memory
from slipwise_benchmarks.motions import Motion
from slipwise_benchmarks.parts import HEIGHT, STIFFNESS, X, Y, buffer_table, pad_table, storey_table
from slipwise_benchmarks.rig_loop import run
from slipwise_benchmarks.rig_pads import MIDDLE, PER_PAD
from slipwise_benchmarks.settings import GRAVITY, Settings, buffers_of, pad_names, pads_of

Array = NDArray[np.float64]
STEP = 2.0e-5
EVERY = 10
SETTLE = 0.3
_PAD_MEMORY = 8
#: Settings that the loop reads as tables, or not at all.
_NOT_IN_LOOP = (
    "pads", "buffers", "storeys", "seating", "patch", "pad_factor", "law_pads", "run_levels", "uses",
)  # fmt: skip
_LONG_REST = 1800.0
#: Half-space of steel: dT = sqrt(D/pi)/ks * integral of q(t - u)/sqrt(u) du. Source: physics P3.
DIFFUSIVITY = 4.44e-6
CONDUCTIVITY = 18.0

_GIRDER: tuple[str, ...] = (
    *("table_ax", "table_ay", "table_az", "girder_ax", "girder_ay", "girder_az", "girder_az_1", "girder_az_2"),
    *("slip_x", "slip_y", "slip_vx", "slip_vy", "yaw", "pitch", "roll", "pitch_acceleration", "roll_acceleration"),
)


@dataclass
class Memory:
    """What survives from run to run: slid distance of each pad, largest excursion of each buffer; none: a new one.

    `of_library` is the same where the library shakes the rig.
    """

    distance: Array | None = None
    largest: Array | None = None
    of_library: Any = None

    def copy(self) -> "Memory":
        """Give the same, which another run may change."""
        return replace(self)


def carried_mass(settings: Settings) -> float:
    """Give the mass of all that the pads carry: the girder and its storeys [kg]."""
    return settings.mass + sum(storey.mass for storey in settings.storeys)


def columns(settings: Settings) -> tuple[str, ...]:
    """Give the names of the channels of a rig, in the order of the loop's columns."""
    pads = [
        f"pad_{pad}_{part}" for pad in pad_names(settings) for part in ("N", "Fx", "Fy", "vx", "Fx_base", "Fy_base")
    ]
    buffers = (f"buffer_{buffer.name}_F{axis}" for buffer in buffers_of(settings) for axis in "xy")
    floors = (f"storey_{number}_a{axis}" for number in range(1, len(settings.storeys) + 1) for axis in "xy")
    return (*_GIRDER, *pads, *buffers, *floors)


def heat_kernel(terms: int = 12) -> tuple[Array, Array]:
    """Give rates [1/s] and weights [K m^2/J] of exponentials that together make the half-space kernel.

    1/sqrt(u) = pi^-1/2 times the integral of s^-1/2 exp(-u s) ds, with equal steps of log s from 5e-5/s to 4000/s.
    """
    log_rates, spacing = np.linspace(np.log(5.0e-5), np.log(4.0e3), terms, retstep=True)
    rates = np.exp(log_rates)
    weights = np.sqrt(rates / np.pi) * spacing * np.sqrt(DIFFUSIVITY / np.pi) / CONDUCTIVITY
    return rates, weights


def rest_place(pads: Array, mass: float, centre: tuple[float, float]) -> Array:
    """Give the static place of the girder (x, y, z, roll, pitch, yaw): weight on springs of uneven height.

    Args:
        pads: (n, 11) rows of `slipwise_benchmarks.parts`.
        mass: of the girder [kg].
        centre: of gravity, from the middle of the table [m].
    """
    down = _lifts(pads, centre)
    weight = np.array([mass * GRAVITY, 0.0, 0.0])
    held = pads[:, STIFFNESS] * down
    lift = np.linalg.solve(held @ down.T, held @ pads[:, HEIGHT] - weight)
    return np.array([0.0, 0.0, lift[0], lift[1], lift[2], 0.0])


def rest_loads(pads: Array, mass: float, centre: tuple[float, float]) -> Array:
    """Give what the pads carry at rest, (n,) [N]; arguments as in `rest_place`."""
    lift = rest_place(pads, mass, centre)[2:5]
    return pads[:, STIFFNESS] * (pads[:, HEIGHT] - lift @ _lifts(pads, centre))


def _lifts(pads: Array, centre: tuple[float, float]) -> Array:
    """Give how z, roll and pitch lift the girder above each pad, (3, n)."""
    rx, ry = pads[:, X] - centre[0], pads[:, Y] - centre[1]
    return np.stack([np.ones(len(pads)), ry, -rx])


#: What `simulate` is: specimen, motion, memory, step [s] and steps for a row -> true channels.
Shaker = Callable[[Settings, Motion, Memory, float, int], dict[str, Array]]


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
        "time" [s] and `columns`, each (rows,), in SI units with the signs of the contract (N compression; Fx force of
        the girder on the pad, positive when sliding to +x; buffer force positive when the girder is at +x).
        "pad_A_vx" is the pad's true slip speed, "pad_A_Fx_base" what the base law makes of the pad's load and of the
        slip at the middle of the pads (with `yaw_known`: at the pad).
        Accelerations of the girder are what an accelerometer there feels, weight excluded; "pitch_acceleration" is
        relative to the table.
    """
    memory = Memory() if memory is None else memory
    p = settings
    storeys = storey_table(p.storeys)
    carried = carried_mass(p)
    pads = pad_table(pads_of(p), carried, p.seating, (p.pad_factor, p.patch, p.law_pads))
    buffers = buffer_table(buffers_of(p))
    rates, weights = heat_kernel()
    of_pads = np.zeros((len(pads), _PAD_MEMORY + rates.size))
    of_pads[:, 4] = _LONG_REST
    of_pads[:, 6] = 0.0 if memory.distance is None else memory.distance
    of_buffers = np.zeros((len(buffers), 4))
    of_buffers[:, 1] = 0.0 if memory.largest is None else memory.largest
    table = np.ascontiguousarray(np.stack([motion.ax, motion.ay, motion.az], axis=1))
    steps = int(round(motion.duration / step))
    out = np.zeros((-(-steps // every), MIDDLE + PER_PAD * len(pads) + 2 * len(buffers) + 2 * len(storeys)))
    settle = int(round(SETTLE / step))
    start = rest_place(pads, carried, (p.centre_x, p.centre_y))
    numbers = p._replace(**dict.fromkeys(_NOT_IN_LOOP, ()))
    memories = (of_pads, of_buffers, rates, weights, fresh_memory(carried * GRAVITY / len(pads), len(pads)))
    floors = np.zeros((len(storeys), 6))
    run(
        numbers, pads, buffers, storeys, start, table, motion.step, step, settle, steps, every, *memories,
        fresh_driver(), floors, out,
    )  # fmt: skip
    memory.distance = of_pads[:, 6].copy()
    memory.largest = of_buffers[:, 1].copy()
    channels = {name: np.ascontiguousarray(out[:, i]) for i, name in enumerate(columns(p))}
    time: Array = step * every * np.arange(out.shape[0], dtype=np.float64)
    return {"time": time, **channels}
