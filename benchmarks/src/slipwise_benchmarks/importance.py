"""What an effect is worth: how much measured channels and the held-out run's figures change when it is left out."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Run = Mapping[str, Array]
#: A change of more than this share of a channel's rms about its mean, or of a figure of the held-out run, matters [1].
MATERIAL = 0.02
#: The same of a channel for a fault of a gauge [1].
MATERIAL_GAUGE = 0.01


@dataclass(frozen=True)
class Figures:
    """What an engineer asks of a run: peak slip [m], energy that the pads dissipate [J], largest load of a pad [N]."""

    peak_slip: float
    energy: float
    largest_load: float


@dataclass(frozen=True)
class Importance:
    """Relative changes without an effect.

    Attributes:
        peak_slip, energy, largest_load: of the held-out run, (without - with) / with [1].
        channels: channel -> rms of the change over the channel's rms about its mean, the largest of the runs [1].
        of_limit: the largest of all these over what is material [1].
    """

    peak_slip: float
    energy: float
    largest_load: float
    channels: dict[str, float]
    of_limit: float

    @property
    def status(self) -> str:
        """Whether it is "material" or "minor"."""
        return "material" if self.of_limit > 1.0 else "minor"


def figures(true: Run) -> Figures:
    """Give the figures of a run from its true channels."""
    slip = np.hypot(true["slip_x"], true["slip_y"])
    pads = [name.removesuffix("_vx") for name in true if name.startswith("pad_") and name.endswith("_vx")]
    power = sum(true[f"{pad}_Fx"] * true[f"{pad}_vx"] + true[f"{pad}_Fy"] * true["slip_vy"] for pad in pads)
    step = float(true["time"][1] - true["time"][0])
    largest = max(float(true[f"{pad}_N"].max()) for pad in pads)
    return Figures(float(slip.max()), step * float(np.sum(power)), largest)


def relative_changes(there: Sequence[Run], gone: Sequence[Run], noise: Mapping[str, float]) -> dict[str, float]:
    """Give channel -> rms of the change over the rms about the mean, the largest of the runs [1].

    Args:
        there: recorded runs with the effect, free of noise.
        gone: the same runs without it.
        noise: channel -> standard deviation of what a laboratory's channel has beside its signal.
    """
    changes: dict[str, float] = {}
    for one, other in zip(there, gone, strict=True):
        for name, values in one.items():
            if name == "time" or float(values.std()) < 1.0e-12:  # nothing was recorded of a dead channel
                continue
            spread = float(np.hypot(values.std(), noise[name]))
            change = float(np.sqrt(np.mean((other[name] - values) ** 2))) / spread
            changes[name] = max(changes.get(name, 0.0), change)
    return changes


def importance(
    recorded: tuple[Sequence[Run], Sequence[Run]],
    held_out: tuple[Run, Run] | None,
    noise: Mapping[str, float],
    of_gauge: bool,
) -> Importance:
    """Hold what there is with an effect against what there is without it.

    Args:
        recorded: runs with and without it, free of noise.
        held_out: true channels of the held-out run with and without it. None: they are the same.
        noise: channel -> standard deviation of its noise.
        of_gauge: whether it is a fault of a gauge.
    """
    channels = relative_changes(*recorded, noise)
    moved = (0.0, 0.0, 0.0)
    if held_out is not None:
        there, gone = figures(held_out[0]), figures(held_out[1])
        pairs = (
            (there.peak_slip, gone.peak_slip),
            (there.energy, gone.energy),
            (there.largest_load, gone.largest_load),
        )
        moved = tuple((after - before) / before for before, after in pairs)
    limit = MATERIAL_GAUGE if of_gauge else MATERIAL
    largest = max(max(channels.values()) / limit, max(abs(value) for value in moved) / MATERIAL)
    return Importance(*moved, channels=channels, of_limit=largest)
