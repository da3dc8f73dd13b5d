"""Faults of gauges: what they do to true channels before the logger, and to samples after it.

Beside the catalogue's there are those that a laboratory must find before any balance: dead, late, reversed and tared
channels, and gravity in a vertical gauge.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter, sosfilt

from slipwise_benchmarks.settings import PADS

Array = NDArray[np.float64]
#: Samples at rest from which a zero is taken.
TARE = 50
#: No digital filter has a corner above this share of the rate [1].
_NYQUIST = 0.49


@dataclass(frozen=True)
class Fault:
    """One fault.

    Attributes:
        effect: its name in the catalogue.
        channels: that it touches.
        size: delay [s], gain [1], offset in the channel's SI unit, drift [unit/s], cut-off [Hz], rail as a share of
            the largest excursion [1], share of samples [1], clock error [1], cross-talk [N/N], cell's mass [kg]; of a
            dead channel what it shows, of gravity its acceleration [m/s^2], share
            of the other axis [1].
        form: variant of the law, in words.
        rails: (low, high) of each channel once the runs are known; see `with_rails`.
        seed: of the places where samples are lost.
        runs: numbers of the runs in which it is there; empty: in all.
    """

    effect: str
    channels: tuple[str, ...]
    size: float
    form: str = ""
    rails: dict[str, tuple[float, float]] = field(default_factory=dict)
    seed: int = 0
    runs: tuple[int, ...] = ()

    def describe(self) -> dict[str, object]:
        """Give the fault as plain data."""
        said: dict[str, object] = {"channels": list(self.channels), "size": self.size, "form": self.form}
        return said | ({"rails": self.rails} if self.rails else {}) | ({"runs": list(self.runs)} if self.runs else {})


def with_rails(fault: Fault, runs: list[dict[str, Array]]) -> Fault:
    """Give a clipping fault rails at a share of the largest excursion from rest over all runs."""
    rails = {}
    for name in fault.channels:
        rest = float(runs[0][name][0])
        reach = fault.size * max(float(np.abs(run[name] - rest).max()) for run in runs)
        rails[name] = (rest - reach, rest + reach)
    return replace(fault, rails=rails)


def apply_before_logger(fault: Fault, channels: dict[str, Array], time: Array, true: dict[str, Array]) -> None:
    """Change analogue channels in place; `true` holds what no gauge has touched."""
    if fault.effect == "load_crosstalk":
        _crosstalk(fault, channels, true)
    elif fault.effect == "cell_inertia":
        _inertia(fault, channels, true)
    for name in fault.channels:
        if fault.effect == "channel_gain":
            channels[name] = channels[name] * (1.0 + fault.size)
        elif fault.effect in ("channel_sign", "reversed"):
            channels[name] = -channels[name]
        elif fault.effect == "dead" and fault.form == "noisy":
            channels[name] = np.full_like(channels[name], fault.size)
        elif fault.effect in ("channel_offset", "gravity"):
            channels[name] = channels[name] + fault.size
        elif fault.effect == "cross_axis":
            channels[name] = channels[name] + fault.size * true[fault.form]
        elif fault.effect == "channel_drift":
            warm = 3.0 * (1.0 - np.exp(-time / 3.0)) if fault.form == "warming up" else time
            channels[name] = channels[name] + fault.size * warm
        elif fault.effect == "channel_filter":
            order = 2 if fault.form == "second order" else 1
            rate = 1.0 / (time[1] - time[0])
            sos = butter(order, min(fault.size, _NYQUIST * rate), fs=rate, output="sos")
            rest = channels[name][0]
            channels[name] = rest + np.asarray(sosfilt(sos, channels[name] - rest))
        elif fault.effect == "table_gain":
            # what is recorded is the command; the table does more or less of it
            channels[name] = channels[name] / (1.0 + fault.size)
        elif fault.effect == "table_cross_axis":
            channels[name] = channels[name] - fault.size * true["table_ax"]


def _crosstalk(fault: Fault, channels: dict[str, Array], true: dict[str, Array]) -> None:
    for name in fault.channels:
        other = name.replace("_Fx", "_N") if name.endswith("_Fx") else name.replace("_N", "_Fx")
        leak = true[other] - true[other][0] if fault.form == "zeroed at rest" else true[other]
        channels[name] = channels[name] + fault.size * leak


def _inertia(fault: Fault, channels: dict[str, Array], true: dict[str, Array]) -> None:
    """Plate and cell of mass m move with the table: N reads m a_z more, F reads m a_x less (form "added": more).

    A plate between pad and cell passes on F - m a_x when F is the girder's force on the pad. The catalogue writes
    the sign the other way; a rig whose cells hang on the other side has it so.
    """
    sign = 1.0 if fault.form == "added" else -1.0
    for name in fault.channels:
        if name.endswith("_N"):
            channels[name] = channels[name] + fault.size * true["table_az"]
        else:
            for axis in "xy":  # gauges along y are recorded by some campaigns only
                gauge = name[:-1] + axis
                if gauge in channels:
                    channels[gauge] = channels[gauge] + sign * fault.size * true["table_a" + axis]


def late_by(faults: list[Fault], name: str, time: Array) -> Array | float:
    """Give how late a channel is at each sample [s]."""
    late: Array | float = 0.0
    for fault in faults:
        if name in fault.channels:
            if fault.effect in ("channel_delay", "late"):
                late = late + fault.size
            elif fault.effect == "clock_skew":
                late = late + fault.size * time
    return late


def apply_after_logger(fault: Fault, channels: dict[str, Array], number: int) -> None:
    """Change samples of the campaign's run `number` in place: rails, lost samples, constants and zeros."""
    if fault.effect == "channel_clipping":
        for name in fault.channels:
            low, high = fault.rails[name]
            channels[name] = np.clip(channels[name], low, high)
    elif fault.effect == "dead" and fault.form == "constant":
        for name in fault.channels:
            channels[name] = np.full_like(channels[name], fault.size)
    elif fault.effect == "tared":
        for name in fault.channels:
            channels[name] = channels[name] - channels[name][:TARE].mean()
    elif fault.effect == "dropped_samples":
        rng = np.random.default_rng([fault.seed, number])
        count = channels[fault.channels[0]].size
        keep = np.ones(count, dtype=bool)
        while count - keep.sum() < fault.size * count:
            at = int(rng.integers(count // 10, count))
            keep[at : at + int(rng.integers(1, 7))] = False
        last = np.maximum.accumulate(np.where(keep, np.arange(count), 0))
        if fault.form == "lost":
            kept = np.flatnonzero(keep)
            last = np.concatenate([kept, np.full(count - kept.size, kept[-1])])
        for name in fault.channels:
            channels[name] = channels[name][last]


def groups(pads: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Give the groups of channels that a fault may touch together, on a rig with these pads."""
    return {
        "slip": ("slip_x",),
        "girder": ("girder_ax",),
        "forces": tuple(f"pad_{pad}_Fx" for pad in pads),
        "loads": tuple(f"pad_{pad}_N" for pad in pads),
        **{f"force {pad}": (f"pad_{pad}_Fx",) for pad in pads},
        **{f"load {pad}": (f"pad_{pad}_N",) for pad in pads},
        "table": ("table_ax",),
        "table up": ("table_az",),
        "girder up": ("girder_az",),
    }


GROUPS = groups(PADS)
