"""What an effect may declare of itself beside its hooks: what a campaign must have, and on which gauges it sits."""

from collections.abc import Mapping
from dataclasses import dataclass, field

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
class Gauges:
    """On which of the channels in `moves` a gauge's fault is looked for.

    Attributes:
        sits: how it sits on gauges of one kind, one of `SITS`.
        reads: ending of a cell's channel -> ending of the other channel of that cell that it needs, e.g. "_Fx" -> "_N".
        balance_only: channels on which nothing but a girder's balances would show it, e.g. "pad_*_N"; "*" for all.
    """

    sits: str = "either"
    reads: Mapping[str, str] = field(default_factory=dict[str, str])
    balance_only: tuple[str, ...] = ()
