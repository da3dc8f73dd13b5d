"""Component level: the laws driven by measured load, slip and speed, without a simulation."""

import inspect
import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from slipwise.arrays import Array
from slipwise.effects import RIG_MOTION, Effect, catalogue
from slipwise.model import Model
from slipwise.short_repr import short_repr
from slipwise.simulation.kernel import Kernel, apply_rest, begin_memory, engine_for, fill, kernel, places
from slipwise.simulation.kernel.layout import pad_blocks


@short_repr
@dataclass(frozen=True)
class PadForces:
    """What the pads' laws answer to measured states.

    Attributes:
        force: (n, n_pads, 2) force of the girder on each pad [N]; where a pad sticks and the model has no effect on
            port `stick`, only its bound is known and the force is the bound along the motion.
        bound: (n, n_pads) friction force that each pad could carry [N].
    """

    force: Array
    bound: Array


@dataclass
class Predictor:
    """A model's laws with their memory, run after run of a campaign.

    The memory goes on from one call to the next; `rest` lets a pause act on it, `reset` empties it.
    """

    model: Model
    law: Kernel
    numbers: Array

    def pads(
        self, time: Array, load: Array, velocity: Array, slip: Array, pads: Sequence[str] | None = None,
        motion: Array | None = None,
    ) -> PadForces:  # fmt: skip
        """Drive the pads' laws.

        Args:
            time: (n,) [s].
            load: (n, n_pads) [N].
            velocity: (n, n_pads, 2) slip rate at each pad [m/s].
            slip: (n, n_pads, 2) slip at each pad [m].
            pads: names of the pads in these columns; the first of the rig's when not given.
            motion: (n, 3) of the rig, see `campaign.rig_motion`; needed where `asks_for_motion`.
        """
        force, bound = np.zeros(velocity.shape), np.zeros(load.shape)
        motion = np.zeros((0, 3)) if motion is None else motion
        arrays = [np.ascontiguousarray(a, dtype=float) for a in (time, load, velocity, slip, motion)]
        own = self.model.specimen.pads
        columns = range(load.shape[1]) if pads is None else [own.index(pad) for pad in pads]
        arrays.append(np.array(columns, dtype=np.int64))
        drive, count = self.law.functions["pads_over_record"], load.shape[1]
        if self.law.engine == "compiled" and count > 1:
            half = count // 2
            other = _other_thread().submit(drive, self.numbers, *arrays, force, bound, half, count)
            drive(self.numbers, *arrays, force, bound, 0, half)
            other.result()
        else:
            drive(self.numbers, *arrays, force, bound, 0, count)
        return PadForces(force, bound)

    @cached_property
    def asks_for_motion(self) -> bool:
        """Whether one of the laws depends on the motion of the rig."""
        hooks = [hook for use in self.model.uses for hook in use.effect.instant_hooks.values()]
        return any(RIG_MOTION.keys() & inspect.signature(hook).parameters.keys() for hook in hooks)

    def buffers(self, time: Array, deflection: Array, rate: Array) -> Array:
        """Drive the buffers' laws with (n, n_buffers, 2) deflection [m] and rate [m/s]; gives their force [N]."""
        force = np.zeros(deflection.shape)
        arrays = [np.ascontiguousarray(a, dtype=float) for a in (time, deflection, rate)]
        self.law.functions["buffers_over_record"](self.numbers, *arrays, force)
        return force

    def rest(self, seconds: float) -> None:
        """Let a pause between two runs act on the memory."""
        apply_rest(self.law.layout, self.numbers, self.model, seconds)

    def begin(self, load: Array, velocity: Array, slip: Array, force: Array) -> None:
        """Let what a slider remembers agree with the force that was measured when its record began.

        Args:
            load: (n_pads,) [N].
            velocity: (n_pads, 2) [m/s].
            slip: (n_pads, 2) [m].
            force: (n_pads, 2) [N].
        """
        pad_blocks(self.law.layout, self.numbers)[: len(force), places.TRAIN_FORCE : places.TRAIN_FORCE + 2] = force
        entries = self.model.with_hook("begin")
        if not entries:
            return
        kept = self.numbers.copy()
        twice = [np.stack([each, each]) for each in (load, velocity, slip)]
        bound = self.pads(np.array([0.0, 1e-6]), twice[0], twice[1], twice[2]).bound[0]
        self.numbers[:] = kept
        begin_memory(self.law.layout, self.numbers, entries, force, bound)

    def reset(self) -> None:
        """Start from rest, nothing slid and nothing warm."""
        # made anew: a girder that bends has a storey more to remember than one that does not
        self.numbers = fill(self.law.layout, self.model, float(self.numbers[places.DT]))


@cache
def _other_thread() -> ThreadPoolExecutor:
    """Return a thread for half of the pads: the compiled law runs beside the one that asks."""
    return ThreadPoolExecutor(1)


if hasattr(os, "register_at_fork"):  # a child has no thread of its parent's: what it would ask of it never comes
    os.register_at_fork(after_in_child=_other_thread.cache_clear)


def predictor(model: Model, *, engine: str | None = None, dt: float = 0.002) -> Predictor:
    """Make a model's laws ready for records.

    Args:
        model: specimen and effects.
        engine: "compiled" or "python"; the compiled one where a user's effects can be compiled, if not given.
        dt: only a default for laws that ask for it before a record says it [s].
    """
    own = user_effects(model)
    law = kernel(engine or engine_for(own), own)
    return Predictor(model, law, fill(law.layout, model, dt))


def user_effects(model: Model) -> tuple[Effect, ...]:
    """Return the effects of a model that the catalogue does not hold."""
    known = catalogue()
    return tuple(
        u.effect for u in model.uses if u.effect.name not in known or known[u.effect.name].hooks is not u.effect.hooks
    )


def shaking(model: Model, acceleration: Array, girder: Array, dt: float) -> Array:
    """Return what the table does when it is told to move so, (n, 4): x, y, z [m/s^2], pitch [rad/s^2].

    Args:
        model: whose effects of the table act.
        acceleration: (n, 3) of the table as commanded or measured [m/s^2].
        girder: (n,) acceleration of the girder along x, which pushes the table back [m/s^2].
        dt: step [s].
    """
    out = np.zeros((len(acceleration), 4))
    out[:, :3] = acceleration
    for entry in model.with_hook("table"):
        out = entry.effect.hooks["table"](out, dt, girder, **entry.values)
    return out
