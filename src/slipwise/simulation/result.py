"""What a replay answers: the record, the sums over every step, and what pads and buffers remember."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from slipwise.arrays import Array
from slipwise.display import Drawn
from slipwise.errors import SimulationError
from slipwise.motion.table_motion import Steady, TableMotion
from slipwise.record import Record
from slipwise.short_repr import short_repr

if TYPE_CHECKING:
    from pandas import DataFrame

#: Cycles of a sine at full amplitude, the last ones, over which its slip is measured.
_CYCLES = 4


class SimulationDiverged(SimulationError):
    """A simulation that had to be stopped; `replay` holds what was recorded until then."""

    def __init__(self, message: str, replay: "Replay") -> None:
        super().__init__(message)
        self.replay = replay

    def __reduce__(self) -> tuple[type["SimulationDiverged"], tuple[str, "Replay"]]:
        """Return what makes it again: pickle, by which an error leaves a process, would give the message alone."""
        return type(self), (str(self), self.replay)


@short_repr
@dataclass(frozen=True)
class Memory:
    """What pads and buffers remember at the end of a run, for the run that follows.

    Attributes:
        pads: (n_pads, m) as the kernel lays it out.
        buffers: (n_buffers, 2, k) as the kernel lays it out.
    """

    pads: Array
    buffers: Array


@dataclass(frozen=True, repr=False)
class Replay(Drawn):
    """The answer of a model to a table motion.

    Attributes:
        record: every channel at the output rate.
        pad_energy: pad -> work against its friction [J], summed at every step.
        uplift: time during which at least one pad carried no load [s].
        energy_error: what the energy balance leaves open, as a fraction of the input [1]; None where slip is prescribed
            or the table turns.
        energy_along: (x, y) the same work of all pads along either direction [J].
        slip_range: smallest and largest slip_x, of every step [m].
        slip_y_range: the same of slip_y [m].
        largest_slip: along both directions together, of every step [m].
        load_range: pad -> smallest and largest load, of every step [N].
        largest_friction: pad -> largest |F|, of every step [N].
        memory: at the end, for a run that follows.
        dt: time step [s].
        steps: that were made.
        engine: that made them.
        compiling: time that the law and the rig took to be compiled or loaded [s].
        computing: time that the steps took [s].
    """

    record: Record
    pad_energy: dict[str, float]
    uplift: float
    energy_error: float | None
    energy_along: tuple[float, float]
    slip_range: tuple[float, float]
    slip_y_range: tuple[float, float]
    largest_slip: float
    load_range: dict[str, tuple[float, float]]
    largest_friction: dict[str, float]
    memory: Memory
    dt: float
    steps: int
    engine: str
    compiling: float
    computing: float

    def summary(self, motion: TableMotion) -> dict[str, Any]:
        """Return the numbers of summary.json; `motion` is what was replayed.

        Args:
            motion: what was replayed.
        """
        pads = {
            pad: {
                "N_min_kN": self.load_range[pad][0] / 1e3,
                "N_max_kN": self.load_range[pad][1] / 1e3,
                "F_max_kN": self.largest_friction[pad] / 1e3,
                "energy_kN_cm": self.pad_energy[pad] / 10.0,
            }
            for pad in self.load_range
        }
        return {
            "schema": 1,
            "rig": self.record.provenance["rig"],
            "motion": motion.title,
            "slip_x_half_range_mm": _slip_half_range(self.record, motion.steady) * 1e3,
            "slip_x_max_mm": max(map(abs, self.slip_range)) * 1e3,
            "slip_y_half_range_mm": _slip_half_range(self.record, motion.steady, "y") * 1e3,
            "slip_y_max_mm": max(map(abs, self.slip_y_range)) * 1e3,
            "slip_max_mm": self.largest_slip * 1e3,
            "energy_kN_cm": sum(p["energy_kN_cm"] for p in pads.values()),
            "energy_x_kN_cm": self.energy_along[0] / 10.0,
            "energy_y_kN_cm": self.energy_along[1] / 10.0,
            "pads": pads,
            "uplift_s": self.uplift,
            "energy_balance_error": self.energy_error,
            "dt_s": self.dt,
            "steps": self.steps,
            "wall_s": self.computing,
            "compile_s": self.compiling,
            "engine": self.engine,
        }

    def to_pandas(self) -> "DataFrame":
        """Return time and channels of the record as the columns of a pandas frame, SI.

        Raises:
            InputError: pandas is not installed.
        """
        return self.record.to_pandas()

    def _headline(self) -> str:
        low, high = self.slip_range
        return f"{self.record.provenance.get('rig', 'a rig')}, slip {1e3 * low:.4g} to {1e3 * high:.4g} mm"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {
                "pad": pad,
                "smallest load [N]": low,
                "largest load [N]": high,
                "largest friction [N]": self.largest_friction[pad],
                "energy [J]": self.pad_energy[pad],
            }
            for pad, (low, high) in self.load_range.items()
        ]


def _slip_half_range(record: Record, steady: Steady | None, axis: str = "x") -> float:
    """Half of largest minus smallest slip along an axis [m].

    Over the last four cycles at full amplitude of a sine, over the whole record otherwise.
    """
    slip = record[f"slip_{axis}"]
    if steady is not None:
        start = max(steady.start, steady.end - _CYCLES * steady.period)
        inside = (record.time >= start) & (record.time <= steady.end)
        if inside.any():
            slip = slip[inside]
    return float(np.ptp(slip) / 2.0)
