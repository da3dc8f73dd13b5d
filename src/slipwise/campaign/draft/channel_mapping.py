"""Which column of a laboratory is which channel: told from its name, its unit, and what its numbers do.

load      stands at about a quarter of the weight; unloads at +x while the girder is pushed to +x
friction  has no mean and the sign of the slip's rate
slip      starts at zero, and its second derivative is girder minus table
girder, table   along x friction and slip make the girder's acceleration; upwards the loads follow the girder
"""

from collections.abc import Mapping, Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.draft.column import LETTERS, Column, Mapped
from slipwise.campaign.draft.loads_and_frictions import split_forces
from slipwise.campaign.draft.slip import alike, map_slips, slip_rate
from slipwise.campaign.draft.time_column import time_column
from slipwise.channels import PADS

#: Fewer samples than these show nothing.
_ENOUGH = 100
#: Loads from here on are told in kN [N].
_KILO = 100.0
#: Table and girder are told apart where the girder's forces explain this much more of one than of the other [1].
_APART = 0.01


def map_columns(columns: Sequence[Column], known: Mapping[str, Array], step: float | None = None) -> dict[str, Mapped]:
    """Return header -> channel for the columns whose names or numbers show what they are.

    Args:
        columns: of one run with strong motion.
        known: channels that the file names as we do, each (n,) SI.
        step: that the file states beside its columns [s], None if it states none.
    """
    out: dict[str, Mapped] = {}
    channels = dict(known)
    if "time" not in channels and (found := time_column(columns, step)) is not None:
        header, mapped = found
        timed = next(c for c in columns if c.header == header)
        _put(out, channels, timed, mapped)
    if "time" not in channels and step is not None and columns:
        channels["time"] = np.arange(len(columns[0].values), dtype=np.float64) * step
    for column in columns:
        if column.channel and column.channel != "time" and not column.no_channel:
            _put(out, channels, column, Mapped(column.channel, column.unit, 1, "it is named so", "sure"))
    instants = channels.get("time")
    if instants is None or len(instants) < _ENOUGH:
        return out
    rest = [c for c in columns if c.header not in out and not c.no_channel]
    spacing = float(np.median(np.diff(instants)))
    # a load may be kept constant by the machine; a friction that never moves is a dead gauge
    loaded = any(c.kind == "pressure" for c in rest) or any(n.endswith(("_N", "_P")) for n in channels)
    loads, frictions, told = split_forces([c for c in rest if c.kind == "force"], loaded)
    total = np.asarray(np.sum([np.abs(c.values) for c in loads], axis=0), dtype=np.float64) if loads else None
    along = [c.values for c in frictions if "across" not in c.meanings]
    slip = next((c.values for c in rest if c.kind == "length" and not c.meanings & {"table", "across", "up"}), None)
    pushes = [np.sum(along, axis=0), slip] if along and slip is not None else []
    _accelerations([c for c in rest if c.kind == "acceleration"], total, pushes, channels, out)
    for column, mapped in map_slips([c for c in rest if c.kind in ("length", "speed")], channels, frictions, spacing):
        _put(out, channels, column, mapped)
    _pads(loads, frictions, told, channels, out, spacing)
    return out


def _put(out: dict[str, Mapped], channels: dict[str, Array], column: Column, mapped: Mapped) -> None:
    if mapped.channel not in channels:
        out[column.header] = mapped
        channels[mapped.channel] = mapped.sign * column.values


def _accelerations(
    columns: Sequence[Column],
    total: Array | None,
    pushes: Sequence[Array],
    channels: dict[str, Array],
    out: dict[str, Mapped],
) -> None:
    """Map accelerations: direction by name or by whether the loads follow, place by name or by what makes them."""
    groups: dict[str, list[Column]] = {"x": [], "y": [], "z": []}
    for column in columns:
        groups[_axis(column, total)].append(column)
    causes = {"x": pushes, "y": [], "z": [total] if total is not None else []}
    for axis, group in groups.items():
        for column in group:
            place, why = _place(column, group, causes[axis])
            if not place:
                continue
            told = bool(column.meanings & {"table", "girder"}) and bool(column.meanings & {"up", "along", "across"})
            gravity = abs(abs(float(np.median(column.values))) - 9.80665) < 1.0
            words = f"{why}; gravity is in it: subtract it" if gravity else why
            mapped = Mapped(f"{place}_a{axis}", column.unit, 1, words, "sure" if told else "likely")
            _put(out, channels, column, mapped)


def _axis(column: Column, total: Array | None) -> str:
    for axis, meaning in (("z", "up"), ("y", "across"), ("x", "along")):
        if meaning in column.meanings:
            return axis
    return "z" if total is not None and alike(column.values, total) > 0.5 else "x"


def _place(column: Column, group: Sequence[Column], causes: Sequence[Array]) -> tuple[str, str]:
    """Tell table from girder; "" where neither name nor numbers do."""
    for place in ("table", "girder"):
        if place in column.meanings:
            return place, f"its name says {place}"
    if len(group) != 2 or not causes:
        return "", ""
    made = {c.header: _explained(c.values, causes) for c in group}
    if abs(made[group[0].header] - made[group[1].header]) < _APART:
        return "", ""
    if made[column.header] == max(made.values()):
        return "girder", "the forces on the girder make it"
    return "table", "the forces on the girder do not make it"


def _explained(values: Array, causes: Sequence[Array]) -> float:
    """Return the share of a signal's variance that a sum of others explains."""
    columns = np.stack([*causes, np.ones(len(values))], axis=1)
    scaled = columns / np.maximum(np.abs(columns).max(axis=0), 1e-300)
    left = values - scaled @ np.linalg.lstsq(scaled, values, rcond=None)[0]
    return 1.0 - float(np.var(left)) / max(float(np.var(values)), 1e-300)


def _pads(
    loads: Sequence[Column],
    frictions: Sequence[Column],
    told: Mapping[str, tuple[str, str]],
    channels: dict[str, Array],
    out: dict[str, Mapped],
    step: float,
) -> None:
    """Map loads and frictions of a girder's pads, or of one; told: why a force is what it is, and how sure that is."""
    if len(loads) == 1:
        _put(out, channels, loads[0], _load(loads[0], "A", *told[loads[0].header]))
    counted = range(3, len(LETTERS) + 1)
    places = _places(loads, channels) if len(loads) in counted else {}
    for column, (pad, why, sure) in places.items():
        load = next(c for c in loads if c.header == column)
        _put(out, channels, load, _load(load, pad, why, sure))
    by_number = {c.number: places[c.header][0] for c in loads if c.header in places and c.number is not None}
    pads = [places[c.header][0] for c in loads if c.header in places]
    along = [c for c in frictions if "across" not in c.meanings]
    rate = slip_rate(channels, step)
    for k, column in enumerate(along if len(along) in (1, *counted) else []):
        pad = by_number.get(column.number) if column.number in by_number else None
        why, sure = told[column.header]
        if pad is not None:
            why, sure = f"{why}; number {column.number} as the load's", "sure"
        elif len(along) > 1:
            pad, why, sure = pads[k] if k < len(pads) else LETTERS[k], f"{why}; by its order", "guess"
        else:
            pad = pads[0] if pads else "A"
        sign = 1
        if rate is not None:
            fast = np.abs(rate) > 0.2 * np.abs(rate).max(initial=0.0)
            agreement = float(np.mean(np.sign(rate[fast]) * np.sign(column.values[fast]))) if fast.any() else 0.0
            sign = -1 if agreement < -0.3 else 1
            why += ", against the slip" if sign < 0 else ", follows the slip" if agreement > 0.3 else ""
        _put(out, channels, column, Mapped(f"pad_{pad}_Fx", column.unit, sign, why, sure))


def _load(column: Column, pad: str, why: str, sure: str) -> Mapped:
    middle = float(np.median(column.values))
    sign = -1 if middle < 0.0 else 1
    negative = "; compression is negative in it" if sign < 0 else ""
    size = f"{abs(middle) / 1e3:.3g} kN" if abs(middle) >= _KILO else f"{abs(middle):.3g} N"
    size = f"{abs(middle):.3g}" if column.unit == "?" else size
    return Mapped(f"pad_{pad}_N", column.unit, sign, f"stands at {size}, {why}{negative}", sure)


def _places(loads: Sequence[Column], channels: Mapping[str, Array]) -> dict[str, tuple[str, str, str]]:
    """Return header -> pad, why and how sure: pads at +x unload while the girder is pushed to +x; +y likewise.

    Of four; where others stand is for a specimen.toml to say, and they are counted.
    """
    order = sorted(loads, key=lambda c: (c.number is None, c.number or 0))
    if len(loads) != len(PADS):
        numbers = [c.number for c in order]
        counted = numbers == list(range(1, len(order) + 1))
        why, sure = (f"number {{}} of {len(order)}", "likely") if counted else ("by its order", "guess")
        named = zip(order, LETTERS, strict=False)
        return {c.header: (pad, why.format(c.number), sure) for c, pad in named}
    size = {c.header: np.abs(c.values) for c in loads}
    mean = np.asarray(np.mean(list(size.values()), axis=0), dtype=np.float64)
    sides: dict[str, dict[str, float]] = {}
    for axis in "xy":
        if f"girder_a{axis}" in channels:
            pushed = channels[f"girder_a{axis}"]
            sides[axis] = {h: alike(v - mean, pushed) for h, v in size.items()}
    along = sides.get("x", {})
    front = [c for c in order if along.get(c.header, 0.0) < 0.0]
    if len(front) != 2 or min((abs(v) for v in along.values()), default=0.0) < 0.2:
        return {c.header: (pad, "by its order", "guess") for c, pad in zip(order, PADS, strict=True)}
    back = [c for c in order if c not in front]
    across = sides.get("y", {})
    rolls = bool(across) and min(abs(v) for v in across.values()) > 0.3
    out = {}
    for group, pair, where in ((front, ("A", "C"), "unloads"), (back, ("B", "D"), "is loaded")):
        ranked = sorted(group, key=lambda c: across[c.header]) if rolls else group
        for column, pad in zip(ranked, pair, strict=True):
            why = f"{where} while the girder is pushed to +x"
            why += "; its side across by roll" if rolls else "; its side across only by order, nothing rolls"
            out[column.header] = (pad, why, "sure" if rolls else "likely")
    return out
