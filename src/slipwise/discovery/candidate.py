"""What a screen has found: on which states a residual depends, and how that enters."""

from dataclasses import dataclass

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
        curve: over the states.
        share: of the residual above noise, of all relations that are screened, that it explains, each motion by what
            the others ask for [1].
    """

    states: tuple[DrivingState, ...]
    port: Port
    gate: Gate
    curve: ResidualCurve
    share: float

    @property
    def label(self) -> str:
        """In a few words."""
        gate = "" if self.gate.name == "all" else f", {self.gate.name}"
        return f"{' x '.join(s.label for s in self.states)}: {self.port.name}{gate}"
