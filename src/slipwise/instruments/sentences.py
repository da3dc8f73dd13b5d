"""A finding in words: what it is, what it would be mistaken for, and what would settle it."""

from collections.abc import Sequence

from slipwise.effects import catalogue
from slipwise.instruments.suspects import Suspect

#: What settles a kind of fault for good, by a measurement of its own.
_SETTLE: dict[str, str] = {
    "channel_delay": "one tap with a hammer on the girder at rest shows every channel's delay and filter",
    "channel_filter": "one tap with a hammer on the girder at rest shows every channel's delay and filter",
    "channel_gain": "a calibration of that gauge; for cells a known weight, for accelerometers a turn by 90 degrees",
    "channel_sign": "one push by hand in a known direction",
    "channel_offset": "zero readings before and after, with the girder lifted for load cells",
    "channel_drift": "a record of some minutes in which nothing moves",
    "clock_skew": "one tap at the start and one at the end of a long record",
    "load_crosstalk": "zero readings with the girder lifted, or a weight put on each cell alone",
    "cell_inertia": "a sine below slip (0.03 g): what the cells read there in step with the table is inertia",
    "channel_clipping": "the gauge's range, and a run of smaller amplitude",
    "dropped_samples": "the logger's own counter of samples",
}
#: How sizes are written: SI unit -> (factor, unit).
_SHOWN: dict[str, tuple[float, str]] = {
    "1": (100.0, "%"),
    "s": (1e3, "ms"),
    "m": (1e3, "mm"),
    "m/s": (1e3, "mm/s"),
    "kg": (1.0, "kg"),
}
_SAYS: dict[str, str] = {
    "channel_delay": "comes {size} late",
    "channel_filter": "went through a slower filter than the others: a lag of {size}",
    "channel_gain": "reads {size} too much",
    "channel_sign": "has the wrong sign",
    "channel_offset": "has its zero off by {size}",
    "channel_drift": "drifts by {size}",
    "clock_skew": "runs by a clock of its own, {size} slow",
    "load_crosstalk": "feels {size} of the other direction's force",
    "cell_inertia": "read the inertia of {size} between pad and cell",
    "channel_clipping": "is cut off at {size}",
    "dropped_samples": "repeats or misses {size} of its samples",
}
#: Rivals within this of the winner's score, or within this part of its gain, are told [units of the score, 1].
_NEAR, _PART = 12.0, 0.1


def shown(size: float, unit: str, effect: str = "") -> str:
    """Write a size in the unit in which people read it."""
    if effect == "clock_skew":
        return f"{1e6 * size:.4g} ppm"
    factor, written = _SHOWN.get(unit, (1.0, unit))
    return f"{factor * size:.3g} {written}"


def as_sentence(suspect: Suspect, size: float) -> str:
    """Write what a suspect did, and how much of it."""
    words = _SAYS[suspect.effect].format(size=shown(size, suspect.unit, suspect.effect))
    return f"{suspect.label} {words}"


def sentence(effect: str, place: str, size: float, unit: str) -> str:
    """Write a finding that is no suspect of the balances."""
    return f"{place} {_SAYS[effect].format(size=shown(size, unit, effect))}"


def nearest(rivals: Sequence[tuple[str, float]], gain: float) -> tuple[str, ...]:
    """Give the rivals that explain nearly as much, nearest first."""
    return tuple(dict.fromkeys(name for name, loss in rivals if loss < max(_NEAR, _PART * gain)))


def confusable(effect: str) -> tuple[str, ...]:
    """Give the effects that the catalogue names as easily confused with this one."""
    return tuple(catalogue()[effect].confused_with)


def how_to_settle(effect: str, rivals: Sequence[str]) -> str:
    """Say what would tell a fault from its rivals: what the catalogue knows of the pair, or a test of the gauge."""
    tests = catalogue()[effect].confused_with
    told = [tests[name] for rival in rivals if (name := rival.split()[0]) in tests]
    return "; ".join(dict.fromkeys([*told, _SETTLE[effect]]))
