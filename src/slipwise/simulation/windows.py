"""Many short simulations at once, each started from a measured state (multiple shooting).

A free run that sticks a millisecond late is wrong from there on, although nothing is wrong with the law. Windows that
start again from what was measured keep such an error from swamping everything.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from slipwise.model import Model
from slipwise.rig import Rig, build
from slipwise.simulation.kernel import Kernel, engine_for, installed, kernel
from slipwise.simulation.kernel.layout import buffer_memories, pad_memories
from slipwise.simulation.predict import shaking, user_effects
from slipwise.simulation.sensor_channels import to_channels
from slipwise.simulation.simulator import DT, Memory
from slipwise.simulation.steps import model_for_kernel, numbers_for, start_state

Array = NDArray[np.float64]
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


def simulate_models(
    models: Sequence[Model], windows: Sequence[Windows], *, dt: float = DT, every: int = 4, threads: int = 2
) -> list[list[dict[str, Array]]]:
    """Shake the windows of many models side by side, in one batch.

    Args:
        models: of the same rig and effects, with values of their own (effects on port `gauge` are left to the caller).
        windows: of each model what to shake, all of the same length.
        dt: step [s].
        every: steps per sample of the answer.
        threads: to step on.

    Returns:
        For each model and window the channels, (n / every,) each; a window that MuJoCo had to stop holds NaN.
    """
    own = user_effects(models[0])
    law = kernel(engine_for(own), own)
    rigs = _rigs(models, dt, law)
    numbers = [_numbers(law, r, m, w, dt) for m, r, w in zip(models, rigs, windows, strict=True)]
    controls = [_control(m, w, dt) for m, w in zip(models, windows, strict=True)]
    run = _in_batch if law.callbacks else _one_by_one
    seen = run(law, rigs, windows, np.concatenate(numbers), np.concatenate(controls), every, threads)
    out, first = [], 0
    for rig, control in zip(rigs, controls, strict=True):
        part = seen[first : first + len(control)]
        pitching = bool(np.any(control[..., 3]))
        pairs = zip(part, control[:, ::every], strict=True)
        out.append([to_channels(rig, data, command, dt, pitching) for data, command in pairs])
        first += len(control)
    return out


def _rigs(models: Sequence[Model], dt: float, law: Kernel) -> list[Rig]:
    """Compile every specimen once; most models differ in numbers of the law only, which are no part of it."""
    made: list[Rig] = []
    out = []
    for model in models:
        specimen = model.built_specimen()
        rig = next((r for r in made if r.specimen == specimen), None)
        if rig is None:
            rig = build(specimen, dt, law.layout.size(specimen))
            made.append(rig)
        out.append(rig)
    return out


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
    law: Kernel, rigs: list[Rig], windows: Sequence[Windows], numbers: Array, control: Array, every: int, threads: int
) -> Array:
    """Step all windows of all models together; gives sensordata (all windows, samples, sensors)."""
    each = [(r, i, w) for r, w in zip(rigs, windows, strict=True) for i in range(len(w.start))]
    models = {id(rig): model_for_kernel(rig, float(rig.model.opt.timestep)) for rig in rigs}
    batch = Batch(models[id(rigs[0])], len(each), threads)
    if len(models) > 1:
        batch.set_models([models[id(rig)] for rig, _, _ in each])
    starts = [_start(rig, w.slip[i], w.velocity[i]) for rig, i, w in each]
    batch.bind("qpos")[:] = np.stack([position for position, _ in starts])
    batch.bind("qvel")[:] = np.stack([rate for _, rate in starts])
    batch.bind("time")[:] = np.concatenate([w.start for w in windows])
    batch.bind("userdata")[:] = numbers
    parts = []
    with installed(law):
        for first in range(0, control.shape[1], _CHUNK * every):
            part = control[:, first : first + _CHUNK * every]
            parts.append(batch.rollout(part.shape[1], part, record=("sensordata",))["sensordata"][:, ::every])
    out = np.concatenate(parts, axis=1)
    out[batch.warning.reshape(len(each), -1).any(axis=1)] = np.nan
    return out


def _one_by_one(
    law: Kernel, rigs: list[Rig], windows: Sequence[Windows], numbers: Array, control: Array, every: int, threads: int
) -> Array:
    """Step one window after another with the law in plain Python, which no batch can take; answer as `_in_batch`."""
    each = [(r, i, w) for r, w in zip(rigs, windows, strict=True) for i in range(len(w.start))]
    out = np.empty((len(each), -(-control.shape[1] // every), rigs[0].model.nsensordata))
    for row, (rig, i, w) in enumerate(each):
        compiled = model_for_kernel(rig, float(rig.model.opt.timestep))
        data = mujoco.MjData(compiled)
        data.qpos[:], data.qvel[:] = _start(rig, w.slip[i], w.velocity[i])
        data.time, data.userdata[:] = w.start[i], numbers[row]
        with installed(law):
            for step, command in enumerate(control[row]):
                data.ctrl[:] = command
                mujoco.mj_step(compiled, data)
                if step % every == 0:
                    out[row, step // every] = data.sensordata
        if any(warning.number for warning in data.warning):
            out[row] = np.nan
    return out
