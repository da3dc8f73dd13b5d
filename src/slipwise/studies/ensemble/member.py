"""One member of an ensemble: a model with drawn numbers, shaken by one motion at one scale."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from slipwise.effects import find_effect
from slipwise.errors import SettingError
from slipwise.model import Model, base_model, use
from slipwise.model.file import load_model
from slipwise.motion import TableMotion, load_motion, scale
from slipwise.rig.files import find_rig
from slipwise.short_repr import short_repr
from slipwise.simulation.replay import replay
from slipwise.simulation.simulator import Replay
from slipwise.studies.ensemble.distributions import with_values
from slipwise.studies.members import key_of, numbers_or_failure

LAWS = ("paper", "coulomb")


@short_repr
@dataclass(frozen=True)
class Base:
    """What all members share; words only, so that any process can make the model of it.

    Attributes:
        rig: a name of `slipwise rigs`, or the path of an MJCF file.
        law: "paper" or "coulomb".
        effects: names, or files of one's own, switched on at their typical size.
    """

    rig: str
    law: str = "paper"
    effects: tuple[str, ...] = ()

    def model(self) -> Model:
        """Make the model.

        Raises:
            UnknownNameError: a rig or an effect that does not exist.
            SettingError: no such law, or effects that cannot go together.
        """
        if self.law not in LAWS:
            raise SettingError(f"--law {self.law!r}: possible are {' and '.join(LAWS)}")
        model = base_model(self.rig, None if self.law == "paper" else ())
        return model.adding(*(use(name) for name in self.effects))

    def key(self) -> str:
        """Return a hash of what all members share, the code included."""
        files = [find_rig(self.rig), *(find_effect(name).path for name in self.effects)]
        contents = [hashlib.sha256(path.read_bytes()).hexdigest() for path in files]
        return key_of([self.law, contents], __name__)


@short_repr
@dataclass(frozen=True)
class FileBase:
    """What all members share, as a model.toml: any process that sees the file can make the model of it.

    Attributes:
        path: of the file. Effect files that it names are run: whoever makes a base has been trusted with them.
        digest: hash of the file, so that one that was written anew is another base.
    """

    path: str
    digest: str

    def model(self) -> Model:
        """Make the model.

        Raises:
            SlipwiseError: the file, or one that it names, cannot be read.
        """
        return load_model(self.path, trust=True)

    def key(self) -> str:
        """Return a hash of what all members share, the code included."""
        model = self.model()
        files = [model.specimen.path, *(use.effect.path for use in model.uses)]
        contents = [hashlib.sha256(path.read_bytes()).hexdigest() for path in files]
        return key_of([self.digest, contents], __name__)


@short_repr
@dataclass(frozen=True)
class Shaken:
    """One member.

    Attributes:
        base: the model without what is drawn.
        values: (key, value [SI]) of what is drawn.
        motion: of the table, unscaled: the description of a synthetic one, or what was read from files.
        factor: on its acceleration.
    """

    base: Base | FileBase
    values: tuple[tuple[str, float], ...]
    motion: TableMotion | str
    factor: float


def member_key(base: str, motion: str, factor: float, values: Mapping[str, float]) -> str:
    """Return a hash of everything that decides a member.

    Args:
        base: `Base.key()`.
        motion: `motion_key(...)`.
        factor: on the motion.
        values: that were drawn [SI].
    """
    return key_of([base, motion, factor, dict(values)], __name__)


def motion_key(motion: TableMotion) -> str:
    """Return a hash of what the table does."""
    return hashlib.sha256(np.float64(motion.dt).tobytes() + motion.acceleration.tobytes()).hexdigest()


def run_shaken(member: Shaken) -> dict[str, Any]:
    """Shake one member and keep its numbers; a simulation that diverges is a result too: "failed" says why.

    Returns:
        Numbers that JSON holds exactly, SI, by the names of `responses.RESPONSES`.
    """
    return numbers_or_failure(lambda: _shaken(member))


def _shaken(member: Shaken) -> dict[str, Any]:
    model = with_values(_model(member.base), dict(member.values))
    return _numbers(replay(model, scale(_motion(member.motion), member.factor)), model)


@lru_cache(maxsize=4)
def _model(base: Base | FileBase) -> Model:
    return base.model()


def _motion(given: TableMotion | str) -> TableMotion:
    return _synthetic(given) if isinstance(given, str) else given


@lru_cache(maxsize=4)
def _synthetic(description: str) -> TableMotion:
    return load_motion(description)


def _numbers(answer: Replay, model: Model) -> dict[str, Any]:
    record, pads = answer.record, model.specimen.pads
    lifted = np.array([record[f"pad_{pad}_N"] <= 0.0 for pad in pads]).any(axis=0)
    gaps = [u.values["clearance"] for u in model.uses if u.effect.name == "key_clearance"]
    buffers = [np.hypot(record[f"buffer_{b.name}_Fx"], record[f"buffer_{b.name}_Fy"]) for b in model.specimen.buffers]
    farthest = max(abs(end) for end in (*answer.slip_range, *answer.slip_y_range))
    return {
        "slip": answer.largest_slip,
        "slip_x": max(abs(end) for end in answer.slip_range),
        "residual_slip": float(np.hypot(record["slip_x"][-1], record["slip_y"][-1])),
        "pad_load": max(high for _, high in answer.load_range.values()),
        "buffer_force": max((float(force.max()) for force in buffers), default=0.0),
        "uplift": answer.uplift,
        "uplifts": int(np.count_nonzero(np.diff(lifted.astype(int), prepend=0) > 0)),
        "energy": sum(answer.pad_energy.values()),
        "buffer_hit": farthest > gaps[0] if gaps else None,
    }
