"""A finding in words: what it is, what it would be mistaken for, and what would separate them."""

from collections.abc import Sequence

from slipwise.effects import Effect
from slipwise.instruments.suspects import Suspect, declared

#: How sizes are written: SI unit -> (factor, unit).
_SHOWN: dict[str, tuple[float, str]] = {
    "1": (100.0, "%"),
    "s": (1e3, "ms"),
    "m": (1e3, "mm"),
    "m/s": (1e3, "mm/s"),
    "N": (1e-3, "kN"),
    "Pa": (1e-6, "MPa"),
}


#: How the end of a sentence turns round where a size is below zero.
_OTHER_WAY = (("too much", "too little"), (" late", " early"), (" slow", " fast"))


def shown(size: float, unit: str, effect: Effect) -> str:
    """Write the size of a gauge's fault in the unit in which people read it."""
    own = declared(effect).shown
    if own is not None:
        return f"{own[0] * size:.4g} {own[1]}"
    factor, written = _SHOWN.get(unit, (1.0, unit))
    return f"{factor * size:.3g} {written}"


def as_sentence(suspect: Suspect, size: float) -> str:
    """Write what a suspect did, and how much of it."""
    return sentence(suspect.effect, suspect.label, size, suspect.unit)


def sentence(effect: Effect, place: str, size: float, unit: str) -> str:
    """Write what a fault did on a place, and how much of it; a size below zero is told as the other way."""
    says = declared(effect).says
    for more, less in _OTHER_WAY if size < 0.0 else ():
        if says.endswith(more):
            says, size = says.removesuffix(more) + less, -size
    return f"{place} {says.format(size=shown(size, unit, effect))}"


def confusable(effect: Effect) -> tuple[str, ...]:
    """Return the names of the effects that are easily confused with this one, as its file says."""
    return tuple(effect.confused_with)


def how_to_settle(effect: Effect, rivals: Sequence[str]) -> str:
    """Say what would tell a fault from its rivals: what its file knows of the pair, or a test of the gauge."""
    tests = effect.confused_with
    known = [tests[name] for rival in rivals if (name := rival.split()[0]) in tests]
    return "; ".join(dict.fromkeys([*known, declared(effect).settled_by]))
