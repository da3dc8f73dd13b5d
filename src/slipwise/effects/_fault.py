"""What a gauge's fault declares for the audit of the instruments: its words, its sizes and its forms."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from fnmatch import fnmatchcase

from slipwise.channels import channel
from slipwise.short_repr import short_repr

#: Faults that the samples show by themselves.
SAMPLE_FAULTS: tuple[str, ...] = (
    "wild",
    "dead",
    "upper rail",
    "lower rail",
    "held",
    "lost",
    "gap",
    "turned",
    "scaled",
    "shifted",
    "late",
)


@short_repr
@dataclass(frozen=True)
class GaugeFault:
    """What an audit needs to know of a gauge's fault; its size is the first parameter of the effect.

    Attributes:
        says: what is wrong, as it stands after the channel's name, with "{size}" in it.
        settled_by: the measurement that settles it for good.
        shown: factor and unit in which people read its size, where that is not usual for its SI unit.
        unit: SI unit of its size; "channel" or "channel/s" where the parameter counts it in spans of the gauge.
        least: size from which it matters to somebody who looks for friction, by unit or name of the channel.
        step: small size at which its signature is taken; the least size where it is not given.
        forms: words that follow the channel's name -> values of the other parameters.
        scales: whether it scales the channel with its noise, so that it would explain noise by shrinking it.
        samples: what samples may show of it, of `SAMPLE_FAULTS`.
    """

    says: str
    settled_by: str
    shown: tuple[float, str] | None = None
    unit: str = "1"
    least: Mapping[str, float] = field(default_factory=dict[str, float])
    step: float | None = None
    forms: Mapping[str, Mapping[str, float]] = field(default_factory=lambda: {"": dict[str, float]()})
    scales: bool = False
    samples: tuple[str, ...] = ()

    def least_on(self, name: str) -> float:
        """Return the least size that matters on a channel; the first word of `least` that fits it counts.

        Args:
            name: of the channel.
        """
        unit = channel(name).unit
        return next(size for word, size in self.least.items() if word == unit or fnmatchcase(name, word))
