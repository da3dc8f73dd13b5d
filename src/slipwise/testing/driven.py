"""States that drive laws without a simulation, and everything that a model answers to them."""

from dataclasses import replace
from functools import cache

import numpy as np

from slipwise.effects import BalanceStates, Effect
from slipwise.model import EffectUse, Model, base_model
from slipwise.record import Record
from slipwise.rig import load_specimen
from slipwise.simulation.predict import predictor

#: A channel on which an instrument effect can be tried; those of load cells need a cell.
TARGET = "pad_A_Fx"


@cache
def bridge() -> Model:
    """Return Bridge 1 with the paper's law."""
    return base_model("bridge1")


@cache
def framed() -> Model:
    """Bridge 1 under a frame of two storeys."""
    specimen = replace(bridge().specimen, storeys=load_specimen("building").storeys)
    return replace(bridge(), specimen=specimen)


def base_of(effect: Effect) -> Model:
    """Bridge 1, with a frame on it where the effect is one of frames."""
    return framed() if "storeys" in effect.needs else bridge()


def with_effect(effect: Effect, values: dict[str, float] | None = None) -> Model:
    """The base model with one effect, at typical values unless told otherwise."""
    base = base_of(effect).without(effect.name) if effect.name in bridge() else base_of(effect)
    return base.adding(EffectUse(effect, values or effect.typical(), TARGET if effect.target else ""))


@cache
def motion(dt: float = 0.002, seconds: float = 1.5) -> dict[str, np.ndarray]:
    """Slip along and across with stretches of rest, loads that lift off, accelerations to match."""
    time = np.arange(round(seconds / dt)) * dt
    ramp = np.clip(time / 0.3, 0.0, 1.0)
    slip_x = ramp * (0.02 * np.sin(2 * np.pi * 2.0 * time) + 0.004 * np.sin(2 * np.pi * 7.3 * time))
    slip_y = ramp * 0.005 * np.sin(2 * np.pi * 1.3 * time + 0.4)
    still = (time > 0.8) & (time < 0.9)
    slip_x[still], slip_y[still] = slip_x[still][0], slip_y[still][0]
    slip = np.repeat(np.stack([slip_x, slip_y], axis=1)[:, None, :], 4, axis=1)
    velocity = np.gradient(slip, dt, axis=0)
    velocity[still] = 0.0
    rocking = np.array([1.0, -1.0, 1.0, -1.0]) * slip_x[:, None] / 0.02
    load = 24.5e3 * (1.0 + 0.4 * rocking + 0.2 * np.sin(2 * np.pi * 6.0 * time)[:, None])
    load[(time > 1.0) & (time < 1.02), 1] = 0.0
    rate_x = velocity[:, 0, 0]
    girder = np.stack([np.gradient(rate_x, dt), 0.0 * time, 2.0 * np.sin(2 * np.pi * 6.0 * time)], axis=1)
    table = np.stack([3.0 * np.sin(2 * np.pi * 2.0 * time), 0.1 * np.cos(9.0 * time), girder[:, 2]], axis=1)
    return {"time": time, "slip": slip, "velocity": velocity, "load": load, "girder": girder, "table": table}


def states(model: Model, moving: dict[str, np.ndarray], pads: np.ndarray, buffers: np.ndarray) -> BalanceStates:
    """Return what a hook `balance` is given: states, forces of pads (n, 4, 2) and buffers (n, 2, 2) [N]."""
    return BalanceStates(
        time=moving["time"],
        specimen=model.specimen,
        slip=moving["slip"][:, 0],
        velocity=moving["velocity"][:, 0],
        load=moving["load"],
        pad_force=pads,
        girder_acceleration=moving["girder"],
        table_acceleration=moving["table"],
        buffer_force=buffers.sum(axis=1),
        buffer_size=np.abs(buffers).sum(axis=1),
        heave_rate=1e-3 * np.cos(2 * np.pi * 6.0 * moving["time"]),
    )


def record(moving: dict[str, np.ndarray], pads: np.ndarray) -> Record:
    """Return the channels that gauges would have recorded, with forces of the pads (n, 4, 2) [N]."""
    channels = {f"pad_{p}_N": moving["load"][:, i] for i, p in enumerate("ABCD")}
    channels |= {f"pad_{p}_F{a}": pads[:, i, j] for i, p in enumerate("ABCD") for j, a in enumerate("xy")}
    channels |= {f"table_a{a}": moving["table"][:, i] for i, a in enumerate("xyz")}
    channels |= {"slip_x": moving["slip"][:, 0, 0], "girder_ax": moving["girder"][:, 0]}
    return Record(moving["time"], channels)


def answers(model: Model, engine: str = "compiled", moving: dict[str, np.ndarray] | None = None) -> dict[str, object]:
    """Everything a model says at component level: pads, buffers, drag, lift, specimen, table, channels, balances."""
    moving = moving or motion()
    dt = float(moving["time"][1] - moving["time"][0])
    laws = predictor(model, engine=engine, dt=dt)
    pads = laws.pads(moving["time"], moving["load"], moving["velocity"], moving["slip"])
    first_buffers = laws.buffers(moving["time"], moving["slip"][:, :2], moving["velocity"][:, :2])
    laws.rest(600.0)
    again = laws.pads(moving["time"], moving["load"], moving["velocity"], moving["slip"])
    drag, lift = laws.law.functions["girder_drag"], laws.law.functions["girder_lift"]
    girder = [(0.3, 0.1, 0.004, 0.01, 0.0, 0.0, dt), (-0.2, 0.0, -0.001, -0.02, 0.001, 1.0, dt)]
    out: dict[str, object] = {
        "pads": np.concatenate([pads.force.ravel(), pads.bound.ravel(), again.force.ravel()]),
        "buffers": first_buffers,
        "drag": np.array([drag(laws.numbers, *g) for g in girder]),
        "lift": np.array([lift(laws.numbers, 2e4, 1e3, *g) for g in girder]),
        "specimen": model.built_specimen(),
    }
    four = np.concatenate([moving["table"], 0.0 * moving["time"][:, None]], axis=1)
    seen = record(moving, pads.force)
    balance = {name: np.zeros(len(seen)) for name in ("heave", "pitch", "roll", "warp", "girder")}
    for entry in model.uses:
        hooks = entry.effect.hooks
        if "table" in hooks:
            four = hooks["table"](four, dt, moving["table"][:, 0], **entry.values)
        if "gauge" in hooks:
            seen = hooks["gauge"](seen, entry.target, **entry.values)
        if "balance" in hooks:
            added = hooks["balance"](
                states(model, moving, pads.force, first_buffers), target=entry.target, **entry.values
            )
            balance = {name: balance[name] + added.get(name, 0.0) for name in balance}
    return {**out, "table": four, "balance": balance, "channels": dict(seen.channels)}


def arrays(answer: dict[str, object]) -> dict[str, np.ndarray]:
    """Flatten answers to arrays by name; the specimen is left out."""
    flat: dict[str, np.ndarray] = {}
    for name, value in answer.items():
        if isinstance(value, np.ndarray):
            flat[name] = value
        elif isinstance(value, dict):
            flat |= {f"{name} {key}": part for key, part in value.items()}
    return flat
