"""The suspects: every fault that a gauge can have, on every channel or card that can have it.

A suspect's signature is not written down: it is what the relations make of a record that the fault has spoiled, and the
fault is the effect of that name in the catalogue.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.channels import PADS, channel
from slipwise.effects import catalogue
from slipwise.effects._gauges import aimed, span
from slipwise.record import Record
from slipwise.signals import LowPass, response
from slipwise.signals.ends import in_frequency

Array = NDArray[np.float64]
#: Sizes from which a fault matters to somebody who looks for friction, SI.
LEAST: dict[str, float] = {
    "channel_delay": 0.4e-3,
    "channel_filter": 0.6e-3,
    "channel_gain": 0.008,
    "clock_skew": 6e-5,
    "load_crosstalk": 0.0015,
    "cell_inertia": 6.0,
}
#: Offsets, and drifts per second, that matter, by unit of the channel; a drift counts by what it adds in a second.
_LEAST_OFFSET = {"m/s^2": 0.03, "m": 1e-4, "N": 40.0, "rad": 1e-4}
_LEAST_DRIFT = {"m/s^2": 0.01, "m": 2e-5, "N": 20.0, "rad": 3e-5}
#: Friction in a cell's load matters less than load in its friction, which is ten times smaller [1].
_INTO_LOAD = 8.0
#: The table's vertical motion is tied to the girder only through the pads' springs: its faults must be larger [1].
_LOOSE = 3.0
#: An inverse filter does not raise amplitudes more than this [1].
_RAISE = 5.0


@dataclass(frozen=True)
class Suspect:
    """One fault on one channel or card.

    Attributes:
        effect: name in the catalogue.
        label: the channel, or the card as a pattern, "pad_*_Fx"; with the variant in words where there are several.
        target: of the effect.
        channels: that it changes.
        unit: of its size, SI.
        step: small size at which its signature is taken.
        least: size from which it is reported.
        values: (size) -> parameters of the effect.
    """

    effect: str
    label: str
    target: str
    channels: tuple[str, ...]
    unit: str
    step: float
    least: float
    values: Callable[[float], dict[str, float]]

    @property
    def one_sided(self) -> bool:
        """Whether its size cannot be below zero."""
        return catalogue()[self.effect].parameters[0].low >= 0.0

    @property
    def key(self) -> tuple[str, str]:
        """Name of fault and place."""
        return self.effect, self.label

    def spoil(self, record: Record, size: float) -> Record:
        """Give the record with the fault."""
        return catalogue()[self.effect].hooks["gauge"](record, self.target, **self.values(size))

    def mend(self, record: Record, size: float) -> Record:
        """Give the record without the fault; a filter is taken out as far as noise allows."""
        hooks = catalogue()[self.effect].hooks
        if "undo" in hooks:
            return hooks["undo"](record, self.target, **self.values(size))
        return sharpened(record, self.target, **self.values(size))


def groups_of(record: Record) -> dict[str, tuple[str, ...]]:
    """Give the channels, and the cards of four cells, that a fault may touch together."""
    single = [n for n in record.channels if n.startswith(("slip_x", "slip_y", "girder_a", "table_a", "yaw"))]
    single += [n for n in record.channels if n.startswith("pad_") and n[6:] in ("N", "Fx", "Fy")]
    groups: dict[str, tuple[str, ...]] = {name: (name,) for name in single}
    for kind in ("N", "Fx", "Fy"):
        names = tuple(f"pad_{pad}_{kind}" for pad in PADS)
        if record.has_all(*names):
            groups[f"pad_*_{kind}"] = names
    return groups


def suspects(record: Record) -> list[Suspect]:
    """Give all suspects for the channels of a record."""
    found: list[Suspect] = []
    for place, channels in groups_of(record).items():
        found.append(_plain("channel_gain", place, channels, "1", 0.01, "gain"))
        found.append(_plain("channel_delay", place, channels, "s", 5e-4, "delay"))
        found.append(_plain("clock_skew", place, channels, "1", 1e-4, "skew"))
        for order in (1, 2):
            found.append(_plain("channel_filter", place, channels, "s", 1e-3, "lag", order=float(order)))
        if len(channels) == 1:
            found += _wandering(place)
    for axis in "xy":
        if record.has_all(*(f"pad_{pad}_{kind}" for pad in PADS for kind in ("N", f"F{axis}"))):
            found += _leaking(record, axis)
    if record.has_all(*(f"pad_{pad}_{kind}" for pad in PADS for kind in ("N", "Fx")), "table_ax", "table_az"):
        channels = tuple(n for n in record.channels if n.startswith("pad_") and n[6:] in ("N", "Fx", "Fy"))
        for words, horizontal in (("all cells", 1.0), ("all cells, added", -1.0)):
            shape = {"horizontal": horizontal, "weighed": 0.0}
            found.append(_suspect("cell_inertia", words, "all", channels, "kg", 10.0, "mass", shape))
    return found


def _suspect(
    effect: str,
    label: str,
    target: str,
    channels: tuple[str, ...],
    unit: str,
    step: float,
    name: str,
    shape: dict[str, float],
    least: float | None = None,
    per: float = 1.0,
) -> Suspect:
    if channels == ("table_az",) and least is None:
        least = _LOOSE * LEAST[effect]
    return Suspect(
        effect,
        label,
        target,
        channels,
        unit,
        step,
        LEAST[effect] if least is None else least,
        lambda size: {name: size / per, **shape},
    )


def _plain(
    effect: str, place: str, channels: tuple[str, ...], unit: str, step: float, name: str, **shape: float
) -> Suspect:
    words = f"{place}, order {shape['order']:.0f}" if "order" in shape else place
    return _suspect(effect, words, place, channels, unit, step, name, shape)


def _wandering(name: str) -> list[Suspect]:
    """Offset and drift, in the channel's own unit; a drift is straight or settles in three seconds."""
    unit, per = channel(name).unit, span(name)
    step = _LEAST_OFFSET[unit]
    found = [_suspect("channel_offset", name, name, (name,), unit, step, "offset", {}, step, per)]
    for words, settling in (("", 0.0), (", settling", 0.33)):
        least = _LEAST_DRIFT[unit]
        shape = {"settling": settling}
        found.append(
            _suspect("channel_drift", name + words, name, (name,), f"{unit}/s", least, "drift", shape, least, per)
        )
    return found


def _leaking(record: Record, axis: str) -> list[Suspect]:
    """Cross-talk of each cell and of all: load into friction, the same zeroed under load, friction into load."""
    found = []
    for into, source, zeroed in ((f"F{axis}", "N", 0.0), (f"F{axis}", "N", 1.0), ("N", f"F{axis}", 0.0)):
        if into == "N" and axis == "y":
            continue
        for pad in ("*", *PADS):
            place = f"pad_{pad}_{into}"
            channels = tuple(f"pad_{p}_{into}" for p in (PADS if pad == "*" else (pad,)))
            words = f"{place} from {source}{', zeroed' if zeroed else ''}"
            least = LEAST["load_crosstalk"] * (_INTO_LOAD if into == "N" else 1.0)
            shape = {"zeroed": zeroed}
            found.append(_suspect("load_crosstalk", words, place, channels, "1", least, "share", shape, least))
    return found


def sharpened(record: Record, target: str, lag: float, order: float) -> Record:
    """Take a causal filter out by its inverse, which is limited where the filter leaves little.

    Args:
        record: with the filtered channels.
        target: of the effect `channel_filter`.
        lag: of the filter for slow signals [s].
        order: of the filter.
    """
    if lag <= 0.0:
        return record
    at_one = LowPass(1.0, round(order), "causal")
    by = LowPass(at_one.lag / lag, round(order), "causal")

    def inverse(frequency: Array) -> NDArray[np.complex128]:
        through = response(by, frequency)
        size = np.abs(through)
        return np.asarray(np.conj(through) / np.maximum(size**2, size / _RAISE), dtype=np.complex128)

    beyond = int(30.0 * lag / record.dt) + 64
    return record.replaced(**{n: in_frequency(record[n], record.dt, inverse, beyond) for n in aimed(record, target)})
