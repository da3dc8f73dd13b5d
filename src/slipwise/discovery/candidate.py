"""A curve that may be missing: on which states a residual depends, how that enters, and how much speaks for it."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from slipwise.arrays import Array
from slipwise.residual_map.curve import ResidualCurve
from slipwise.residual_map.ports import Gate, Port
from slipwise.residual_map.states import DrivingState
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class CurveCandidate:
    """A dependence on one state, or on two.

    Attributes:
        states: that drive it.
        port: how it enters.
        gate: on which pads, and which way.
        curve: over the states, everything else integrated out.
        share: of what is left without it, beside the same effects of the catalogue, that it explains, each motion by
            what the others ask for [1]; 0 where that makes them worse, and where nothing is left.
        evidence: by how much more likely the data are with it than with effects of the catalogue alone, its prior
            counted [nats].
        beside: label of every effect of the catalogue that is likely beside it -> values of its parameters.
        alike: effect -> share of the curve that it could explain alone [1].
        start: key -> value of the base numbers with it.
        points: states, then the height that the curve has to go through, of samples (n,) each; empty where not taken.
    """

    states: tuple[DrivingState, ...]
    port: Port
    gate: Gate
    curve: ResidualCurve
    share: float
    evidence: float = 0.0
    beside: Mapping[str, Mapping[str, float]] = field(default_factory=dict[str, Mapping[str, float]])
    alike: Mapping[str, float] = field(default_factory=dict[str, float])
    start: Mapping[str, float] = field(default_factory=dict[str, float])
    points: tuple[Array, ...] = ()

    @property
    def label(self) -> str:
        """In a few words."""
        gate = "" if self.gate.name == "all" else f", {self.gate.name}"
        return f"{' x '.join(s.label for s in self.states)}: {self.port.name}{gate}"
