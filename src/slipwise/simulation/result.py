"""What a replay answers: the record, the sums over every step, and what pads and buffers remember."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from slipwise.display import Drawn
from slipwise.errors import SimulationError
from slipwise.motion.table_motion import TableMotion
from slipwise.record import Record

if TYPE_CHECKING:
    from pandas import DataFrame

Array = NDArray[np.float64]


class SimulationDiverged(SimulationError):
    """A simulation that had to be stopped; `replay` holds what was recorded until then."""

    def __init__(self, message: str, replay: "Replay") -> None:
        super().__init__(message)
        self.replay = replay


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
        """Return the numbers of summary.json; `motion` is what was replayed."""
        from slipwise.simulation.summary import summary

        return summary(self, motion)

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
