"""What is said of effects that are not named: how large they can be, and whether they would have been seen."""

from collections.abc import Mapping
from math import isfinite
from typing import Any

from slipwise.diagnosis.indistinguishable import list_known_effects
from slipwise.diagnosis.result import Diagnosis
from slipwise.effects import Effect
from slipwise.selection.power import EffectPower
from slipwise.selection.upper_limits import UpperLimit
from slipwise.units import convert
from slipwise.view.words.numbers import counted

#: Answer of a replay -> its heading, and the factor from SI; 1 kN cm are 10 J.
_RESPONSES = {
    "peak_slip": ("peak slip [mm]", 1e3),
    "energy": ("energy [kN cm]", 0.1),
    "largest_load": ("largest load [kN]", 1e-3),
}
#: Names that a sentence lists; the table has all.
_LISTED = 8
#: Where there is no number.
_NONE = "-"


def missed_words(found: Diagnosis) -> str:
    """Say what may be there at a size that matters without being seen; "" where no posterior was computed."""
    if not found.limits:
        return ""
    known = list_known_effects(found.search)
    missed = sorted(found.may_be_missed, key=lambda name: name in known and known[name].port == "gauge")
    if not missed:
        return f"Each of the {len(found.limits)} other effects that were tested is below what matters (95 %)."
    more = [f"{len(missed) - _LISTED} more"] if len(missed) > _LISTED + 1 else []
    names = [*missed[:_LISTED], *more] if more else missed
    listed = f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else names[0]
    return f"It could have missed, at a size that matters: {listed}."


def limit_rows(found: Diagnosis, *, brief: bool = False) -> list[dict[str, str]]:
    """Return one row for each effect that was not named: at most how large it is.

    Args:
        found: the diagnosis.
        brief: without those that are surely below what matters.
    """
    known = list_known_effects(found.search)
    shown = [limit for limit in found.limits.values() if limit.may_matter or not brief]
    asked = [r for r in _RESPONSES if any(r in limit.responses for limit in shown)]
    return [
        {
            "effect": limit.label if limit.label != limit.effect and not limit.responses else limit.effect,
            "at most": _own_unit(known.get(limit.effect), limit.parameter, limit.value) if limit.measured else _NONE,
            "of what matters": _short(limit.size) if limit.measured else "not told",
            **{_RESPONSES[r][0]: _changed(limit, r) for r in asked},
        }
        for limit in shown
    ]


def limit_sentence(effect: Effect | None, limit: Mapping[str, Any]) -> str:
    """Say how large an effect can be at most.

    Args:
        effect: None where it is not known here.
        limit: entry of `limits` of diagnosis.json.
    """
    if not limit["measured"]:
        return "This campaign says nothing of it."
    own = _own_unit(effect, limit["parameter"], limit["value"])
    moved = [
        f"{_short(factor * abs(limit[r]))} {head.partition('[')[2].rstrip(']')} of {head.partition(' [')[0]}"
        for r, (head, factor) in _RESPONSES.items()
        if limit.get(r)
    ]
    rest = ", ".join([*([own] if own != _NONE else []), *moved])
    return f"At most {_short(limit['size'])} times what matters (95 %)" + (f": {rest}." if rest else ".")


def _own_unit(effect: Effect | None, strength: str, size: float | None) -> str:
    """Write a limit in the unit in which its strength is read."""
    if effect is None or not strength or size is None or not isfinite(size):
        return _NONE
    parameter = effect.parameter(strength)
    shown = parameter.shown_in or parameter.unit
    zero = convert(0.0, parameter.unit, shown)  # a temperature's zero moves, a difference of temperatures does not
    value = convert(size, parameter.unit, shown) - zero
    return f"{strength} {_short(value)}" + ("" if shown == "1" else f" {shown}")


def _changed(limit: UpperLimit, response: str) -> str:
    if response not in limit.responses or not limit.measured:
        return _NONE
    value = abs(_RESPONSES[response][1] * limit.responses[response])
    return _short(value) if value >= 1e-3 else "0"


def _short(value: float) -> str:
    """Write a size in two figures."""
    return f"{value:.2g}" if abs(value) < 99.5 else f"{value:.0f}"


def power_rows(found: Diagnosis) -> list[dict[str, str]]:
    """Return one row for each effect that was put into twins of the campaign: what would have been said of it."""
    ordered = sorted(found.power.values(), key=lambda p: (-p.seen, -p.named, p.effect))
    return [
        {
            "effect": p.effect,
            "seen": _of_hundred(p.seen, p.twins),
            "named first": _of_hundred(p.named, p.twins),
            "else taken for": ", ".join(f"{n} ({_of_hundred(k, p.twins)})" for n, k in p.taken_for.items()) or _NONE,
        }
        for p in ordered
    ]


def power_words(found: Diagnosis) -> str:
    """Say in a sentence which effects would and would not have been seen; "" where nobody asked."""
    if not found.power:
        return ""
    every = sorted(found.power.values(), key=lambda p: -p.seen)
    sure = [p for p in every if p.seen >= 0.9 * p.twins]
    never = [p for p in every if p.seen <= 0.1 * p.twins]
    twins = counted(every[0].twins, "campaign")
    words = f"Of {twins} like this one with the effect at the limit of what matters:"
    parts = [f"{_names(sure)} would be seen nearly always" if sure else "no effect would be seen in nearly all"]
    parts += [f"{_names(never)} nearly never"] if never else []
    return f"{words} {'; '.join(parts)}."


def _names(found: list[EffectPower]) -> str:
    names = [p.effect for p in found]
    return f"{', '.join(names[:-1])} and {names[-1]}" if len(names) > 1 else names[0]


def _of_hundred(count: int, twins: int) -> str:
    return f"{100.0 * count / max(twins, 1):.0f} %"
