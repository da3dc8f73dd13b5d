"""Many short simulations at once, each started from a measured state (multiple shooting).

A free run that sticks a millisecond late is wrong from there on, although nothing is wrong with the law. Windows that
start again from what was measured keep such an error from swamping everything.
"""

from dataclasses import dataclass

import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from slipwise.kernel import installed, kernel
from slipwise.kernel.layout import buffer_memories, pad_memories
from slipwise.model import Model
from slipwise.predict import user_effects
from slipwise.replay.channels import to_channels
from slipwise.replay.run import DT, Memory
from slipwise.replay.steps import numbers_for, start_state, without_springs
from slipwise.rig import build

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Windows:
    """What is shaken, window by window.

    Attributes:
        acceleration: (w, n, 3) of the table at every step [m/s^2].
        slip: (w, 2) at the start, at the sliding plane [m].
        velocity: (w, 2) at the start [m/s].
        memory: what pads and buffers remember at the start, one per window; None: nothing.
        start: (w,) time of the run at which each window starts [s].
    """

    acceleration: Array
    slip: Array
    velocity: Array
    memory: tuple[Memory, ...] | None
    start: Array


def simulate_windows(
    model: Model, windows: Windows, *, dt: float = DT, every: int = 4, threads: int = 2
) -> list[dict[str, Array]]:
    """Shake all windows side by side.

    Args:
        model: specimen and effects (those on port `gauge` are left to the caller).
        windows: what to shake, all of the same length.
        dt: step [s].
        every: steps per sample of the answer.
        threads: to step on.

    Returns:
        For each window the channels, (n / every,) each; a window that MuJoCo had to stop holds NaN.
    """
    law = kernel("compiled", user_effects(model))
    rig = build(model.built_specimen(), dt, law.layout.size)
    count, steps = windows.acceleration.shape[:2]
    control = np.zeros((count, steps, 4))
    control[:, :, :3] = windows.acceleration
    for entry in model.with_hook("table"):
        control = np.stack([entry.effect.hooks["table"](one, dt, **entry.values) for one in control])
    numbers = np.repeat(numbers_for(law, rig, model, dt)[None], count, axis=0)
    if windows.memory is not None:
        for row, memory in zip(numbers, windows.memory, strict=True):
            pad_memories(law.layout, row)[:] = memory.pads
            buffer_memories(law.layout, row)[:] = memory.buffers
    with without_springs(rig) as compiled:
        batch = Batch(compiled, count, threads)
        batch.bind("qpos")[:] = start_state(rig)
        for axis in range(2):
            joint = compiled.joint("girder_x" if axis == 0 else "girder_y")
            batch.bind("qpos")[:, int(compiled.jnt_qposadr[joint.id])] += windows.slip[:, axis]
            batch.bind("qvel")[:, int(joint.dofadr[0])] = windows.velocity[:, axis]
        batch.bind("time")[:] = windows.start
        batch.bind("userdata")[:] = numbers
        with installed(law):
            out = batch.rollout(steps, control, record=("sensordata",))["sensordata"]
        stopped = batch.warning.reshape(count, -1).any(axis=1)
    out[stopped] = np.nan
    return [to_channels(rig, data[::every], command[::every]) for data, command in zip(out, control, strict=True)]
