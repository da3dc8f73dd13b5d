"""What gauges could show whatever the motion: which effects and faults of gauges the balances hold and tell apart."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np

from slipwise.channels import part_of
from slipwise.effects import Effect
from slipwise.planning.balance_equations import BalanceEquations, list_broken, make_incidence
from slipwise.planning.structural_analysis import Diagnosability, analyse_structure, find_overdetermined
from slipwise.preparation.gauge_groups import find_places_of_gauges
from slipwise.record import Record
from slipwise.short_repr import short_repr

#: What an effect needs -> the equation that must check something, or no fit looks for it.
_CHECKED_BY = {"heave": "heave", "storeys": "storeys"}


@short_repr
@dataclass(frozen=True)
class Fault:
    """What breaks one set of equations: effects that no gauge can tell apart, or whatever may be wrong with a gauge.

    Attributes:
        name: of the only effect, of what effects have in common, of the channel, or "pad_*_N" of all cells of a kind.
        effects: that break these equations.
        equations: that do not hold.
        channels: on which it sits; none for an effect of the rig.
        needs: equations that must check something for a fit to look for it.
    """

    name: str
    effects: tuple[str, ...]
    equations: frozenset[str]
    channels: tuple[str, ...] = ()
    needs: frozenset[str] = frozenset()

    @property
    def kind(self) -> str:
        """Its name, "pad_?_N" for the cell of whichever pad."""
        if len(self.channels) != 1 or part_of(self.name)[0] != "pad":
            return self.name
        return f"pad_?_{self.name.rpartition('_')[2]}"


@short_repr
@dataclass(frozen=True)
class Structure:
    """What can be seen and told apart with some gauges.

    Attributes:
        channels: of the gauges.
        faults: that may be.
        answer: of the analysis, in the order of the faults.
    """

    channels: tuple[str, ...]
    faults: tuple[Fault, ...]
    answer: Diagnosability

    @cached_property
    def kinds(self) -> dict[str, list[int]]:
        """Kind of fault -> places of its faults."""
        out: dict[str, list[int]] = {}
        for place, fault in enumerate(self.faults):
            out.setdefault(fault.kind, []).append(place)
        return out

    @cached_property
    def unseen(self) -> tuple[str, ...]:
        """Kinds of faults of which not all can be seen."""
        return tuple(kind for kind, of in self.kinds.items() if not self.answer.detectable[of].all())

    @cached_property
    def confused(self) -> tuple[tuple[str, str], ...]:
        """Pairs of kinds, both of which can be seen, that are not told apart for every two of their faults."""
        seen = [kind for kind in self.kinds if kind not in self.unseen]
        out = []
        for one, other in [(kind, kind) for kind in seen] + list(combinations(seen, 2)):
            pairs = ((a, b) for a in self.kinds[one] for b in self.kinds[other] if a != b)
            if any(not self._apart(a, b) for a, b in pairs):
                out.append((one, other))
        return tuple(sorted(out))

    @property
    def told(self) -> tuple[str, ...]:
        """Kinds of effects of the rig that can be seen and are confused with nothing else."""
        unsure = {*self.unseen, *(kind for pair in self.confused for kind in pair)}
        return tuple(f.name for f in self.faults if not f.channels and f.name not in unsure)

    @property
    def score(self) -> tuple[int, int, int]:
        """How many effects are told from all else, how many can be seen, and how many faults of gauges are told."""
        unsure = {*self.unseen, *(kind for pair in self.confused for kind in pair)}
        effects = [f for f in self.faults if not f.channels]
        told, seen = (
            sum(len(f.effects) for f in effects if f.name not in without) for without in (unsure, self.unseen)
        )
        return told, seen, sum(1 for f in self.faults if f.channels and f.kind not in unsure)

    def _apart(self, a: int, b: int) -> bool:
        """Return whether two faults are told apart; a fault on one cell of many is a part of one on all of them."""
        one, other = self.faults[a].equations, self.faults[b].equations
        isolable = self.answer.isolable
        if one < other:
            return bool(isolable[b, a])
        if other < one:
            return bool(isolable[a, b])
        return bool(isolable[a, b] and isolable[b, a])


def list_faults(
    equations: BalanceEquations, channels: Sequence[str], effects: Iterable[Effect]
) -> tuple[list[Fault], dict[str, str]]:
    """Return what may be missing or wrong, and the effects that no balance of the rig holds, with the reason.

    Args:
        equations: of the rig.
        channels: of the gauges, whose faults count.
        effects: that may be; their faults of gauges among them.
    """
    by_equations: dict[tuple[frozenset[str], frozenset[str]], list[Effect]] = {}
    by_place: dict[str, tuple[tuple[str, ...], list[str]]] = {}
    cannot: dict[str, str] = {}
    used = [c for c in channels if equations.measured_by(c)]
    record = Record(np.arange(2.0), {c: np.zeros(2) for c in used})
    for effect in effects:
        if effect.port == "gauge":
            for place, targets in find_places_of_gauges(effect, record).items():
                by_place.setdefault(place, (targets, []))[1].append(effect.name)
            continue
        reason = _what_rig_lacks(effect, equations)
        broken = () if reason else list_broken(effect, equations)
        if broken:
            needs = frozenset(_CHECKED_BY[need] for need in effect.all_needs if need in _CHECKED_BY)
            by_equations.setdefault((frozenset(broken), needs), []).append(effect)
        else:
            cannot[effect.name] = reason or "no balance of this rig holds it"
    names = _name_classes(by_equations)
    out = [
        Fault(names[key], tuple(e.name for e in members), key[0], needs=key[1]) for key, members in by_equations.items()
    ]
    order = sorted(by_place, key=lambda place: (place.startswith("pad_"), "*" in place, place))
    for place in order:
        targets, members = by_place[place]
        out.append(Fault(place, tuple(dict.fromkeys(members)), frozenset(targets), targets))
    return out, cannot


def _what_rig_lacks(effect: Effect, equations: BalanceEquations) -> str:
    """Say what an effect needs that no gauge would give this rig; "" where it needs nothing of that kind."""
    specimen = equations.specimen
    free = specimen.free
    has = {
        "command": False,  # every fit is driven by the motion that was measured
        "buffers": free and bool(specimen.buffers),
        "balances": free,
        "heave": free,
        "across": free,
        "prescribed slip": not free,
        "storeys": bool(specimen.storeys),
        "several pads": len(specimen.pads) > 1,
    }
    return next((effect.without(need) for need in effect.all_needs if not has.get(need, True)), "")


def _name_classes(
    classes: Mapping[tuple[frozenset[str], frozenset[str]], Sequence[Effect]],
) -> dict[tuple[frozenset[str], frozenset[str]], str]:
    """Name a class by its only effect, or by the component of its effects; by their equations where that is two's."""
    components = [" and ".join(sorted({e.component for e in of})) for of in classes.values() if len(of) > 1]
    out: dict[tuple[frozenset[str], frozenset[str]], str] = {}
    for key, members in classes.items():
        component = " and ".join(sorted({e.component for e in members}))
        kinds = ", ".join(dict.fromkeys(name.partition(" ")[0] for name in sorted(key[0])))
        name = component if components.count(component) == 1 else f"{component} ({kinds})"
        out[key] = members[0].name if len(members) == 1 else name
    return out


def compute_structure(equations: BalanceEquations, faults: Sequence[Fault], channels: Sequence[str]) -> Structure:
    """Return what some gauges show of faults, those of gauges that are not among them left out.

    Args:
        equations: of the rig.
        faults: of `list_faults`.
        channels: of the gauges.
    """
    own = tuple(f for f in faults if set(f.channels) <= set(channels))
    incidence, broken = make_arrays(equations, own, channels)
    answer = analyse_structure(incidence, broken)
    checked = find_overdetermined(incidence)
    names = {name for name, here in zip(equations.with_gauges(channels), checked, strict=True) if here}
    looked_for = np.array([fault.needs <= names for fault in own], bool)
    answer = Diagnosability(answer.detectable & looked_for, answer.isolable & looked_for[:, None])
    return Structure(tuple(channels), own, answer)


def make_arrays(
    equations: BalanceEquations, faults: Sequence[Fault], channels: Sequence[str]
) -> tuple[np.ndarray, np.ndarray]:
    """Return which quantities stand in an equation (e, u), and which faults break it (e, f)."""
    whole = equations.with_gauges(channels)
    broken = np.array([[name in fault.equations for fault in faults] for name in whole], bool)
    return make_incidence(whole), broken.reshape(len(whole), len(faults))
