"""What of a model another program has, in which form, and what it cannot say."""

import inspect
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from slipwise.effects import Effect
from slipwise.model import EffectUse, Model

#: States on which the friction models of other programs may depend; all else is the effect's own.
_STATES_OF_FRICTION = frozenset(
    ("area", "real_area", "apparent_area", "shear", "coefficient", "load", "pressure", "true_pressure", "speed")
)
WRITTEN, AVERAGED, LOST, GAUGE = "written", "as its mean", "left out", "not of the rig"


@dataclass(frozen=True)
class PartOfModel:
    """One effect of a model in another program.

    Attributes:
        effect: its label.
        state: "written", "as its mean", "left out" or "not of the rig".
        words: in which form, or why not.
        peak_slip: of our replay without the effect [m]; None where nothing is lost.
    """

    effect: str
    state: str
    words: str
    peak_slip: float | None = None


def list_parts(model: Model) -> list[PartOfModel]:
    """Return what becomes of every effect of a model."""
    return [PartOfModel(use.label, *_fate(use)) for use in model.uses]


def _fate(use: EffectUse) -> tuple[str, str]:
    hooks = use.effect.instant_hooks.keys()
    if "gauge" in use.effect.hooks and not hooks:
        return GAUGE, "a fault of a gauge: the laboratory's, not the bridge's"
    if "table" in use.effect.hooks:
        turning = (LOST, "the table's pitch: excitations are translations")
        return turning if _turns(use) else (WRITTEN, "in the motion")
    if hooks & {"stick", "stretch"}:
        return LOST, "how friction turns round: sliders of that program stick on a straight elastic line"
    if "lift" in hooks:
        return LOST, "vertical friction of keys, which goes with their horizontal force"
    if "pad" in hooks:
        return LOST, "a further force at the pads"
    if "face" in hooks:
        return _of_face(use)
    if hooks & {"deflection", "spring"}:
        return WRITTEN, "buffers: the backbone, dashpot and loop that come nearest in this motion"
    if "drag" in hooks:
        return WRITTEN, "a dashpot at the centre of gravity, linear at the speeds of this motion"
    if not hooks:
        return WRITTEN, "values of the rig"
    asked = _states_asked(use.effect)
    if "advance" in hooks or use.effect.memory or asked:
        beyond = "what a pad remembers" if use.effect.memory else ", ".join(sorted(asked)).replace("_", " ")
        return AVERAGED, f"friction models know speed and pressure, not {beyond}: its mean in this motion"
    return WRITTEN, "friction: the model that comes nearest"


def _of_face(use: EffectUse) -> tuple[str, str]:
    if not set(inspect.signature(use.effect.hooks["face"]).parameters) <= {"face", *use.values}:
        return LOST, "a curvature that changes with the state of the pad"
    return WRITTEN, "radius of the sliding face"


def _turns(use: EffectUse) -> bool:
    """Return whether an effect of the table turns it."""
    pushed = use.effect.hooks["table"](np.eye(4, 4), 1e-3, np.ones(4), **use.values)
    return bool(np.any(pushed[:, 3] != np.eye(4)[:, 3]))


def _states_asked(effect: Effect) -> frozenset[str]:
    """Return the states of a pad, beyond speed and pressure, on which an effect's friction depends."""
    asked = {name for hook in effect.instant_hooks.values() for name in inspect.signature(hook).parameters}
    return frozenset(asked) - _STATES_OF_FRICTION - {p.name for p in effect.parameters} - {"memory"}


def face_curvature(rated: float, model: Model, pad: str) -> float:
    """Return the curvature of a pad's face [1/m] with the effects on it that other programs can have."""
    curvature = rated
    for use in model.with_hook("face"):
        hook = use.effect.hooks["face"]
        known: Mapping[str, float] = {"face": curvature, **use.of_pad(pad)}
        asked = inspect.signature(hook).parameters
        if set(asked) <= set(known):
            curvature = float(hook(**{name: known[name] for name in asked}))
    return curvature
