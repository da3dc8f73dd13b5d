"""What a page says of a discovery beside its sentence: states, ports and gates in words, units that people read."""

from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.law import Law
from slipwise.discovery.result import Discovery
from slipwise.residual_map.states import UNITS, WORDS
from slipwise.units import convert
from slipwise.view.words.numbers import in_words, unit_of_size

#: Port -> how it enters, and what its curve is, with its unit.
_PORTS: dict[str, tuple[str, str]] = {
    "adds to mu": ("adds to the coefficient of friction", "added to the coefficient of friction [1]"),
    "multiplies mu": ("multiplies friction", "change of friction, as a share of it [1]"),
    "adds to friction": ("adds to friction whatever the load", "added to friction, over the mean load [1]"),
    "even force on pads": ("pushes each pad, whichever way it slides", "push on a pad, over its load [1]"),
    "girder": ("holds the girder back against its motion", "force against the girder's motion [N]"),
    "girder by place": ("pushes the girder whichever way it moves", "push on the girder [N]"),
    "load": ("lifts the girder off its pads", "lift on the girder [N]"),
    "multiplies buffers": ("multiplies the buffers' force", "change of the buffers' force, as a share of it [1]"),
}
#: Evidence -> headline of the page.
HEADLINES: dict[str, str] = {
    "law": "A law was found",
    "state": "What it depends on was found; more than one form fits",
    "organised": "One state puts it in order, but no law was found",
    "unknown": "No law was found",
    "nothing": "Nothing is left that a law could explain",
}
_MEANS: dict[str, str] = {
    "law": "The law explains what the model lacked, and on runs that no fit has seen as well. No other state and no "
    "other form that was tried does.",
    "state": "The state explains most of what the model lacked. More than one form does, or the law leaves more than "
    "noise on runs that no fit has seen.",
    "organised": "At least half of what the model lacked goes with this state, but too much is left, or another state "
    "explains as much: the state may stand for one that was not tried.",
    "unknown": "No state explains half of what the model lacks. Below stands what comes nearest.",
    "nothing": "The error of every balance is at the noise floor.",
}


def state_words(name: str) -> str:
    """Name a state in words."""
    return WORDS[name]


def state_axis(name: str, size: float) -> tuple[str, float]:
    """Return the label of a state's axis for values of this size [SI], and the factor into its unit."""
    unit = UNITS.get(name, "m")
    shown = unit_of_size(unit, size)
    words = state_words(name).removeprefix("the ")
    return f"{words} [{shown}]", convert(1.0, unit, shown)


def port_words(name: str) -> str:
    """Say how a law enters."""
    return _PORTS[name][0]


def height_axis(port: str) -> str:
    """Return the label of the axis of a port's curve."""
    return _PORTS[port][1]


def meaning(evidence: str) -> str:
    """Say what the evidence bears."""
    return _MEANS[evidence]


def number_rows(law: Law) -> list[dict[str, str]]:
    """Return a law's numbers with their intervals, in units that people read."""
    rows = []
    for c in law.constants:
        unit = unit_of_size(c.unit, c.value)
        value, low, high = (f"{convert(x, c.unit, unit):.5g}" if x == x else "" for x in (c.value, c.low, c.high))
        value = "open" if c.bound else value
        interval = f"{low} to {high}" if low else "none: chosen, not fitted"
        interval = f"the fit ran to the {c.bound} end of what was tried" if c.bound else interval
        rows.append({"number": c.name, "value": value, "95 % interval": interval, "unit": "" if unit == "1" else unit})
    return rows


def shape_lines(found: Discovery) -> list[str]:
    """Return what explains most, described without a form, and which effects of the catalogue could stand for it."""
    shape = found.shape
    out = [] if shape is None else [f"without a form, over {state_words(shape.state)}: {shape.words}"]
    of = found.laws[0].alike if found.laws else found.organised.alike if found.organised else {}
    others = {name: share for name, share in of.items() if name not in found.beside}
    return out + [f"{name} could explain {100.0 * share:.0f} % of this curve" for name, share in others.items()]


def range_words(law: Law) -> str:
    """Say for which states the law is known."""
    parts = []
    for state, (low, high) in law.valid.items():
        unit = UNITS.get(state, "m")
        shown = unit_of_size(unit, max(abs(low), abs(high)))
        ends = " to ".join(f"{convert(x, unit, shown):.3g}" for x in (low, high))
        parts.append(f"{state_words(state)} from {ends} {'' if shown == '1' else shown}".rstrip())
    return f"Known for {' and '.join(parts)}: the range of the data. Beyond it nothing is known."


def tied_words(law: Law) -> list[str]:
    """Say which forms and which other states cannot be told from a law."""
    if not law.tied and not law.rivals:
        return ["No other state and no other form that was tried leaves as little."]
    out = []
    if law.tied:
        forms = " and ".join(law.tied)
        verb = "cannot be told apart from it" if len(law.tied) > 1 else "cannot be told from it"
        out.append(f"Over the same state, the {'forms' if len(law.tied) > 1 else 'form'} {forms} {verb} by these data.")
    if law.rivals:
        count = "Another explanation leaves" if len(law.rivals) == 1 else f"{_counted(law)} other explanations leave"
        out.append(f"{count} as little: {'; '.join(law.rivals)}.")
    return out


def _counted(law: Law) -> str:
    return in_words(len(law.rivals)).capitalize()


def looked_at_rows(found: Discovery) -> list[dict[str, str]]:
    """Return the best candidates of the screen, best first."""
    return [
        {
            "depends on": " and ".join(state_words(s.name) for s in c.states),
            "how it enters": port_words(c.port.name),
            "where": gate_words(c),
            "explains": f"{100.0 * max(c.share, 0.0):.0f} %",
        }
        for c in found.looked_at
    ]


def gate_words(candidate: CurveCandidate) -> str:
    """Say on which pads, or which way, something acts."""
    if candidate.port.relation != "pads":
        return "the girder"
    return "every pad, both ways" if candidate.gate.name == "all" else candidate.gate.name
