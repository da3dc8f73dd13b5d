"""Faults that come before any balance: dead, late, reversed, tared channels, gravity in a gauge, the wrong rig."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.settings import GRAVITY, PADS

KINDS = ("dead", "late", "reversed", "tared", "gravity", "wrong_rig")
#: All cells are on a second logger that was started by hand; or one channel lags behind, for a buffer that is not read.
LATE_CELLS, LATE_CHANNEL = "late_cells", "late_channel"
_FORCES = tuple(f"pad_{pad}_Fx" for pad in PADS)
_LOADS = tuple(f"pad_{pad}_N" for pad in PADS)


@dataclass(frozen=True)
class First:
    """One of them.

    Attributes:
        kind: one of `KINDS`.
        channels: that it touches; none for the wrong rig.
        fault: what it does to them; None for the wrong rig.
    """

    kind: str
    channels: tuple[str, ...]
    fault: Fault | None

    def describe(self) -> dict[str, object]:
        """Give it as plain data."""
        said = {} if self.fault is None else self.fault.describe()
        return {"kind": self.kind, **said, "channels": list(self.channels)}


def draw_first(kind: str, names: Sequence[str], runs: int, rng: np.random.Generator) -> First:
    """Draw one.

    Args:
        kind: one of `KINDS`, `LATE_CELLS` or `LATE_CHANNEL`.
        names: channels that the campaign records.
        runs: in the campaign.
        rng: generator.
    """
    if kind == "wrong_rig":
        return First(kind, (), None)
    cells = tuple(name for name in names if name.startswith("pad_"))
    where: tuple[int, ...] = ()
    size, form = 0.0, ""
    if kind in (LATE_CELLS, LATE_CHANNEL):
        channels = cells if kind == LATE_CELLS else (str(rng.choice(cells)),)
        late = float(np.exp(rng.uniform(np.log(0.02), np.log(2.0))))
        return First("late", channels, Fault("late", channels, late))
    if kind == "dead":
        channels = (str(rng.choice([*_FORCES, *_LOADS])),)
        form = str(rng.choice(["constant", "noisy"]))
        size = 0.0 if rng.random() < 0.6 else float(rng.uniform(-3.0e3, 3.0e3))
        where = (int(rng.integers(runs)),) if rng.random() < 0.4 else ()
    elif kind == "late":
        groups = (cells, _LOADS, tuple(name for name in cells if "_F" in name))
        channels = groups[int(rng.choice(3, p=[0.6, 0.2, 0.2]))]
        size = float(np.exp(rng.uniform(np.log(0.1), np.log(5.0))))
    elif kind == "reversed":
        channels = (str(rng.choice(["slip_x", "girder_ax", "girder_az", "table_ax", *_FORCES, *_LOADS])),)
    elif kind == "tared":
        channels = _LOADS
    else:
        gauges = tuple(name for name in names if name in ("table_az", "girder_az", "girder_az_1", "girder_az_2"))
        channels = gauges if rng.random() < 0.5 else (str(rng.choice(gauges)),)
        size = float(rng.choice([-GRAVITY, GRAVITY]))
    return First(kind, channels, Fault(kind, channels, size, form, runs=where))
