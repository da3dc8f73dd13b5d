"""The worst places in words: which component, which way it slides, and where its error is concentrated."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from slipwise.comparison.cells import Cell
from slipwise.comparison.component_level import NAMES
from slipwise.comparison.odd_even import Parity
from slipwise.comparison.patterns import Pattern
from slipwise.noise.level import AT_FLOOR, is_at_floor

#: Both directions count as equal within this ratio of their errors, and with this part of even residual [1].
_EQUAL, _EVEN = 1.15, 0.25
#: A place is worth naming when its part of the excess is this much more than its part of the samples [1].
_WORTH = 0.2
#: A pattern that explains this part of the squared residual tells more than where the error is large [1].
_PATTERN = 0.1
#: And with this part of the excess it is "most of it" [1].
_MOST = 0.6
#: kind -> unit and factor from SI for words.
UNITS: Mapping[str, tuple[str, float]] = {
    "speed": ("cm/s", 100.0),
    "pressure": ("MPa", 1e-6),
    "position": ("mm", 1e3),
    "since reversal": ("mm", 1e3),
    "path": ("m", 1.0),
    "time": ("s", 1.0),
    "frequency": ("Hz", 1.0),
}
#: Bands that begin below this are not named [Hz].
_SLOW_BAND = 3.0
#: A way since the last reversal says more than the state or the speed that goes with it, a run less than its cause.
_TELLING: Mapping[str, float] = {"since reversal": 1.35, "run": 0.7, "time": 0.8, "frequency": 0.5}
_ORDERED = ("since reversal", "speed", "pressure", "position", "path", "time", "frequency")
_NAMED = ("state", "pad", "run")


@dataclass(frozen=True)
class ErrorPlace:
    """Where a relation's error is.

    Attributes:
        relation: which.
        words: one sentence.
        error: rms there [floors].
        elsewhere: rms in the rest of the samples [floors].
        share: of the excess that lies there [1].
        part: of the samples that lie there [1].
        kind: what the place is a range or a label of; "" for everywhere.
        direction: "both directions, equal", "both directions, unequal", "only sliding to +x", ... or "".
    """

    relation: str
    words: str
    error: float
    elsewhere: float
    share: float
    part: float
    kind: str
    direction: str


def describe_places(
    cells: Sequence[Cell],
    patterns: Sequence[Pattern],
    parities: Mapping[str, Parity],
    errors: Mapping[str, float],
) -> tuple[ErrorPlace, ...]:
    """Say for every relation with a cell above the floor where its error is, the worst relation first.

    Args:
        cells: all that were tested, corrected for their number.
        patterns: of all relations.
        parities: relation -> odd and even part.
        errors: relation -> rms over all runs [floors].
    """
    out = []
    for relation in dict.fromkeys(c.relation for c in cells):
        own = [c for c in cells if c.relation == relation]
        if any(c.above for c in own):
            shown = [p for p in patterns if p.relation == relation]
            best = max(shown, key=lambda p: p.explained * _telling(relation, p.kind), default=None)
            place = _place(relation, own, parities.get(relation), errors[relation])
            if best is not None and best.explained > _PATTERN:
                patterned = _patterned(relation, own, best)
                # the mean may be clearest where the error is not largest; the place is where it is largest
                place = patterned if patterned.error >= patterned.elsewhere else place
            out.append(place)
    return tuple(sorted(out, key=lambda p: -p.error))


def _place(relation: str, cells: Sequence[Cell], found: Parity | None, error: float) -> ErrorPlace:
    best: tuple[float, str, list[Cell], list[Cell]] | None = None
    for kind in (*_ORDERED, *_NAMED):
        own = [c for c in cells if c.kind == kind]
        if kind == "state":
            own = [c for c in own if c.label != "uplift"]
        chosen = _concentrated(own, ordered=kind in _ORDERED)
        # misfit of any kind is slow: only a band above that tells something
        if chosen and not (kind == "frequency" and chosen[0].low < _SLOW_BAND):
            gain = _part(own, chosen, "excess") - _part(own, chosen, "samples")
            if best is None or gain * _telling(relation, kind) > best[0] * _telling(relation, best[1]):
                best = (gain, kind, own, chosen)
    direction = _direction(cells, found)
    called = NAMES[relation][0]
    subject = ", ".join([called, *([direction] if direction else []), *_pads(cells)])
    if best is None or best[0] < _WORTH:
        return ErrorPlace(
            relation, f"{subject}: {error:.1f} floors everywhere alike", error, error, 1.0, 1.0, "", direction
        )
    _, kind, own, chosen = best
    rest = [c for c in own if c not in chosen]
    here, there = _rms(chosen), _rms(rest)
    share, part = _part(own, chosen, "excess"), _part(own, chosen, "samples")
    where = _where(kind, own, chosen)
    if not any(c.above for c in rest) and is_at_floor(there):
        words = f"{subject}: above the floor only {where}: {here:.1f} floors there, {there:.1f} elsewhere"
    else:
        most = "most of it" if share >= _MOST else f"{share:.0%} of it"
        words = f"{subject}: {most} {where}: {here:.1f} floors there, {there:.1f} elsewhere"
    return ErrorPlace(relation, words, here, there, share, part, kind, direction)


def _telling(relation: str, kind: str) -> float:
    return _TELLING.get(kind, 1.0) if relation == "pads" or kind != "since reversal" else 1.0


def _patterned(relation: str, cells: Sequence[Cell], pattern: Pattern) -> ErrorPlace:
    """Say where the mean residual is largest, and what it means: too much or too little, or always one way."""
    bins, is_odd = pattern.strongest()
    part = pattern.odd if is_odd else pattern.even
    own = [c for c in cells if c.kind == pattern.kind]
    chosen = own[bins]
    rest = [c for c in own if c not in chosen]
    direction = pattern.directions(bins)
    weight = pattern.samples[bins]
    there = float((weight * part[bins]).sum() / weight.sum())
    here, elsewhere = _rms(chosen), _rms(rest)
    after = ["after reversals"] if pattern.kind == "since reversal" else []
    subject = ", ".join([NAMES[relation][0], *after, *([direction] if direction else []), *_pads(cells)])
    if relation == "pads":
        means = f"measured friction {abs(there):.1f} floors {'above' if there > 0 else 'below'} the model's"
        means = means if is_odd else f"a force of {abs(there):.1f} floors to {'+x' if there > 0 else '−x'}"
    else:
        means = f"{abs(there):.1f} floors, {'with' if is_odd else 'whatever'} the direction of sliding"
    if rest:
        words = f"{subject}: {_where(pattern.kind, own, chosen)}, {means}"
        words += f" ({here:.1f} floors rms, {elsewhere:.1f} elsewhere)"
    else:
        words = f"{subject}: {means}, everywhere alike ({here:.1f} floors rms)"
    share, size = _part(own, chosen, "excess"), _part(own, chosen, "samples")
    return ErrorPlace(relation, words, here, elsewhere, share, size, pattern.kind, direction)


def _concentrated(cells: Sequence[Cell], *, ordered: bool) -> list[Cell]:
    """Return the cells that hold much more of the excess than of the samples: neighbours where cells have an order."""
    samples, excess = sum(c.samples for c in cells), sum(c.excess for c in cells)
    if len(cells) < 2 or excess <= 0.0:
        return []
    gains = [c.excess / excess - c.samples / samples for c in cells]
    if not ordered:
        return [c for c, gain in zip(cells, gains, strict=True) if gain > 0.02 and c.above]
    best, chosen = 0.0, (0, 0)
    for i in range(len(cells)):
        for j in range(i + 1, len(cells) + 1):
            if j - i < len(cells) and sum(gains[i:j]) > best:
                best, chosen = sum(gains[i:j]), (i, j)
    return [c for c in cells[chosen[0] : chosen[1]]]


def _part(cells: Sequence[Cell], chosen: Sequence[Cell], what: str) -> float:
    total = sum(getattr(c, what) for c in cells)
    return sum(getattr(c, what) for c in chosen) / total if total > 0.0 else 0.0


def _rms(cells: Sequence[Cell]) -> float:
    count = sum(c.samples for c in cells)
    return (sum(c.samples * c.error**2 for c in cells) / count) ** 0.5 if count else 0.0


def _where(kind: str, cells: Sequence[Cell], chosen: Sequence[Cell]) -> str:
    if kind == "state":
        return "in " + " and ".join(c.label for c in chosen)
    if kind == "pad":
        return "on pad " + " and ".join(c.label for c in chosen)
    if kind == "run":
        return "in run " + " and ".join(c.label for c in chosen)
    unit, factor = UNITS[kind]
    first, last = chosen[0] is cells[0], chosen[-1] is cells[-1]
    low, high = f"{factor * chosen[0].low:.3g}", f"{factor * chosen[-1].high:.3g} {unit}"
    if kind == "since reversal":
        if first:
            return f"within {high} after a reversal"
        return f"more than {low} {unit} after a reversal" if last else f"from {low} to {high} after a reversal"
    names = {
        "speed": "at speeds",
        "pressure": "at pressures",
        "position": "at slips",
        "path": "at slid paths of the campaign",
        "time": "at times",
        "frequency": "at frequencies",
    }
    if first and kind != "position":
        return f"{names[kind]} below {high}"
    return f"{names[kind]} above {low} {unit}" if last else f"{names[kind]} from {low} to {high}"


def _direction(cells: Sequence[Cell], found: Parity | None) -> str:
    sides = {c.label: c for c in cells if c.kind == "direction"}
    plus, minus = sides.get("sliding to +x"), sides.get("sliding to −x")
    if plus is None or minus is None or found is None:
        return ""
    if plus.above != minus.above and max(plus.error, minus.error) > AT_FLOOR * min(plus.error, minus.error):
        return "only sliding to +x" if plus.above else "only sliding to −x"
    ratio = max(plus.error, minus.error) / max(min(plus.error, minus.error), 1e-12)
    even = found.even > _EVEN * max(found.odd, found.even, 1e-12) and found.even > 0.5
    return "both directions, unequal" if ratio > _EQUAL or even else "both directions, equal"


def _pads(cells: Sequence[Cell]) -> list[str]:
    own = [c for c in cells if c.kind == "pad"]
    above = [c for c in own if c.above]
    if (
        len(own) < 2
        or not above
        or len(above) == len(own)
        and max(c.error for c in own) < 1.3 * min(c.error for c in own)
    ):
        return []
    if len(above) < len(own):
        return ["pad " + " and ".join(c.label for c in above)]
    worst = max(own, key=lambda c: c.error)
    return [f"pad {worst.label} most"]
