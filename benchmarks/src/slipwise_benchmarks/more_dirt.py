"""Dirt that a dirty campaign of `dirty_plan` has not; families of `families` have it.

Functions are as in `slipwise_benchmarks.dirt`. What no catalogue names (`UNNAMED`) stays below what is material.
"""

from typing import Any

import numpy as np

from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.settings import PADS, Settings

#: Runs of a campaign at most.
_RUNS = 5


def temperature(rng: np.random.Generator, scale: float, base: Settings) -> dict[str, Any]:
    """The hall is warmer in one run than in another: friction differs by about a per cent from run to run."""
    return {"run_levels": tuple(1.0 + 0.01 * scale * rng.normal(size=_RUNS))}


def cross_axis(rng: np.random.Generator, scale: float) -> list[Fault]:
    """Accelerometers are mounted some tenths of a degree off: each feels a share of what is along the other axis."""
    shares = 3.0e-3 * scale * rng.normal(size=2)
    return [
        Fault("cross_axis", ("girder_az",), float(shares[0]), "girder_ax"),
        Fault("cross_axis", ("table_az",), float(shares[1]), "table_ax"),
    ]


def clock_skew(rng: np.random.Generator, scale: float) -> list[Fault]:
    """Load cells are on a second logger, whose clock runs some tens of ppm fast or slow."""
    cells = tuple(f"pad_{pad}_{part}" for pad in PADS for part in ("N", "Fx", "Fy"))
    return [Fault("clock_skew", cells, float(rng.choice([-1.0, 1.0])) * 3.0e-5 * scale)]


#: name -> law of the rig, and of gauges.
MORE_RIG_DIRT = {"temperature": temperature}
MORE_GAUGE_DIRT = {"cross_axis": cross_axis, "clock_skew": clock_skew}
#: What a verdict has no name for.
UNNAMED = frozenset({"temperature", "cross_axis"})
