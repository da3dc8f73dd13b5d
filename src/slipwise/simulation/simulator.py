"""System level: a table motion in, the record of every channel out."""

import time
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np

from slipwise.arrays import Array
from slipwise.errors import SettingError
from slipwise.model import Model
from slipwise.record import Record
from slipwise.rig import Rig, build, check_step
from slipwise.simulation.energy import EnergyBook
from slipwise.simulation.kernel import ENGINES, Kernel, apply_rest, engine_for, kernel
from slipwise.simulation.kernel.layout import buffer_memories, pad_memories
from slipwise.simulation.predict import shaking, user_effects
from slipwise.simulation.result import Memory, Replay, SimulationDiverged
from slipwise.simulation.sensor_channels import to_channels
from slipwise.simulation.steps import numbers_for
from slipwise.simulation.substeps import run

#: A slip beyond this [m] is no longer a girder on a table.
_FAR = 5.0
#: A table that the girder pushes is shaken again by what the girder did, this often at most, until it moves alike [1].
_PASSES, _SETTLED = 8, 0.01
DT = 0.0005
OUTPUT_DT = 0.002


class _Collector:
    """Keeps every n-th sample and the sums that need every step."""

    def __init__(self, rig: Rig, control: Array, every: int) -> None:
        self.rig, self.control, self.every = rig, control, every
        self.dt = float(rig.model.opt.timestep)
        self.pitching = bool(np.any(control[:, 3]))
        self.uplift = 0.0
        self.book = EnergyBook(rig)
        self.parts: list[dict[str, Array]] = []
        self.done = 0
        count = len(rig.specimen.pads)
        self.load_low, self.load_high = np.full(count, np.inf), np.full(count, -np.inf)
        self.friction = np.zeros(count)
        self.slip_low, self.slip_high, self.slip_largest = np.full(2, np.inf), np.full(2, -np.inf), 0.0
        self.trouble = ""

    def add(self, sensordata: Array, control: Array, dt: float) -> bool:
        """Take a chunk (n, n_sensors), its command (n, 4) and its step [s]; False when it left all bounds."""
        fine = np.all(np.isfinite(sensordata), axis=1)
        if not fine.all():
            self.trouble = "a value is not a number any more"
            sensordata = sensordata[: int(np.argmin(fine))]
        if len(sensordata):
            self._take(sensordata, control[: len(sensordata)], dt)
        return not self.trouble

    def _take(self, sensordata: Array, control: Array, dt: float) -> None:
        channels = to_channels(self.rig, sensordata, control, dt, self.pitching)
        loads = np.stack([channels[f"pad_{p}_N"] for p in self.rig.specimen.pads], axis=1)
        frictions = [np.hypot(channels[f"pad_{p}_Fx"], channels[f"pad_{p}_Fy"]).max() for p in self.rig.specimen.pads]
        self.friction = np.maximum(self.friction, frictions)
        self.load_low = np.minimum(self.load_low, loads.min(axis=0))
        self.load_high = np.maximum(self.load_high, loads.max(axis=0))
        self.uplift += dt * np.count_nonzero(np.any(loads <= 0.0, axis=1))
        slip = np.stack([channels["slip_x"], channels["slip_y"]])
        self.slip_low = np.minimum(self.slip_low, slip.min(axis=1))
        self.slip_high = np.maximum(self.slip_high, slip.max(axis=1))
        self.slip_largest = max(self.slip_largest, float(np.hypot(*slip).max()))
        if self.slip_largest > _FAR:
            self.trouble = f"the slip grew beyond {_FAR:g} m"
        self.book.add(sensordata, control)
        split = round(self.dt / dt)
        kept = slice(split * ((-self.done) % self.every), None, split * self.every)
        self.parts.append({name: values[kept] for name, values in channels.items()})
        self.done += -(-len(sensordata) // split)

    def channels(self) -> dict[str, Array]:
        """Return every channel at the output rate."""
        if not self.parts:
            return to_channels(
                self.rig, np.empty((0, self.rig.model.nsensordata)), self.control[:0], self.dt, self.pitching
            )
        return {name: np.concatenate([part[name] for part in self.parts]) for name in self.parts[0]}


def simulate(
    model: Model,
    acceleration: Array,
    *,
    dt: float = DT,
    output_dt: float = OUTPUT_DT,
    engine: str = "compiled",
    start: Memory | None = None,
    rest: float = 0.0,
    provenance: dict[str, Any] | None = None,
    progress: Callable[[float], None] | None = None,
) -> Replay:
    """Shake a model.

    Args:
        model: specimen and effects.
        acceleration: (n, 3) of the table at every step: x, y, z [m/s^2].
        dt: step [s].
        output_dt: step of the record [s], a multiple of dt.
        engine: "compiled" or "python"; a user's effect that cannot be compiled takes the second, with a warning.
        start: what pads and buffers remember from the run before; nothing when not given.
        rest: pause since that run, or since the girder was put on its pads [s].
        provenance: goes into the record as it is.
        progress: called with the fraction done.

    Raises:
        SettingError: a step too large for the pads, an output step that is no multiple of it, an unknown engine.
        SimulationDiverged: it left every bound; the error holds the record so far.
    """
    check_step(model.built_specimen(), dt)
    every = round(output_dt / dt)
    if every < 1 or abs(every * dt - output_dt) > 1e-9:
        raise SettingError(f"the output step {output_dt * 1e3:g} ms must be a multiple of the step {dt * 1e3:g} ms")
    lasts = (len(acceleration) - 1) * dt
    if output_dt > lasts:
        raise SettingError(f"an output step of {output_dt:g} s leaves no record of {lasts:g} s; give a smaller one")
    began = time.perf_counter()
    own = user_effects(model)
    engine = engine_for(own) if engine == ENGINES[0] else engine
    law = kernel(engine, own)
    specimen = model.built_specimen()
    rig = build(specimen, dt, law.layout.size(specimen))
    report = progress or (lambda share: None)
    ready = time.perf_counter()

    def shaken(control: Array, kept: int) -> tuple[_Collector, Array, str]:
        numbers = _remember(law, model, numbers_for(law, rig, model, dt), start, rest)
        collector = _Collector(rig, control, kept)

        def each(sensordata: Array, command: Array, step: float) -> bool:
            going = collector.add(sensordata, command, step)
            report(collector.done / len(control))
            return going

        stopped = run(law, rig, numbers, control, each) or collector.trouble
        return collector, numbers, stopped

    girder = np.zeros(len(acceleration))
    control = shaking(model, acceleration, girder, dt)
    for _ in range(_PASSES if _feels_girder(model, acceleration, dt) else 0):
        before, first = control, shaken(control, 1)[0].channels()["girder_ax"]
        girder[: len(first)] = first
        control = shaking(model, acceleration, girder, dt)
        if np.abs(control - before).max() < _SETTLED * np.abs(control).max():
            break
    collector, numbers, stopped = shaken(control, every)
    seconds = (ready - began, time.perf_counter() - ready)
    answer = _answer(model, collector, law, numbers, dt, output_dt, engine, provenance, seconds)
    if stopped:
        raise SimulationDiverged(
            f"the simulation was stopped at {collector.done * dt:.3f} s: {stopped}. The record until then is kept. "
            "Try a smaller step (--step), a smaller motion (--scale) or check the model's values",
            answer,
        )
    return answer


def _feels_girder(model: Model, acceleration: Array, dt: float) -> bool:
    """Return whether an effect lets the girder push the table."""
    pushed, left = (shaking(model, acceleration[:2], np.full(2, push), dt) for push in (1.0, 0.0))
    return not np.array_equal(pushed, left)


def _remember(law: Kernel, model: Model, numbers: Array, start: Memory | None, rest: float) -> Array:
    if start is not None:
        pad_memories(law.layout, numbers)[:] = start.pads
        buffer_memories(law.layout, numbers)[:] = start.buffers
    if rest > 0.0:
        apply_rest(law.layout, numbers, model, rest)
    return numbers


def _answer(
    model: Model,
    collector: _Collector,
    law: Kernel,
    numbers: Array,
    dt: float,
    output_dt: float,
    engine: str,
    provenance: dict[str, Any] | None,
    seconds: tuple[float, float],
) -> Replay:
    channels = collector.channels()
    count = len(channels["slip_x"])
    about = {
        "made_by": "slipwise replay",
        "mujoco": mujoco.__version__,
        "rig": model.specimen.name,
        "model": {u.label: u.numbers for u in model.uses},
        "settings": {"dt": dt, "output_dt": output_dt, "engine": engine},
        **(provenance or {}),
    }
    record = Record(np.asarray(np.arange(count) * output_dt, dtype=np.float64), channels, about)
    for entry in model.with_hook("gauge"):
        record = entry.effect.hooks["gauge"](record, entry.target, **entry.values)
    pads = model.specimen.pads
    energy = collector.book.friction if collector.book.friction is not None else _pad_work(record, pads)
    return Replay(
        record=record,
        pad_energy=dict(zip(pads, map(float, energy.sum(axis=1)), strict=True)),
        uplift=float(collector.uplift),
        energy_error=collector.book.error(),
        energy_along=(float(energy[:, 0].sum()), float(energy[:, 1].sum())),
        slip_range=(float(collector.slip_low[0]), float(collector.slip_high[0])),
        slip_y_range=(float(collector.slip_low[1]), float(collector.slip_high[1])),
        largest_slip=collector.slip_largest,
        load_range={
            p: (float(a), float(b)) for p, a, b in zip(pads, collector.load_low, collector.load_high, strict=True)
        },
        largest_friction=dict(zip(pads, map(float, collector.friction), strict=True)),
        memory=Memory(pad_memories(law.layout, numbers).copy(), buffer_memories(law.layout, numbers).copy()),
        dt=dt,
        steps=collector.done,
        engine=engine,
        compiling=seconds[0],
        computing=seconds[1],
    )


def _pad_work(record: Record, pads: tuple[str, ...]) -> Array:
    """Work against friction along x and y (n_pads, 2) from the record, where slip is prescribed."""
    steps = {axis: np.diff(record[f"slip_{axis}"]) for axis in "xy"}
    out = np.zeros((len(pads), 2))
    for i, pad in enumerate(pads):
        for j, (axis, step) in enumerate(steps.items()):
            force = record[f"pad_{pad}_F{axis}"]
            out[i, j] = np.sum(0.5 * (force[1:] + force[:-1]) * step)
    return out
