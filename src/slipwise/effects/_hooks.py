"""The ports at which effects act, the hooks that they may have there, and what a hook may ask for."""

from collections.abc import Mapping
from dataclasses import dataclass

#: States made from the others, see `simulation.kernel.derived_states`; a first-order lag is that of the effect's own
#: parameter `time_constant`.
DERIVED: dict[str, str] = {
    "speed_rate": "rate of the speed d|v|/dt [m/s^2]",
    "lagged_load": "load behind a lag of `time_constant` [N]",
    "load_rate": "rate of the load behind that lag [N/s]",
    "time_since_reversal": "time since the motion turned back [s]",
    "distance_since_reversal": "way slid since then [m]",
    "last_peak_speed": "largest speed of the stroke before [m/s]",
    "last_stroke": "length of the stroke before [m]",
    "slid": "distance slid since the pad was new [m]",
    "heat": "of friction per area, lost in `time_constant` [J/m^2]",
    "outward": "+1 away from the middle, -1 towards it [1]",
    "path_curvature": "of the path of slip in the plane [1/m]",
}
#: Of these, the ones that need a time constant, and those that a buffer has, of its deflection.
LAGGING: frozenset[str] = frozenset({"lagged_load", "load_rate", "heat"})
_OF_BUFFERS = DERIVED.keys() - LAGGING - {"path_curvature"}
PAD_INPUTS: dict[str, str] = {
    "load": "normal load N of the pad [N]",
    "pressure": "load over apparent area P [Pa]",
    "apparent_area": "of the pad A [m^2]",
    "real_area": "real area of contact A_r so far [m^2]",
    "true_pressure": "load over real area P_r [Pa]",
    "speed": "slip speed |v| [m/s]",
    "velocity_x": "slip rate [m/s]",
    "velocity_y": "slip rate [m/s]",
    "slip_x": "slip of the girder over the pad [m]",
    "slip_y": "slip of the girder over the pad [m]",
    "side_x": "+1 for pads A and C, -1 for B and D [1]",
    "side_y": "+1 for pads A and B, -1 for C and D [1]",
    "time": "since the start of the run [s]",
    "dt": "time since the instant before [s]",
    **DERIVED,
}
_FORCE_INPUTS: dict[str, str] = {
    "bound": "friction force that the pad can carry, s A_r [N]",
    "friction": "friction force that it carries now [N]",
}
BUFFER_INPUTS: dict[str, str] = {
    "deflection": "of the buffer in the direction at hand [m]",
    "rate": "of the deflection [m/s]",
    "stiffness": "of the buffer [N/m]",
    "side": "+1 for buffer 1, -1 for buffer 2 [1]",
    "time": "since the start of the run [s]",
    "dt": "time since the instant before [s]",
    **{name: DERIVED[name] for name in DERIVED if name in _OF_BUFFERS},
}
GIRDER_INPUTS: dict[str, str] = {
    "velocity_x": "girder over table [m/s]",
    "velocity_y": "girder over table [m/s]",
    "velocity_z": "girder over table, up [m/s]",
    "time": "since the start of the run [s]",
    "dt": "time since the instant before [s]",
}


@dataclass(frozen=True)
class Hook:
    """What a hook may ask for, and where its memory lives ("pad", "buffer" or nowhere "")."""

    inputs: frozenset[str]
    leading: tuple[str, ...]
    memory: str
    instant: bool


def _hook(inputs: Mapping[str, str], *leading: str, memory: str = "", instant: bool = True) -> Hook:
    return Hook(frozenset(inputs) | frozenset(leading), leading, memory, instant)


#: A hook that asks for one of these tells one side of the girder from the other.
SIDES: frozenset[str] = frozenset({"side", "side_y"})
#: Real area and true pressure are only known while the bound is being made.
_AFTERWARDS = {n: words for n, words in PAD_INPUTS.items() if n not in ("real_area", "true_pressure")}
HOOKS: dict[str, Hook] = {
    "area": _hook(PAD_INPUTS, "real_area", memory="pad"),
    "shear": _hook(PAD_INPUTS, "shear", memory="pad"),
    "coefficient": _hook(_AFTERWARDS, "coefficient", memory="pad"),
    "stick": _hook(_AFTERWARDS, "bound", memory="pad"),
    "pad": _hook({**_AFTERWARDS, **_FORCE_INPUTS}, memory="pad"),
    "advance": _hook({**_AFTERWARDS, **_FORCE_INPUTS}, memory="pad"),
    "deflection": _hook(BUFFER_INPUTS, "deflection", memory="buffer"),
    "spring": _hook(BUFFER_INPUTS, "force", memory="buffer"),
    "settle": _hook({**BUFFER_INPUTS, "force": ""}, memory="buffer"),
    "stretch": _hook({"load": PAD_INPUTS["load"]}, "force"),
    "lift": _hook(GIRDER_INPUTS, "force_x", "force_y", memory="buffer"),
    "drag": _hook(GIRDER_INPUTS),
    "rig": _hook({}, "specimen", instant=False),
    "table": _hook({}, "acceleration", "dt", "girder", instant=False),
    "gauge": _hook({}, "record", "target", instant=False),
    "undo": _hook({}, "record", "target", instant=False),
    "sharpen": _hook({}, "record", "target", instant=False),
    "corner": _hook({}, instant=False),
    "disturb": _hook({}, "records", instant=False),
    "flat": _hook({}, "coefficient", instant=False),
    "balance": _hook({}, "states", instant=False),
    "rest": _hook({}, "memory", "seconds", memory="pad", instant=False),
    "begin": _hook({}, "memory", "share_x", "share_y", "bound", memory="pad", instant=False),
}
#: Ports in the order in which they act, with the hooks that an effect on them may have.
PORTS: dict[str, tuple[str, ...]] = {
    "rig": ("rig", "balance", "disturb"),
    "table": ("table", "balance", "disturb"),
    "area": ("area", "advance", "rest"),
    "shear": ("shear", "coefficient", "advance", "rest", "flat", "disturb"),
    "stick": ("stick", "shear", "advance", "rest", "begin"),
    "pad": ("pad", "advance", "rest", "disturb"),
    "train": ("stretch",),
    "buffer": ("deflection", "spring", "settle", "lift", "balance", "rest", "disturb"),
    "girder": ("rig", "drag", "lift", "balance", "disturb"),
    "gauge": ("gauge", "undo", "sharpen", "corner"),
}
#: What an effect belongs to in a verdict.
COMPONENTS: tuple[str, ...] = ("pad friction", "pad load", "buffer", "girder", "table", "instrument")
