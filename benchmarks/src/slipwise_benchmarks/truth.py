"""The answer of a campaign: what is hidden in it, and how large that is."""

from dataclasses import dataclass
from typing import Any

from slipwise_benchmarks.gauges import Logger
from slipwise_benchmarks.hidden import Hidden
from slipwise_benchmarks.settings import Settings


@dataclass(frozen=True)
class Truth:
    """The answer of one campaign.

    Attributes:
        name: of the folder.
        seed: that made it.
        rig: bridge1, bridge2, or drawn.
        rich: whether it has motion across and more gauges.
        size: small, medium or large; "" for a complete model.
        hidden: what the base model lacks.
        base: true base parameters.
        logger: what the chain did.
        floors: {"raw" or "after_fit": {balance: size in floors}}; see `slipwise_benchmarks.floors`.
        alone: member of a pair -> its largest balance after the fit when it is hidden alone [floors].
    """

    name: str
    seed: int
    rig: str
    rich: bool
    size: str
    hidden: Hidden
    base: Settings
    logger: Logger
    floors: dict[str, dict[str, float]]
    alone: dict[str, float]

    @property
    def missing(self) -> tuple[str, ...]:
        """Names that a verdict should give."""
        return self.hidden.missing

    @property
    def size_in_floors(self) -> float:
        """Largest of the balances before any base fit."""
        return max(self.floors["raw"].values())

    @property
    def size_after_fit(self) -> float:
        """Largest of the balances once each has been fitted by base parameters."""
        return max(self.floors["after_fit"].values())

    def as_dict(self) -> dict[str, Any]:
        """Give the answer as plain data, in the form of the practice campaigns and more."""
        base = self.base
        settings: dict[str, Any] = {
            "h": base.height,
            "Kb": 0.5 * base.buffer_stiffness,
            "s1": base.s1,
            "n": base.n,
            "k": base.k,
        }
        settings |= {"alpha": base.alpha, "mass": base.mass, "pad_stiffness": base.pad_stiffness}
        settings |= {"pad_damping": base.pad_damping, "inertia_pitch": base.inertia_pitch}
        if base.pads:
            settings |= {"pads": [pad._asdict() for pad in base.pads], "centre": [base.centre_x, base.centre_y]}
            settings |= {"buffers": [buffer._asdict() for buffer in base.buffers]}
        instruments = {fault.effect: fault.describe() for fault in self.hidden.faults}
        logger = {"lowpass": self.logger.lowpass, "order": self.logger.order, "phase": self.logger.phase}
        logger |= {"noise": self.logger.noise, "late": self.logger.late, "correlation": self.logger.correlation}
        return {
            "missing": list(self.missing),
            "settings": settings,
            "instruments": instruments,
            "details": self.hidden.details,
            "size": self.size,
            "size_in_floors": self.size_in_floors,
            "size_after_fit": self.size_after_fit,
            "floors": self.floors,
            "alone": self.alone,
            "seed": self.seed,
            "rig": self.rig,
            "rich": self.rich,
            "logger": logger,
        }
