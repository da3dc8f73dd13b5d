"""The other maker: the library's own replay shakes the rig, and its record becomes the true channels of a run.

`replayed` is what `rig_ode.simulate` is: specimen, motion and memory in, true channels out. Effects that hide are
those of the library's catalogue (`Settings.uses`); dirt of the rig is too. So a map from evidence to probability that
was learnt on one maker's campaigns is tested on the other's.

What the record lacks is derived from it: slip speeds of the pads, angular accelerations, and what the base law makes of
each pad's load and slip, by the law of the bench.
"""

import tempfile
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from slipwise.model import Model, base_model, use
from slipwise.motion import TableMotion
from slipwise.record import Record
from slipwise.rig import Specimen, load_specimen
from slipwise.simulation.replay import replay
from slipwise.simulation.result import SimulationDiverged
from slipwise_benchmarks.motions import Motion
from slipwise_benchmarks.rig_ode import Memory, columns
from slipwise_benchmarks.settings import Settings, pads_of
from slipwise_benchmarks.specimen_text import specimen_toml

Array = NDArray[np.float64]
#: Step of the library's simulation and of its rows [s]: it divides the interval of any logger.
STEP = 2.5e-4
#: Digits of an as-built specimen that the library reads.
_DIGITS = 12
_LONG_REST = 1800.0
#: Below this speed of slip a pad counts as stuck [m/s]. Assumed.
_STUCK = 1.0e-3
#: Where a girder is that a simulation has lost [m].
_FAR = 1.0


def replayed(settings: Settings, motion: Motion, memory: Memory, step: float, every: int) -> dict[str, Array]:
    """Shake the rig with the library and give the channels of `rig_ode.simulate`, one value every `STEP`.

    Args:
        settings: the rig with the effects of `settings.uses`; what else hides in it is for the second simulator.
        motion: of the table.
        memory: what is left from the runs before; changed in place.
        step: of the second simulator; the library has a step of its own.
        every: of the second simulator.
    """
    model = library_model(settings)
    rest = _LONG_REST if memory.of_library is not None else 0.0
    table = _table_motion(motion)
    try:
        answer = replay(model, table, dt=STEP, output_dt=STEP, start=memory.of_library, rest=rest)
        record, memory.of_library = answer.record, answer.memory
    except SimulationDiverged as error:
        record = _lost(error.replay.record, int(table.duration / STEP) + 1)
    half = 0.5 * settings.spacing_x
    edge = model.specimen.edge_distance
    turn = (record["girder_az_2"] - record["girder_az_1"]) / (2.0 * edge)
    nothing = np.zeros(len(record))  # a buffer without stiffness is no part of the library's rig
    out = {name: record[name] if name in record.channels else nothing for name in columns(settings)}
    out |= {
        # relative to the table, which may pitch; the edges' gauges feel the turn in space
        **{f"{way}_acceleration": np.gradient(np.gradient(record[way], STEP), STEP) for way in ("pitch", "roll")},
        "girder_az_1": record["girder_az"] - (half - settings.centre_x) * turn,
        "girder_az_2": record["girder_az"] + (half + settings.centre_x) * turn,
    }
    slip, speed = (np.stack([record[f"slip_{v}{axis}"] for axis in "xy"], axis=1) for v in ("", "v"))
    yaw_rate = np.gradient(record["yaw"], STEP)
    for pad in pads_of(settings):
        own = speed + yaw_rate[:, None] * np.array([-pad.y, pad.x])
        load = record[f"pad_{pad.name}_N"]
        curved = pad.curvature * load[:, None] * slip
        force = np.stack([record[f"pad_{pad.name}_F{axis}"] for axis in "xy"], axis=1) - curved
        base = _base_forces(settings, pad.area, load, force, own if settings.yaw_known else speed) + curved
        out |= {f"pad_{pad.name}_vx": own[:, 0]}
        out |= {f"pad_{pad.name}_F{axis}_base": base[:, i] for i, axis in enumerate("xy")}
    time = STEP * np.arange(len(record), dtype=np.float64)
    return {"time": time, **{name: out[name] for name in columns(settings)}}


def _lost(record: Record, count: int) -> Record:
    """Give the record of a simulation that was stopped, with a girder that is far away until the motion ends."""
    missing = (0, max(count - len(record), 0))
    channels = {name: np.pad(values, missing, mode="edge") for name, values in record.channels.items()}
    channels["slip_x"][len(record) :] = _FAR
    return Record(STEP * np.arange(len(record) + missing[1], dtype=np.float64), channels, record.provenance)


def _table_motion(motion: Motion) -> TableMotion:
    acceleration = np.stack([motion.ax, motion.ay, motion.az], axis=1)
    return TableMotion(motion.step, acceleration, "bench", ("x", "y", "z"))


def library_model(settings: Settings) -> Model:
    """Make the library's model of a specimen, with the effects that hide in it."""
    model = base_model(_specimen(settings._replace(uses=(), run_levels=(), pad_factor=(), clock=0.0)))
    level = settings.pad_factor[0]  # of this run; pads that differ are an effect of the library here
    law = {"strength": level * settings.s1, "rate": settings.n, "slow": level * settings.alpha}
    model = model.setting("shear_rate", **law).setting("contact_area", saturation=settings.k)
    return model.adding(*(use(one.effect, "", **dict(one.values)) for one in settings.uses))


@cache
def _specimen(settings: Settings) -> Specimen:
    # the second simulator turns about each axis alone, and lets a body have inertias that no body can have
    yaw = min(settings.inertia_yaw, 0.999 * (settings.inertia_roll + settings.inertia_pitch))
    settings = settings.changed(inertia_yaw=yaw)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "specimen.toml"
        path.write_text(specimen_toml(settings, _DIGITS), encoding="utf-8")
        return load_specimen(path)


def _base_forces(p: Settings, apparent: float, load: Array, force: Array, speed: Array) -> Array:
    """Give what the base law makes of a pad (n, 2) [N]; where it sticks, what is there, up to the bound.

    Args:
        p: base parameters.
        apparent: area of the pad [m^2].
        load: (n,) [N].
        force: (n, 2) that is there [N].
        speed: (n, 2) of slip [m/s].
    """
    magnitude = np.hypot(*speed.T)
    filled = 1.0 - np.exp(-p.k * load / apparent)
    bound = p.s1 * (1.0 - np.exp(-p.n * magnitude)) * apparent * filled + p.alpha * load
    sliding = magnitude > _STUCK
    way = np.where(sliding[:, None], speed, force)
    length = np.hypot(*way.T)
    size = np.where(sliding, bound, np.minimum(length, bound))
    return way * (size / np.maximum(length, 1.0e-12))[:, None]
