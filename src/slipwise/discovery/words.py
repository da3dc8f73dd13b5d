"""A discovery in sentences: no more than the evidence bears."""

from slipwise.discovery.law import Discovery, Law
from slipwise.discovery.states import UNITS

#: A law's form in a sentence.
_HOW = {
    "adds to mu": "adds to the coefficient of friction",
    "multiplies mu": "scales friction as a whole",
    "adds to friction": "adds to friction whatever the load",
    "even force on pads": "pushes each pad by a share of its load, whichever way it slides",
    "girder": "holds the girder back, and no pad carries it",
    "girder by place": "pushes the girder whichever way it moves, and no pad carries it",
    "load": "lifts the girder off its pads",
    "multiplies buffers": "scales the buffers' force",
}


def sentence(found: Discovery) -> str:
    """Say what was found, how sure that is, and within which range of the data."""
    before, after = found.relations.get(found.worst, (0.0, 0.0))
    errors = f"error of {found.worst} {before:.2f} to {after:.2f} floors on what no fit has seen"
    if found.evidence == "nothing":
        return "Nothing is left that a law could explain: what the model leaves is at its noise."
    if found.evidence == "unknown" or not found.laws:
        return f"Unknown: {_not_confirmed(found)}. No law is claimed."
    told = "; and ".join(_told(law) for law in found.laws)
    if found.evidence == "organised":
        share = f"{100 * found.share:.0f} %"
        return f"Organised by {told}: {share} explained, the driver was not found. No law is claimed; {errors}."
    start = "A law" if found.evidence == "law" else "The state is known, the form open"
    beside = f" Found beside {', '.join(found.beside)}." if found.beside else ""
    return f"{start}: {told}; {errors}. {_range(found)}{beside} No mechanism is claimed."


def _not_confirmed(found: Discovery) -> str:
    best = found.organised
    if best is None:
        return "no state and form explain half of what the model leaves"
    share = f"{100 * found.share:.0f} %"
    if found.share < 0.5:
        return f"no state and form explain half of what the model leaves; most, {share}, goes with {best.label}"
    left = f"what the model leaves in {best.port.relation}"
    return f"{share} of {left} goes with {best.label}, but no fit of the whole model with such a law confirms it"


def _told(law: Law) -> str:
    where = "" if law.where == "all" else f" ({law.where})"
    forms = f"{law.form}" + (f"; {', '.join(law.tied)} cannot be told apart from it" if law.tied else "")
    return f"what depends on {law.driver}{where} {_HOW[law.port]}, {law.equation} [{forms}]"


def _range(found: Discovery) -> str:
    ends = {s: e for law in found.laws for s, e in law.valid.items()}
    return "Known for " + ", ".join(f"{s} {a:.3g} to {b:.3g} {UNITS.get(s, 'm')}" for s, (a, b) in ends.items()) + "."
