"""The tables and sentences of a plan, for terminal, page and CSV."""

from collections.abc import Sequence
from string import ascii_uppercase
from typing import Any

from slipwise.planning.chances import Chance
from slipwise.planning.gauge_kits import Remedy
from slipwise.planning.result import GaugeSet, PlannedTest
from slipwise.units import convert
from slipwise.view.words.numbers import counted, unit_of_size

#: Beyond so many limits of materiality nothing is said of from where an effect is named [1].
_FAR = 1e3
#: Partners that a cell lists before it counts the rest.
_MOST = 4


def name_sets(found: PlannedTest) -> dict[str, GaugeSet]:
    """Return the sets of gauges by the letter that tables and pictures call them by; A is the planned one."""
    return dict(zip(ascii_uppercase, found.sets, strict=False))


def percent(share: float) -> int:
    """Return a share in whole percent."""
    return round(100.0 * share)


def write_size(chance: Chance) -> str:
    """Write the size of an effect at its limit with its unit, "5.4 mm"."""
    if chance.unit == "1":
        return f"{abs(chance.value):.3g}"
    unit = unit_of_size(chance.unit, chance.value)
    return f"{abs(convert(chance.value, chance.unit, unit)):.3g} {unit}"


def write_least(chance: Chance) -> str:
    """Write from how many limits an effect is named, "1.8"; "never" where its relation hardly moves."""
    return f"{chance.least:.2g}" if chance.least < _FAR else "never"


def list_effect_rows(one: GaugeSet, *, others: bool = True) -> list[dict[str, Any]]:
    """Return a row for each effect of the rig that may matter in the planned motions.

    Args:
        one: a set of gauges.
        others: whether for what it is taken is a column, where it is taken for anything.
    """
    rows = []
    others = others and any(c.taken_for for c in one.of_rig)
    for c in (c for c in one.of_rig if c.possible):
        row = {"effect": c.effect, "at its limit": write_size(c), "seen [%]": percent(c.seen)}
        row |= {"named [%]": percent(c.named), "from [limits]": write_least(c)}
        rows.append(row | ({"taken for": _taken_for(c)} if others else {}))
    return rows


def list_classes(one: GaugeSet) -> list[str]:
    """Return the kinds that are several effects, each with its effects."""
    faults = [f for f in one.structure.faults if not f.channels and len(f.effects) > 1]
    return [f"{f.name}: {', '.join(f.effects)}" for f in faults]


def _taken_for(chance: Chance) -> str:
    return ", ".join(f"{name} ({percent(share)} %)" for name, share in chance.taken_for)


def list_gauge_rows(one: GaugeSet) -> list[dict[str, Any]]:
    """Return a row for each kind of fault of a gauge: the mean over the gauges on which it may sit."""
    by_effect: dict[str, list[Chance]] = {}
    for c in (c for c in one.chances if c.place):
        by_effect.setdefault(c.effect, []).append(c)
    rows = []
    for effect, of in by_effect.items():
        best = min(of, key=lambda c: c.least)
        row = {"fault": effect, "on gauges": len(of)}
        row |= {"seen [%]": percent(_mean([c.seen for c in of])), "named [%]": percent(_mean([c.named for c in of]))}
        rows.append(row | {"from [limits]": write_least(best), "soonest on": best.place})
    return rows


def _mean(values: Sequence[float]) -> float:
    return sum(values) / max(len(values), 1)


def list_set_rows(found: PlannedTest) -> list[dict[str, Any]]:
    """Return a row for each set of gauges."""
    rows, every = [], {c.effect for one in found.sets for c in one.of_rig if c.possible}
    for letter, one in name_sets(found).items():
        told, seen, _ = one.structure.score
        row: dict[str, Any] = {"set": letter, "gauges": one.words, "channels": len(one.channels)}
        row |= {"can be seen": seen, "told apart": told}
        # over the same effects in every row: one that a set cannot show is not named
        named = sum(c.named for c in one.of_rig if c.possible) / max(len(every), 1)
        rows.append(row | {"named [%]": percent(named) if one.chances else None})
    return rows


def list_matrix_rows(found: PlannedTest) -> list[dict[str, Any]]:
    """Return effects by sets of gauges: chance to name each [%]; "-" where a set cannot show it."""
    sized = {letter: one for letter, one in name_sets(found).items() if one.chances}
    names = dict.fromkeys(c.effect for one in sized.values() for c in one.of_rig if c.possible)
    rows = []
    for name in names:
        row: dict[str, Any] = {"effect": name}
        for letter, one in sized.items():
            chance = one.chance_of(name)
            row[letter] = "-" if chance is None else percent(chance.named)
        rows.append(row)
    return rows


def list_motion_rows(found: PlannedTest) -> list[dict[str, Any]]:
    """Return the motions in their sequence."""
    return [
        {
            "motion": m.motion,
            "slip [mm]": round(1e3 * m.slip, 1),
            "alone [%]": percent(m.named),
            "so far [%]": percent(m.together),
        }
        for m in found.motions
    ]


def list_motion_lines(found: PlannedTest) -> list[str]:
    """Return the motions in their sequence as lines, for a terminal that would break their names in a table."""
    return [
        f"{m.order}. {m.motion}: {percent(m.named)} % alone, {percent(m.together)} % with all before it"
        for m in found.motions
    ]


def list_kind_rows(one: GaugeSet) -> list[dict[str, Any]]:
    """Return a row for each kind of fault: whether the gauges show it, and with what they confuse it."""
    structure = one.structure
    rows = []
    for kind, of in structure.kinds.items():
        fault = structure.faults[of[0]]
        partners = [b if a == kind else a for a, b in structure.confused if kind in (a, b)]
        more = f" and {len(partners) - _MOST} more" if len(partners) > _MOST else ""
        what = "any fault of the gauge" if fault.channels else counted(len(fault.effects), "effect")
        row = {"kind": kind, "what": what, "can be seen": kind not in structure.unseen}
        rows.append(row | {"confused with": ", ".join(partners[:_MOST]) + more})
    return rows


def list_advice(found: PlannedTest) -> list[str]:
    """Return what to add, fewest channels first, and what that would show or separate; then what no gauge would."""
    planned = set(found.planned.channels)
    by_kits: dict[tuple[str, ...], list[Remedy]] = {}
    for remedy in found.remedies:
        by_kits.setdefault(tuple(c for c in remedy.channels if c not in planned), []).append(remedy)
    out = []
    for added, remedies in sorted(by_kits.items(), key=lambda of: len(of[0])):
        if added:
            gauges = " and ".join(kit.words for kit in remedies[0].kits)
            gains = "; ".join(_list_gains(remedies))
            out.append(f"Add {gauges} ({counted(len(added), 'channel')}: {', '.join(added)}): {gains}.")
    if () in by_kits:
        pairs = "; ".join(_list_gains(by_kits[()]))
        out.append(f"No gauge of this list does it, only form and size in a motion may: {pairs}.")
    return out


def _list_gains(remedies: Sequence[Remedy]) -> list[str]:
    """Return what remedies show and separate: what can be seen, then each kind with all that part from it."""
    seen = [r.first for r in remedies if not r.second]
    out = [f"{listed(seen)} can be seen"] if seen else []
    partners: dict[str, list[str]] = {}
    for r in (r for r in remedies if r.second and r.first != r.second):
        partners.setdefault(r.second, []).append(r.first)
    for kind, others in partners.items():
        out.append(f"{listed(others)} {'parts' if len(others) == 1 else 'part'} from {kind}")
    out += [f"{r.first} of one pad parts from that of another" for r in remedies if r.first == r.second]
    return out


def listed(names: Sequence[str]) -> str:
    """Write names as a list in a sentence, "a, b and c"."""
    return " and ".join(filter(None, [", ".join(names[:-1]), names[-1]]))
