"""What an effect declares beside its hooks, in blocks: for a diagnosis, for a fault of a gauge, and rarely."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from slipwise.effects._fault import GaugeFault
from slipwise.short_repr import short_repr

#: What a campaign must have for an effect to be tested -> why it cannot be, where that is missing.
NEEDS: dict[str, str] = {
    "command": "the model is driven by the measured table motion; only the command could show it",
    "buffers": "no buffers, or neither girder_ax nor all pads' loads and friction to see them by",
    "balances": "needs the balances of a girder: load and friction of all pads, and accelerations",
    "heave": "needs girder_az and the loads of all pads",
    "across": "needs motion across, and friction of the pads along y",
    "prescribed slip": "the girder slides freely: no machine stands between gauge and contact",
    "storeys": "needs a specimen with storeys, the accelerations of all of them, and the balances of its base",
    "loads": "needs the loads of the pads, and none was measured",
    "several pads": "one slider only, or the friction of no single pad was measured",
    "both directions": "the slider moves one way only, so what leans on direction or place is one with friction",
    "changing load": "the load never changes, and it is then one with {steady}",
}
#: What every effect of a component needs.
COMPONENT_NEEDS: dict[str, tuple[str, ...]] = {
    "buffer": ("buffers",),
    "girder": ("balances",),
    "table": ("balances",),
    "pad load": ("balances", "loads"),
}
#: Roles in the base model: its law of friction, springs of the pads that it estimates, the elastic stick that it does.
BASE_ROLES: tuple[str, ...] = ("law", "springs", "stick")
#: How a fault sits on the gauges of one kind: on each alone or on all alike; on each alone; on a whole card of cells or
#: a single other gauge; on all cells of all pads at once.
SITS: tuple[str, ...] = ("either", "alone", "card", "pads")
#: The ends of a parameter's bounds.
ENDS: tuple[str, ...] = ("low", "high")


@dataclass(frozen=True)
class Limit:
    """An end of a parameter's bounds towards which an effect becomes a plainer thing.

    At that end itself it has no name of its own, and short of it only where it explains more than the plainer one.

    Attributes:
        parameter: of the effect.
        end: of its bounds, one of `ENDS`.
        becomes: the effect that it is there; "" for what the base model's own numbers do.
    """

    parameter: str
    end: str
    becomes: str = ""


@short_repr
@dataclass(frozen=True)
class ForDiagnosis:
    """What a diagnosis needs to know of an effect.

    Attributes:
        component: what it belongs to in a verdict, one of `COMPONENTS`.
        equation: in plain text, one line.
        moves: channels that it may change, e.g. "pad_*_Fx"; `*` stands for any pad or buffer.
        signature: how it shows, in words.
        confused_with: other effects -> the test that tells them apart.
        needs: what a campaign must have to test it, of `NEEDS`; what its component needs is known.
        limits: ends of its parameters' bounds at which it is another effect, or nothing beside the base model.
    """

    component: str
    equation: str
    moves: tuple[str, ...]
    signature: str
    confused_with: Mapping[str, str]
    needs: tuple[str, ...] = ()
    limits: tuple[Limit, ...] = ()


@short_repr
@dataclass(frozen=True)
class Gauges:
    """What a gauge's fault says: on which channels in `moves` it sits, and what an audit needs to know of it.

    Attributes:
        target: "channel" where the effect must be told which channel it acts on, else "".
        fault: what the audit of the instruments says of it, and looks for.
        sits: how it sits on gauges of one kind, one of `SITS`.
        reads: ending of a cell's channel -> ending of the other channel of that cell that it needs, e.g. "_Fx" -> "_N".
        balance_only: channels on which nothing but a girder's balances would show it, e.g. "pad_*_N"; "*" for all.
        shifts: whether it moves a channel in time as a whole, and its noise with it.
        lag: for what lets slow signals come late: the parameter that says by how much [s].
        plainer: for a filter: the effect that it is where its corner lies above all that was recorded.
        in_samples: for a fault that is found by looking at the samples, and not by a fit: why it cannot be found so
            where an actuator prescribes the slip.
    """

    target: str = ""
    fault: GaugeFault | None = None
    sits: str = "either"
    reads: Mapping[str, str] = field(default_factory=dict[str, str])
    balance_only: tuple[str, ...] = ()
    shifts: bool = False
    lag: str = ""
    plainer: str = ""
    in_samples: str = ""


@short_repr
@dataclass(frozen=True)
class Rare:
    """What few effects have to say; a new one seldom needs it.

    Attributes:
        steady: for an effect that needs a changing load: what it is one with where the load never changes, in words.
        exact: whether geometry leaves no other form of it than this: what it does not explain is then something else.
        replaces: for a law that takes the place of a simpler one: which; such an effect has no neutral value.
        adds: for a law that brings a share of its own: what scales friction as a whole, heat or wear or a patch of the
            plate, scales that share too, whichever was listed first.
        same_unless: other effects that are one thing with it -> what tells them apart where it was measured: "yaw", or
            a balance of the girder ("pitch").
        turns: whether it turns the girder about the vertical, so that yaw belongs to its fit; known of effects with a
            hook that asks for `side` or `side_y`.
        base: its role in the base model, of `BASE_ROLES`; springs are never missing by themselves.
        stands_for: numbers of the specimen or the base fit in whose place it comes, e.g. "rig.shear_strength".
        single: whether it may sit on one pad alone, whose load channel is then its target.
    """

    steady: str = "what does not follow the load"
    exact: bool = False
    replaces: str = ""
    adds: bool = False
    same_unless: Mapping[str, tuple[str, ...]] = field(default_factory=dict[str, tuple[str, ...]])
    turns: bool = False
    base: str = ""
    stands_for: tuple[str, ...] = ()
    single: bool = False
