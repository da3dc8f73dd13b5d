"""Many short simulations at once, each started from a measured state (multiple shooting).

A free run that sticks a millisecond late is wrong from there on, although nothing is wrong with the law. Windows that
start again from what was measured keep such an error from swamping everything.
"""

from dataclasses import dataclass

import mujoco
import numpy as np
from mujoco.batch import Batch

from slipwise.arrays import Array
from slipwise.model import Model
from slipwise.rig import Rig, build
from slipwise.simulation.kernel import Kernel, engine_for, installed, kernel
from slipwise.simulation.kernel.layout import buffer_memories, pad_memories
from slipwise.simulation.predict import shaking, user_effects
from slipwise.simulation.sensor_channels import to_channels
from slipwise.simulation.simulator import DT, Memory
from slipwise.simulation.steps import model_for_kernel, numbers_for, start_state

#: Samples between two pauses in which what lies between the samples is thrown away.
_CHUNK = 200


@dataclass(frozen=True)
class Windows:
    """What is shaken, window by window.

    Attributes:
        acceleration: (w, n, 3) of the table at every step [m/s^2].
        slip: (w, 2) at the start, at the sliding plane [m].
        velocity: (w, 2) at the start [m/s].
        memory: what pads and buffers remember at the start, one per window; None: nothing.
        start: (w,) time of the run at which each window starts [s].
        girder: (w, n) measured acceleration of the girder along x, where the table feels it [m/s^2]; None: it does not.
    """

    acceleration: Array
    slip: Array
    velocity: Array
    memory: tuple[Memory, ...] | None
    start: Array
    girder: Array | None = None


def simulate_windows(
    model: Model, windows: Windows, *, dt: float = DT, every: int = 4, threads: int = 2
) -> list[dict[str, Array]]:
    """Shake all windows of one model side by side, in one batch.

    Args:
        model: specimen and effects (those on port `gauge` are left to the caller).
        windows: what to shake.
        dt: step [s].
        every: steps per sample of the answer.
        threads: to step on.

    Returns:
        For each window the channels, (n / every,) each; a window that MuJoCo had to stop holds NaN.
    """
    own = user_effects(model)
    law = kernel(engine_for(own), own)
    specimen = model.built_specimen()
    rig = build(specimen, dt, law.layout.size(specimen))
    control = _control(model, windows, dt)
    run = _in_batch if law.callbacks else _one_by_one
    seen = run(law, rig, windows, _numbers(law, rig, model, windows, dt), control, every, threads)
    pitching = bool(np.any(control[..., 3]))
    return [to_channels(rig, *pair, dt, pitching) for pair in zip(seen, control[:, ::every], strict=True)]


def _control(model: Model, windows: Windows, dt: float) -> Array:
    girder = np.zeros(windows.acceleration.shape[:2]) if windows.girder is None else windows.girder
    return np.stack([shaking(model, *of, dt) for of in zip(windows.acceleration, girder, strict=True)])


def _numbers(law: Kernel, rig: Rig, model: Model, windows: Windows, dt: float) -> Array:
    numbers = np.repeat(numbers_for(law, rig, model, dt)[None], len(windows.start), axis=0)
    if windows.memory is not None:
        for row, memory in zip(numbers, windows.memory, strict=True):
            pad_memories(law.layout, row)[:] = memory.pads
            buffer_memories(law.layout, row)[:] = memory.buffers
    return numbers


def _start(rig: Rig, slip: Array, velocity: Array) -> tuple[Array, Array]:
    """Return positions (nq,) and velocities (nv,) at a measured slip (2,) and its rate (2,)."""
    position, rate = start_state(rig), np.zeros(rig.model.nv)
    for axis, name in enumerate(("girder_x", "girder_y")):
        joint = rig.model.joint(name)
        position[int(rig.model.jnt_qposadr[joint.id])] += slip[axis]
        rate[int(joint.dofadr[0])] = velocity[axis]
    return position, rate


def _in_batch(
    law: Kernel, rig: Rig, windows: Windows, numbers: Array, control: Array, every: int, threads: int
) -> Array:
    """Step all windows together; gives sensordata (windows, samples, sensors)."""
    count = len(windows.start)
    batch = Batch(model_for_kernel(rig, float(rig.model.opt.timestep)), count, threads)
    starts = [_start(rig, slip, velocity) for slip, velocity in zip(windows.slip, windows.velocity, strict=True)]
    batch.bind("qpos")[:] = np.stack([position for position, _ in starts])
    batch.bind("qvel")[:] = np.stack([rate for _, rate in starts])
    batch.bind("time")[:] = windows.start
    batch.bind("userdata")[:] = numbers
    parts = []
    with installed(law):
        for first in range(0, control.shape[1], _CHUNK * every):
            part = control[:, first : first + _CHUNK * every]
            parts.append(batch.rollout(part.shape[1], part, record=("sensordata",))["sensordata"][:, ::every])
    out = np.concatenate(parts, axis=1)
    out[batch.warning.reshape(count, -1).any(axis=1)] = np.nan
    return out


def _one_by_one(
    law: Kernel, rig: Rig, windows: Windows, numbers: Array, control: Array, every: int, threads: int
) -> Array:
    """Step one window after another with the law in plain Python, which no batch can take; answer as `_in_batch`."""
    out = np.empty((len(windows.start), -(-control.shape[1] // every), rig.model.nsensordata))
    compiled = model_for_kernel(rig, float(rig.model.opt.timestep))
    for window, start in enumerate(windows.start):
        data = mujoco.MjData(compiled)
        data.qpos[:], data.qvel[:] = _start(rig, windows.slip[window], windows.velocity[window])
        data.time, data.userdata[:] = start, numbers[window]
        with installed(law):
            for step, command in enumerate(control[window]):
                data.ctrl[:] = command
                mujoco.mj_step(compiled, data)
                if step % every == 0:
                    out[window, step // every] = data.sensordata
        if any(warning.number for warning in data.warning):
            out[window] = np.nan
    return out
