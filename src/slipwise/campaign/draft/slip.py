"""Which displacements and speeds of a laboratory are the slip, and with which sign: it is girder minus table."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.draft.column import Column, Mapped

#: Correlations from which on two motions are one, and a speed is the rate of a slip [1].
_ALIKE, _RATE = 0.3, 0.5
#: A speed varies by less than this part of its mean where a slider moves evenly [1].
_EVEN = 0.2


def map_slips(
    columns: Sequence[Column], channels: Mapping[str, Array], frictions: Sequence[Column], step: float
) -> Iterator[tuple[Column, Mapped]]:
    """Yield displacements and speeds, with the sign that girder minus table gives.

    Args:
        columns: of kind "length" or "speed".
        channels: that are known, each (n,) SI; those that are given go to it.
        frictions: columns of the frictions: a path grows while they turn.
        step: between samples [s].
    """
    turn = any(float(np.quantile(c.values, 0.1)) < 0.0 < float(np.quantile(c.values, 0.9)) for c in frictions)
    lengths = [c for c in columns if c.kind == "length"]
    path = [c for c in lengths if "path" in c.meanings and (turn or len(lengths) > 1)]
    # what is called a slip comes first, then what moves most
    # "axial" is across the sliding plane, unless it is all that there is: a machine that slides along its axis
    upright = any("up" not in c.meanings for c in lengths if c not in path)
    # the actuator of a machine for one slider moves the slider, that of a shaking table the table
    shaken = len(lengths) > 1 or any("_a" in name for name in channels)
    # the one displacement beside frictions along x only is theirs, whatever letter the machine has for it
    turned = not shaken and bool(frictions) and not any("across" in c.meanings for c in frictions)
    ranked = sorted(columns, key=lambda c: (c.kind != "length", "table" not in c.meanings, -float(np.ptp(c.values))))
    for column in ranked:
        axis = "y" if "across" in column.meanings and not turned else "x"
        if column.kind == "length" and "table" in column.meanings and shaken:
            yield column, Mapped(f"table_d{axis}", column.unit, 1, "its name says table", "likely")
            continue
        if column in path or (column in lengths and upright and "up" in column.meanings):
            continue
        name = f"slip_{axis}" if column.kind == "length" else f"slip_v{axis}"
        if name in channels:
            continue
        still = abs(float(column.values[:5].mean())) < 0.05 * float(np.abs(column.values).max(initial=0.0))
        why, sure, sign = ("starts at zero" if still else "the displacement that is left"), "likely", 1
        if column.kind == "speed":
            why = "the speed that is left"
        relative = [f"girder_a{axis}", f"table_a{axis}"]
        if all(n in channels for n in relative):
            pushed = channels[relative[0]] - channels[relative[1]]
            # Integrated twice the accelerations drift: both are compared as fast motion.
            times = 2 if column.kind == "length" else 1
            agreement = alike(_differences(column.values, times, step), smooth(pushed))
            if abs(agreement) > _ALIKE:
                sign, sure = (1 if agreement > 0.0 else -1), "sure"
                why += f", its {'second ' if times == 2 else ''}derivative is girder minus table"
        elif column.kind == "speed" and f"slip_{axis}" in channels:
            agreement = _rate_of(channels[f"slip_{axis}"], column.values, step)
            if abs(agreement) < _RATE:
                continue
            sign, why = (1 if agreement > 0.0 else -1), "the rate of the slip"
        yield column, Mapped(name, column.unit, sign, why, sure)


def slip_rate(channels: Mapping[str, Array], step: float) -> Array | None:
    """Return the rate of the slip along x (n,), None where neither slip nor its rate is known."""
    if "slip_vx" in channels:
        return channels["slip_vx"]
    return np.gradient(smooth(channels["slip_x"]), step) if "slip_x" in channels else None


def _rate_of(slip: Array, speed: Array, step: float) -> float:
    """Tell how well a speed is the rate of a slip [1]; of even motion only the direction shows."""
    middle = float(np.mean(speed))
    if float(np.std(speed)) < _EVEN * abs(middle):
        return float(np.sign(middle * (slip[-1] - slip[0])))
    return alike(np.gradient(slip, step), speed)


def smooth(values: Array, width: int = 15) -> Array:
    """Smooth (n,) over some samples; beyond its ends it is taken to stand."""
    kernel = np.hanning(width + 2)[1:-1]
    padded = np.pad(values, width // 2, mode="edge")
    return np.asarray(np.convolve(padded, kernel / kernel.sum(), mode="valid"), dtype=np.float64)


def _differences(values: Array, times: int, step: float) -> Array:
    rate = smooth(values)
    for _ in range(times):
        rate = np.asarray(np.gradient(rate, step), dtype=np.float64)
    return rate


def alike(one: Array, other: Array) -> float:
    """Return the correlation of two signals (n,), 0 where one of them stands [1]."""
    if np.ptp(one) == 0.0 or np.ptp(other) == 0.0:
        return 0.0
    return float(np.corrcoef(one, other)[0, 1])
