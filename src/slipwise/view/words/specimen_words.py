"""One law over several specimens in sentences and tables."""

from typing import Any

from slipwise.specimens.result import OWN, SHARED, JointEffect, NumberOverSpecimens, SpecimensReport
from slipwise.units import convert
from slipwise.view.words.campaign_tables import shown_unit

#: Base numbers that tell of gauges and pads' timing, and not of the law that a user would carry on.
_NOT_OF_THE_LAW = ("rig.late_", "rig.pitch_", "rig.stick_")
#: So unlikely differences between specimens that are alike are told as a spread [1].
_DIFFER = 0.05
#: Columns of the table of effects, in order; those of the specimens follow.
_FIRST = ("effect", "of", "probability", "of what matters", "number", "mean", "spread")


def effect_sentences(found: SpecimensReport) -> list[str]:
    """Say of each effect what all campaigns say of it together, and what each says alone."""
    return [_shared_words(found, e) if e.of == SHARED else _own_words(found, e) for e in found.effects]


def _shared_words(found: SpecimensReport, of: JointEffect) -> str:
    count = len(found.names)
    alone = ", ".join(f"{100.0 * of.alone[name]:.0f} %" for name in found.names)
    if not of.named:
        by = f"no campaign names it alone (there by each alone: {alone})"
    elif len(of.named) == count:
        by = "each campaign names it"
    else:
        by = f"{', '.join(of.named)} {'name' if len(of.named) > 1 else 'names'} it alone (there by each alone: {alone})"
    words = (
        f"{of.effect} is in all {count} specimens ({_percent(of.probability)}), at {of.size:.2g} of what matters; {by}"
    )
    spread = [n for n in of.sizes if n.over is not None and n.over.differ < _DIFFER]
    if spread:
        words += f"; its size differs from specimen to specimen: {'; '.join(map(_spread_words, spread))}"
    if of.faint:
        words += (
            f"; it shows no more than {of.floors:.2g} noise floors in a campaign, and a small error of the model that "
            "every campaign repeats could do that as well"
        )
    return f"{words}."


def _own_words(found: SpecimensReport, of: JointEffect) -> str:
    chance, name = _percent(of.probability), of.specimen
    if any(e.effect == of.effect and e.of == SHARED for e in found.effects):
        words = f"{name} differs from the others in {of.effect} ({chance}), by {of.size:.2g} of what matters there"
    else:
        words = f"{of.effect} is a property of {name} ({chance}), at {of.size:.2g} of what matters there"
    others = [
        f"{other} {_number(n, n.values[other])} (standard error {_number(n, n.errors[other])})"
        for n in of.sizes
        for other in n.values
        if other != name
    ]
    words += f"; {of.sizes[0].key} of the others: {', '.join(others)}{_unit(of.sizes[0])}" if others else ""
    return f"{words}{'; it is faint' if of.faint else ''}."


def not_compared_words(found: SpecimensReport) -> list[str]:
    """Say which effects were not compared between rigs."""
    if not found.not_compared:
        return []
    names = [f"{name} [{', '.join(units)}]" for name, units in found.not_compared.items()]
    return [f"not compared, for a size of it belongs to the rig on which it was measured: {', '.join(names)}"]


def effect_rows(found: SpecimensReport) -> list[dict[str, Any]]:
    """Return one row for every strength of an effect."""
    rows = []
    for e in found.effects:
        for n in e.sizes or [None]:
            row: dict[str, Any] = {"effect": e.effect, "of": "all" if e.of != OWN else e.specimen}
            row |= {"probability": _percent(e.probability), "of what matters": f"{e.size:.2g}"}
            if n is not None:  # a mean over specimens says nothing of what one of them has alone
                own = {"number": _named(n), e.specimen: _number(n, n.values.get(e.specimen, float("nan")))}
                row |= own if e.of == OWN else _over(n)
            rows.append({name: row.get(name, "") for name in (*_FIRST, *found.names)})
    return rows


def number_rows(found: SpecimensReport) -> list[dict[str, Any]]:
    """Return one row for every base number of the law."""
    return [_over(n) for n in found.numbers if not n.key.startswith(_NOT_OF_THE_LAW)]


def _over(n: NumberOverSpecimens) -> dict[str, Any]:
    row: dict[str, Any] = {"number": _named(n)}
    if n.over is not None:
        o = n.over
        row |= {"mean": f"{_number(n, o.mean)} ({_number(n, o.low)} to {_number(n, o.high)})"}
        row |= {"spread": f"{_number(n, o.spread)} ({_number(n, o.spread_low)} to {_number(n, o.spread_high)})"}
    return row | {name: _number(n, value) for name, value in n.values.items()}


def _spread_words(n: NumberOverSpecimens) -> str:
    each = ", ".join(f"{name} {_number(n, value)}" for name, value in n.values.items())
    return f"{n.key} {each}{_unit(n)}"


def _named(n: NumberOverSpecimens) -> str:
    return f"{n.key} [{_shown(n)}]"


def _unit(n: NumberOverSpecimens) -> str:
    """Return the unit behind values, as the end of a sentence; nothing of a pure number."""
    return "" if _shown(n) == "1" else f" [{_shown(n)}]"


def _shown(n: NumberOverSpecimens) -> str:
    return shown_unit(n.key, n.unit)


def _number(n: NumberOverSpecimens, value: float) -> str:
    return f"{convert(value, n.unit, _shown(n)):.4g}"


def _percent(probability: float) -> str:
    return f"{100.0 * min(probability, 0.99):.0f} %"
