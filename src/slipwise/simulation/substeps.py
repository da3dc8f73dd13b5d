"""Runs a simulation chunk by chunk, in either engine, and in finer steps where a pad lifts or is about to.

A pad that lands is stopped by its spring within some milliseconds. A chunk in which a pad's load comes near zero is
therefore thrown away and made again in steps of `FINE`; all others cost what they always do.
"""

from collections.abc import Callable
from typing import Protocol

import mujoco
import numpy as np
from mujoco.batch import Batch
from mujoco.batch import SimulationError as BatchError

from slipwise.arrays import Array
from slipwise.rig import Rig
from slipwise.rig.statics import at_rest
from slipwise.simulation.kernel import Kernel, installed, places
from slipwise.simulation.steps import model_for_kernel, start_state

#: Time between two looks at the loads, at progress and at the health of a simulation [s].
CHUNK = 0.5
#: Largest step [s] where a pad is about to lift. Against an integration from event to event (tests/physics/
#: test_uplift.py) hops dissipate up to 2.7 % too much or too little at 0.5 ms, up to 0.2 % at this step.
FINE = 5e-5
#: A pad is about to lift where its load falls below this share of its load at rest [1].
NEAR_LIFTING = 0.3
_GREW = "grew beyond all bounds"
#: What MuJoCo's warnings mean.
_MEANING = {
    mujoco.mjtWarning.mjWARN_INERTIA: "the rig's masses cannot be inverted",
    mujoco.mjtWarning.mjWARN_CONTACTFULL: "there are too many contacts",
    mujoco.mjtWarning.mjWARN_CNSTRFULL: "there are too many contacts and limits",
    mujoco.mjtWarning.mjWARN_BADQPOS: f"a position {_GREW}",
    mujoco.mjtWarning.mjWARN_BADQVEL: f"a velocity {_GREW}",
    mujoco.mjtWarning.mjWARN_BADQACC: f"an acceleration {_GREW}",
    mujoco.mjtWarning.mjWARN_BADCTRL: f"the table's command {_GREW}",
}


class _Simulation(Protocol):
    """One simulation: its state by MuJoCo's names, each an array that can be written."""

    state: dict[str, Array]

    def advance(self, model: mujoco.MjModel, control: Array) -> Array:
        """Make the steps of a command (n, 4); gives sensordata (n, n_sensors)."""
        ...

    def warnings(self) -> Array:
        """Count MuJoCo's warnings so far, in the order of `mujoco.mjtWarning`."""
        ...


class _Compiled:
    """A simulation with the compiled law."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._batch = Batch(model, 1, 1)
        names = ("time", "qpos", "qvel", "qacc_warmstart", "userdata")
        self.state = {name: self._batch.bind(name).reshape(-1) for name in names}

    def advance(self, model: mujoco.MjModel, control: Array) -> Array:
        self._batch.set_models(model)
        return self._batch.rollout(len(control), control[None], record=("sensordata",))["sensordata"][0]

    def warnings(self) -> Array:
        return self._batch.warning[0, :, 1]  # beside the place of the last one


class _Python:
    """A simulation with the law in plain Python."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._data = mujoco.MjData(model)
        self.state = {name: getattr(self._data, name) for name in ("qpos", "qvel", "qacc_warmstart", "userdata")}
        self.state["time"] = np.zeros(1)

    def advance(self, model: mujoco.MjModel, control: Array) -> Array:
        self._data.time = float(self.state["time"][0])
        out = np.empty((len(control), model.nsensordata))
        for i, command in enumerate(control):
            self._data.ctrl[:] = command
            mujoco.mj_step(model, self._data)
            out[i] = self._data.sensordata
        self.state["time"][0] = self._data.time
        return out

    def warnings(self) -> Array:
        return np.array([w.number for w in self._data.warning])


def run(law: Kernel, rig: Rig, numbers: Array, control: Array, each: Callable[[Array, Array, float], bool]) -> str:
    """Step a simulation.

    Args:
        law: the kernel, in either engine.
        rig: the compiled specimen.
        numbers: (size,) of `numbers_for`; holds the final memory afterwards.
        control: (n_steps, 4) table acceleration [m/s^2, rad/s^2].
        each: called after every chunk with its sensordata (n, n_sensors), command (n, 4) and step [s], which is finer
            than the rig's where a pad is about to lift; stop if it answers False.

    Returns:
        "" or what MuJoCo reported when it stopped.
    """
    dt = float(rig.model.opt.timestep)
    finest = int(np.ceil(dt / FINE - 1e-9))
    models = {parts: model_for_kernel(rig, dt / parts) for parts in {1, finest}}
    loads = rig.user_sensor + 3 * np.arange(len(rig.specimen.pads))
    low = NEAR_LIFTING * float(at_rest(rig.specimen).load.min())
    simulation: _Simulation = _Compiled(models[1]) if law.callbacks else _Python(models[1])
    simulation.state["qpos"][:] = start_state(rig)
    simulation.state["userdata"][:] = numbers
    length, step = max(round(CHUNK / dt), 1), dt
    with installed(law):
        for first in range(0, len(control), length):
            start = {name: values.copy() for name, values in simulation.state.items()}
            for parts in sorted(models):
                command = _between(control, first, min(length, len(control) - first), parts)
                _restore(simulation, start, step, dt / parts)
                try:
                    out = simulation.advance(models[parts], command)
                except BatchError as error:
                    return str(error)
                if not np.any(out[:, loads] < low):
                    break
            step = dt / parts
            going = each(out, command, step)
            if simulation.warnings().any():
                return _warning(simulation.warnings())
            if not going:
                break
        numbers[:] = simulation.state["userdata"]
    return ""


def _restore(simulation: _Simulation, start: dict[str, Array], before: float, after: float) -> None:
    """Go back to the start of a chunk, and from one step [s] to another: velocities stand half a step before."""
    for name, values in start.items():
        simulation.state[name][:] = values
    if before != after:
        simulation.state["qvel"][:] += 0.5 * (before - after) * start["qacc_warmstart"]
        simulation.state["userdata"][places.DT] = after
        simulation.state["userdata"][places.RATE_AGE] = before + 0.5 * (before - after)


def _between(control: Array, first: int, count: int, parts: int) -> Array:
    """Return the command (count * parts, 4) at and between steps, which it joins by straight lines."""
    if parts == 1:
        return control[first : first + count]
    known = control[first : first + count + 1]
    at = np.arange(count * parts) / parts
    return np.stack([np.interp(at, np.arange(len(known)), column) for column in known.T], axis=1)


def _warning(counts: Array) -> str:
    """Say of what MuJoCo has warned; a kind of a later version by its own name."""
    kinds = [mujoco.mjtWarning(number) for number, count in enumerate(counts) if count]
    return "MuJoCo warned that " + " and ".join(_MEANING.get(kind, str(kind.name)) for kind in kinds)
