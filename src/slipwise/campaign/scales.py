"""The scales of a test: its stroke, its speed, its load and its pressure, over those of the reference rig.

What a girder's pads carry is known from its weight: forces and masses that a fit begins with, and may reach, and that
matter to anybody, go with it. Its slip and its speed are those of an earthquake, however heavy it is. One slider may be
rock that creeps by micrometres a second or a brake: its scales come from its own record, so that an answer does not
depend on the units, or on the size, of a test.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign.campaign import Campaign
from slipwise.campaign.zero_state import GRAVITY
from slipwise.rig import Specimen
from slipwise.units import powers_of

#: Of the reference rig: stroke from end to end [m], mean speed [m/s], load of a pad [N], and its pressure [Pa].
_STROKE, _SPEED, _LOAD, _PRESSURE = 0.1, 0.1, 24.5e3, 12.5e6
#: What a pad of the reference rig carries at rest: a quarter of 10 t [N].
_REST_LOAD = 2.5e3 * GRAVITY
#: Scales that a record shows are an order of magnitude: bounds are this much wider on both sides [1].
_ROOM = 10.0
#: Parts of a record whose means give its path, of so many samples at least: slip gauges are noisy [1].
_PARTS, _SAMPLES = 1000, 4


@dataclass(frozen=True)
class Scales:
    """How many times larger things are than in the reference rig.

    Attributes:
        length: stroke [1].
        speed: mean speed of slip [1].
        load: mean load of a pad [1].
        pressure: mean load over the pad's area [1].
        room: how much wider bounds are on both sides, for what is known of the scales [1].
    """

    length: float = 1.0
    speed: float = 1.0
    load: float = 1.0
    pressure: float = 1.0
    room: float = 1.0

    @property
    def time(self) -> float:
        """Stroke over speed [1]."""
        return self.length / self.speed

    def of(self, unit: str) -> float:
        """Return the scale of a quantity by its SI unit, such as "m/N" or "s/m"; 1 for pure numbers [1]."""
        mass = self.load * self.time**2 / self.length
        known = {"meter": self.length, "second": self.time, "newton": self.load, "pascal": self.pressure}
        known |= {"kilogram": mass, "hertz": 1.0 / self.time}
        return float(np.prod([known.get(name, 1.0) ** power for name, power in powers_of(unit).items()]))


def scales_of(campaign: Campaign) -> Scales:
    """Return the scales of a campaign: of a free girder from its weight, of one slider from its fitted runs.

    They are 1 where a slider's slip or load was not recorded.
    """
    specimen = campaign.specimen
    if specimen.free:
        return Scales(load=pad_load_scale(specimen))
    runs = [run for run in campaign.runs if run.role != "holdout"] or campaign.runs
    records = [run.record for run in runs if "slip_x" in run.record]
    if not records:
        return Scales()
    stroke = float(np.median([np.ptp(record["slip_x"]) for record in records]))
    speeds = [_path(record["slip_x"]) / float(record.time[-1] - record.time[0]) for record in records]
    loads = [
        float(np.mean(record[name])) * (1.0 if name.endswith("_N") else specimen.pad_area)
        for record in records
        for name in (f"pad_{specimen.pads[0]}_N", f"pad_{specimen.pads[0]}_P")
        if name in record
    ]
    load, speed = float(np.median(loads)) if loads else 0.0, float(np.median(speeds))
    if not (stroke > 0.0 and speed > 0.0 and load > 0.0):
        return Scales()
    return Scales(stroke / _STROKE, speed / _SPEED, load / _LOAD, load / specimen.pad_area / _PRESSURE, _ROOM)


def pad_load_scale(specimen: Specimen) -> float:
    """Return what a pad of a free girder carries at rest, their mean, over that of the reference rig; else 1 [1]."""
    return specimen.weight / len(specimen.pads) / _REST_LOAD if specimen.free else 1.0


def _path(slip: NDArray[np.float64]) -> float:
    """Return the length of the path of a slip (n,), its noise averaged out [m]."""
    edges = np.linspace(0, len(slip), max(2, min(_PARTS, len(slip) // _SAMPLES)) + 1).astype(int)
    means = [float(np.mean(slip[a:b])) for a, b in zip(edges[:-1], edges[1:], strict=True) if b > a]
    return float(np.sum(np.abs(np.diff(means))))
