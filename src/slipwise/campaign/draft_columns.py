"""Which column of a laboratory is which channel: told from its name, its unit, and what its numbers do.

load      stands at about a quarter of the weight; unloads at +x while the girder is pushed to +x
friction  has no mean and the sign of the slip's rate
slip      starts at zero, and its second derivative is girder minus table
girder, table   along x friction and slip make the girder's acceleration; upwards the loads follow the girder
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign.draft_column import LETTERS, Column, Mapped
from slipwise.channels import PADS

Array = NDArray[np.float64]
_TABLE = {"table", "tab", "tbl", "base", "platform", "shaker", "actuator", "tisch", "ground", "foundation"}
_GIRDER = {"girder", "deck", "beam", "mass", "block", "superstructure", "top", "slab", "bridge", "traeger", "gir"}
_UP = {"z", "vert", "vertical", "v", "up", "n", "normal", "axial", "az"}
_ALONG = {"x", "long", "longitudinal", "h", "hor", "horz", "horiz", "horizontal", "shear", "ax", "fx", "friction"}
_ACROSS = {"y", "trans", "transverse", "ay", "fy", "lat", "lateral"}
#: A load varies by less than this part of its mean [1]; fewer samples than these show nothing.
_STEADY, _ENOUGH = 0.6, 100
#: No pad of a shaking table carries more [N].
_LARGEST_LOAD = 1e8
#: Table and girder are told apart where the girder's forces explain this much more of one than of the other [1].
_APART = 0.01


def map_columns(columns: Sequence[Column], known: Mapping[str, Array]) -> dict[str, Mapped]:
    """Give header -> channel for the columns whose numbers show what they are.

    Args:
        columns: of one run with strong motion.
        known: channels that the file names as we do, each (n,) SI.
    """
    out: dict[str, Mapped] = {}
    time = next((c for c in columns if c.kind == "time" and np.all(np.diff(c.values) > 0.0)), None)
    if time is not None:
        out[time.header] = Mapped("time", time.unit, 1, "rises evenly", "sure")
    instants = time.values if time is not None else known.get("time")
    if instants is None or len(instants) < _ENOUGH:
        return out
    step = float(np.median(np.diff(instants)))
    channels = dict(known)
    # a load may be kept constant by the machine; a friction that never moves is a dead gauge
    forces = [c for c in columns if c.kind == "force" and (np.ptp(c.values) > 0.0 or _is_load(c))]
    loads = [c for c in forces if _is_load(c)]
    total = np.asarray(np.sum([np.abs(c.values) for c in loads], axis=0), dtype=np.float64) if loads else None
    frictions = [c.values for c in forces if not _is_load(c) and not c.words & _ACROSS]
    slip = next((c.values for c in columns if c.kind == "length" and not c.words & (_TABLE | _ACROSS)), None)
    pushes = [np.sum(frictions, axis=0), slip] if frictions and slip is not None else []
    _accelerations([c for c in columns if c.kind == "acceleration"], total, pushes, channels, out)
    _slips([c for c in columns if c.kind in ("length", "speed")], channels, out, step)
    _pads(loads, [c for c in forces if not _is_load(c)], channels, out, step)
    return out


def _is_load(column: Column) -> bool:
    """Tell a load, which stands, from a friction, which has no mean."""
    middle = abs(float(np.median(column.values)))
    return 0.0 < middle < _LARGEST_LOAD and float(np.std(column.values)) < _STEADY * middle


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
            told = bool(column.words & (_TABLE | _GIRDER)) and bool(column.words & (_UP | _ALONG | _ACROSS))
            gravity = abs(abs(float(np.median(column.values))) - 9.80665) < 1.0
            words = f"{why}; gravity is in it: subtract it" if gravity else why
            mapped = Mapped(f"{place}_a{axis}", column.unit, 1, words, "sure" if told else "likely")
            _put(out, channels, column, mapped)


def _axis(column: Column, total: Array | None) -> str:
    for axis, words in (("z", _UP), ("y", _ACROSS), ("x", _ALONG)):
        if column.words & words:
            return axis
    return "z" if total is not None and _alike(column.values, total) > 0.5 else "x"


def _place(column: Column, group: Sequence[Column], causes: Sequence[Array]) -> tuple[str, str]:
    """Tell table from girder; "" where neither name nor numbers do."""
    if column.words & _TABLE:
        return "table", "its name says table"
    if column.words & _GIRDER:
        return "girder", "its name says girder"
    if len(group) != 2 or not causes:
        return "", ""
    made = {c.header: _explained(c.values, causes) for c in group}
    if abs(made[group[0].header] - made[group[1].header]) < _APART:
        return "", ""
    if made[column.header] == max(made.values()):
        return "girder", "the forces on the girder make it"
    return "table", "the forces on the girder do not make it"


def _explained(values: Array, causes: Sequence[Array]) -> float:
    """Give the share of a signal's variance that a sum of others explains."""
    columns = np.stack([*causes, np.ones(len(values))], axis=1)
    scaled = columns / np.maximum(np.abs(columns).max(axis=0), 1e-300)
    left = values - scaled @ np.linalg.lstsq(scaled, values, rcond=None)[0]
    return 1.0 - float(np.var(left)) / max(float(np.var(values)), 1e-300)


def _alike(one: Array, other: Array) -> float:
    if np.ptp(one) == 0.0 or np.ptp(other) == 0.0:
        return 0.0
    return float(np.corrcoef(one, other)[0, 1])


def _slips(columns: Sequence[Column], channels: dict[str, Array], out: dict[str, Mapped], step: float) -> None:
    """Map displacements and speeds, with the sign that girder minus table gives."""
    for column in columns:
        axis = "y" if column.words & _ACROSS else "x"
        if column.kind == "length" and column.words & _TABLE:
            _put(out, channels, column, Mapped(f"table_d{axis}", column.unit, 1, "its name says table", "likely"))
            continue
        name = f"slip_{axis}" if column.kind == "length" else f"slip_v{axis}"
        still = abs(float(column.values[:5].mean())) < 0.05 * float(np.abs(column.values).max(initial=0.0))
        why, sure, sign = ("starts at zero" if still else "the displacement that is left"), "likely", 1
        relative = [f"girder_a{axis}", f"table_a{axis}"]
        if all(n in channels for n in relative):
            pushed = channels[relative[0]] - channels[relative[1]]
            # Integrated twice the accelerations drift: both are compared as fast motion.
            times = 2 if column.kind == "length" else 1
            agreement = _alike(_differences(column.values, times, step), _smooth(pushed))
            if abs(agreement) > 0.3:
                sign, sure = (1 if agreement > 0.0 else -1), "sure"
                why += f", its {'second ' if times == 2 else ''}derivative is girder minus table"
        _put(out, channels, column, Mapped(name, column.unit, sign, why, sure))


def _smooth(values: Array, width: int = 15) -> Array:
    kernel = np.hanning(width + 2)[1:-1]
    return np.convolve(values - values.mean(), kernel / kernel.sum(), mode="same")


def _differences(values: Array, times: int, step: float) -> Array:
    smooth = _smooth(values)
    for _ in range(times):
        smooth = np.gradient(smooth, step)
    return smooth


def _pads(
    loads: Sequence[Column],
    frictions: Sequence[Column],
    channels: dict[str, Array],
    out: dict[str, Mapped],
    step: float,
) -> None:
    """Map loads and frictions of a girder's pads, or of one."""
    if len(loads) == 1:
        _put(out, channels, loads[0], _load(loads[0], "A", "the only load", "likely"))
    counted = range(3, len(LETTERS) + 1)
    places = _places(loads, channels) if len(loads) in counted else {}
    for column, (pad, why, sure) in places.items():
        load = next(c for c in loads if c.header == column)
        _put(out, channels, load, _load(load, pad, why, sure))
    by_number = {c.number: places[c.header][0] for c in loads if c.header in places and c.number is not None}
    pads = [places[c.header][0] for c in loads if c.header in places]
    along = [c for c in frictions if not c.words & _ACROSS]
    for k, column in enumerate(along if len(along) in (1, *counted) else []):
        pad = by_number.get(column.number) if column.number in by_number else None
        why, sure = f"no mean; number {column.number} as the load's", "sure"
        if pad is None:
            pad, why, sure = pads[k] if k < len(pads) else LETTERS[k], "no mean; by its order", "guess"
        sign = 1
        if "slip_x" in channels:
            rate = np.gradient(_smooth(channels["slip_x"]), step)
            fast = np.abs(rate) > 0.2 * np.abs(rate).max(initial=0.0)
            agreement = float(np.mean(np.sign(rate[fast]) * np.sign(column.values[fast]))) if fast.any() else 0.0
            sign = -1 if agreement < -0.3 else 1
            why += ", against the slip" if sign < 0 else ", follows the slip" if agreement > 0.3 else ""
        _put(out, channels, column, Mapped(f"pad_{pad}_Fx", column.unit, sign, why, sure))


def _load(column: Column, pad: str, why: str, sure: str) -> Mapped:
    middle = float(np.median(column.values))
    sign = -1 if middle < 0.0 else 1
    negative = "; compression is negative in it" if sign < 0 else ""
    return Mapped(f"pad_{pad}_N", column.unit, sign, f"stands at {abs(middle) / 1e3:.3g} kN, {why}{negative}", sure)


def _places(loads: Sequence[Column], channels: Mapping[str, Array]) -> dict[str, tuple[str, str, str]]:
    """Give header -> pad, why and how sure: pads at +x unload while the girder is pushed to +x; +y likewise.

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
            sides[axis] = {h: _alike(v - mean, pushed) for h, v in size.items()}
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
