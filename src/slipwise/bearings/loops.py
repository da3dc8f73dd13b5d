"""The loop of one bearing: friction against slip over one cycle or one run, with load and speed at each sample."""

from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.bearings.cycles import Cycle
from slipwise.short_repr import short_repr

#: What all pads together are called.
SUM = "sum"


@short_repr
@dataclass(frozen=True)
class Loop:
    """Force against slip of one bearing.

    Several forces of one motion stand side by side: a measured one alone, or that of a law with those that other likely
    numbers of the law would give.

    Attributes:
        bearing: name of the pad, or `SUM`.
        zero: slip at which cycles begin [m].
        slip: (m,) along x [m].
        velocity: (m, 2) [m/s].
        load: (m,) compression [N]; NaN where it was not measured.
        area: of sliding [m^2].
        force: (m, d) along x, of the girder on the bearing, positive when sliding to +x [N].
    """

    bearing: str
    zero: float
    slip: Array
    velocity: Array
    load: Array
    area: float
    force: Array

    def of(self, cycle: Cycle) -> "Loop":
        """Return the part within a cycle."""
        parts = {name: cycle.cut(getattr(self, name)) for name in ("slip", "velocity", "load", "force")}
        return replace(self, **parts)

    def with_force(self, force: Array) -> "Loop":
        """Return the same motion with other forces (m, d) [N]."""
        return replace(self, force=force)

    @property
    def speed(self) -> Array:
        """Of the slip in any direction (m,) [m/s]."""
        return np.hypot(*self.velocity.T)

    @property
    def direction(self) -> Array:
        """Sign of the velocity along x (m,) [1]."""
        return np.sign(self.velocity[:, 0])

    @property
    def along(self) -> Array:
        """Share of the speed that is along x, which friction along x goes with (m,) [1]."""
        speed = self.speed
        return np.divide(np.abs(self.velocity[:, 0]), speed, out=np.ones_like(speed), where=speed > 0.0)
