"""The paper's own analysis: the superstructure as one degree of freedom under eq. (7).

    m x'' = -m a_x - F - K x,        |F| <= law at load m (g + a_z) shared equally, at speed |x'|

No rocking (no Factor B), no springs under the pads, no rotation. Friction is set-valued: a step asks for the force that
stops the slip, and takes what the pads can give.

Source: paper, Seismic response under extremely large vertical ground motions.
"""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.model import Model
from slipwise.motion import TableMotion, resample
from slipwise.simulation.kernel import fill, kernel


@dataclass(frozen=True)
class OneDof:
    """What one degree of freedom does; all (n,).

    Attributes:
        time: [s].
        slip: [m].
        friction: of all pads [N].
        load: on all pads [N].
        energy: work against friction [J].
    """

    time: Array
    slip: Array
    friction: Array
    load: Array
    energy: float


def one_dof(model: Model, motion: TableMotion, dt: float = 0.0005) -> OneDof:
    """Shake a model as one degree of freedom; effects on the pads act with their memory, others do not.

    Args:
        model: specimen and law.
        motion: of the table; x and z are used.
        dt: step [s].
    """
    table = resample(motion, dt).acceleration
    specimen, law = model.built_specimen(), kernel()
    numbers = fill(law.layout, model, dt)
    bound_of, advance, memory = law.functions["pad_bound"], law.functions["pad_advance"], law.layout.first_pad
    remembers = bool(model.with_hook("advance"))
    pads, mass, stiffness = len(specimen.pads), specimen.mass, sum(specimen.buffer_stiffness)
    loads = np.maximum(mass * (specimen.gravity + table[:, 2]), 0.0)
    effective = mass + 0.25 * dt**2 * stiffness
    out = np.zeros((len(table), 2))
    slip = velocity = 0.0
    middle = 0.5 * (table[1:, 0] + table[:-1, 0])
    for i, (a_x, load) in enumerate(zip(middle.tolist(), loads[1:].tolist(), strict=True), start=1):
        pad = (load / pads, velocity, 0.0, slip, 0.0, 1.0, 1.0, i * dt, dt)
        bound = pads * bound_of(numbers, memory, *pad)
        push = (mass - 0.25 * dt**2 * stiffness) * velocity - dt * (mass * a_x + stiffness * slip)
        friction = min(max(push / dt, -bound), bound)
        new = (push - dt * friction) / effective
        if remembers and load > 0.0:
            advance(numbers, memory, bound / pads, abs(friction) / pads, *pad)
        slip += 0.5 * dt * (velocity + new)
        out[i] = slip, friction
        velocity = new
    energy = float(np.sum(out[1:, 1] * np.diff(out[:, 0])))
    return OneDof(np.arange(len(table), dtype=np.float64) * dt, out[:, 0], out[:, 1], loads, energy)
