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
#: Motion of the girder and of the table that a hook of the pads may ask for, in the order of `campaign.rig_motion`.
RIG_MOTION: dict[str, str] = {
    "rocking_rate": "of the girder over the table, its pitch about y [rad/s]",
    "table_velocity": "of the table along x [m/s]",
    "table_acceleration": "of the table along x, of the step before [m/s^2]",
}
#: Of the derived states, the ones that need a time constant, and those that a buffer has, of its deflection.
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
    "side_x": "where the pad stands along x: 1 at the farthest pad from the middle at +x, -1 at -x [1]",
    "side_y": "where the pad stands along y: 1 at the farthest pad from the middle at +y, -1 at -y [1]",
    "time": "since the start of the run [s]",
    "dt": "time since the instant before [s]",
    **DERIVED,
    **RIG_MOTION,
}
_FORCE_INPUTS: dict[str, str] = {
    "bound": "friction force that the pad can carry, s A_r [N]",
    "friction": "friction force that it carries now [N]",
}
BUFFER_INPUTS: dict[str, str] = {
    "deflection": "of the buffer in the direction at hand [m]",
    "rate": "of the deflection [m/s]",
    "stiffness": "of the buffer [N/m]",
    "side": "where the buffer stands across: 1 at the farthest from the middle at +y, -1 at -y [1]",
    "time": "since the start of the run [s]",
    "dt": "time since the instant before [s]",
    **{name: DERIVED[name] for name in DERIVED if name in _OF_BUFFERS},
}
GIRDER_INPUTS: dict[str, str] = {
    "velocity_x": "girder over table [m/s]",
    "velocity_y": "girder over table [m/s]",
    "velocity_z": "girder over table, up [m/s]",
    "slip_x": "of the girder, mean of its pads [m]",
    "slip_y": "of the girder, mean of its pads [m]",
    "time": "since the start of the run [s]",
    "dt": "time since the instant before [s]",
}


@dataclass(frozen=True)
class Hook:
    """What a hook may ask for.

    Attributes:
        inputs: name of the argument -> what it is; its own parameters and `memory` come to these.
        leading: of these, the ones that a hook of whole arrays is given in this order.
        memory: where its memory lives: "pad", "buffer" or nowhere "".
        instant: whether it is a hook of one instant, and compiled.
    """

    inputs: Mapping[str, str]
    leading: tuple[str, ...]
    memory: str
    instant: bool


def _hook(inputs: Mapping[str, str], own: Mapping[str, str], memory: str = "") -> Hook:
    return Hook({**own, **inputs}, tuple(own), memory, instant=True)


def _arrays(own: Mapping[str, str], memory: str = "") -> Hook:
    return Hook(own, tuple(own), memory, instant=False)


#: A hook that asks for one of these tells one side of the girder from the other.
SIDES: frozenset[str] = frozenset({"side", "side_y"})
#: Real area and true pressure are only known while the bound is being made.
_AFTERWARDS = {n: words for n, words in PAD_INPUTS.items() if n not in ("real_area", "true_pressure")}
_BOUND = {"bound": _FORCE_INPUTS["bound"]}
_RECORD = {"record": "the run so far, a Record", "target": "channel that it sits on, where EFFECT has a target"}
_PAD_ALONE = {"target": "load channel of the pad on which it sits alone, where EFFECT is `single`; else empty"}
_MEMORY = {"memory": "numbers that it remembers"}
HOOKS: dict[str, Hook] = {
    "area": _hook(PAD_INPUTS, {"real_area": PAD_INPUTS["real_area"]}, "pad"),
    "shear": _hook(PAD_INPUTS, {"shear": "shear strength of the contact so far [Pa]"}, "pad"),
    "coefficient": _hook(_AFTERWARDS, {"coefficient": "coefficient of friction so far [1]"}, "pad"),
    "stick": _hook(_AFTERWARDS, _BOUND, "pad"),
    "pad": _hook({**_AFTERWARDS, **_FORCE_INPUTS}, {}, "pad"),
    "face": _hook({}, {"face": "curvature of the pad's sliding face so far, 1/R [1/m]"}, "pad"),
    "advance": _hook({**_AFTERWARDS, **_FORCE_INPUTS}, {}, "pad"),
    "deflection": _hook(BUFFER_INPUTS, {"deflection": BUFFER_INPUTS["deflection"]}, "buffer"),
    "spring": _hook(BUFFER_INPUTS, {"force": "of the buffer so far [N]"}, "buffer"),
    "stretch": _hook({"load": PAD_INPUTS["load"]}, {"force": "that the loading train carries [N]"}),
    "lift": _hook(
        GIRDER_INPUTS,
        {"force_x": "on all buffers [N]", "force_y": "on all buffers [N]"},
        "buffer",
    ),
    "drag": _hook(GIRDER_INPUTS, {}),
    "rig": _arrays({"specimen": "the rig so far, a Specimen", **_PAD_ALONE}),
    "table": _arrays(
        {
            "acceleration": "(n, 4) of the table along x, y, z [m/s^2] and in pitch [rad/s^2]",
            "dt": "time between two rows [s]",
            "girder": "(n,) acceleration of the girder along x, where it is known [m/s^2]",
        }
    ),
    "gauge": _arrays(_RECORD),
    "undo": _arrays(_RECORD),
    "sharpen": _arrays(_RECORD),
    "corner": _arrays({}),
    "disturb": _arrays({"records": "of all runs, each a Record", "specimen": "the rated rig, a Specimen"}),
    "flat": _arrays({"coefficient": "coefficient of friction at any speed [1]"}),
    "balance": _arrays({"states": "measured states of one run, BalanceStates", **_PAD_ALONE}),
    "rest": _arrays({**_MEMORY, "seconds": "length of the pause [s]"}, "pad"),
    "begin": _arrays(
        {
            **_MEMORY,
            "share_x": "of the bound that the force is where the record begins [1]",
            "share_y": "the same across [1]",
            **_BOUND,
        },
        "pad",
    ),
}
#: Hooks of one pad at one instant: each pad may have parameters of its own there.
PAD_HOOKS: frozenset[str] = frozenset(name for name, hook in HOOKS.items() if hook.instant and hook.memory == "pad")
#: Ports in the order in which they act, with the hooks that an effect on them may have.
PORTS: dict[str, tuple[str, ...]] = {
    "rig": ("rig", "balance", "disturb"),
    "table": ("table", "balance", "disturb"),
    "area": ("area", "advance", "rest"),
    "shear": ("shear", "coefficient", "advance", "rest", "flat", "disturb"),
    "stick": ("stick", "shear", "advance", "rest", "begin"),
    "pad": ("pad", "face", "advance", "rest", "disturb"),
    "train": ("stretch",),
    "buffer": ("deflection", "spring", "lift", "balance", "rest", "disturb"),
    "girder": ("rig", "drag", "lift", "balance", "disturb"),
    "gauge": ("gauge", "undo", "sharpen", "corner"),
}
#: Ports of the friction of a pad: without friction nothing acts there.
FRICTION_PORTS: tuple[str, ...] = ("area", "shear", "stick", "pad", "train")
#: What an effect belongs to in a verdict.
COMPONENTS: tuple[str, ...] = ("pad friction", "pad load", "buffer", "girder", "table", "instrument")
