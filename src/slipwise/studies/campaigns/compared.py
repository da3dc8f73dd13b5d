"""Many campaigns side by side: what is common to all of them, and what differs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot

from slipwise.short_repr import short_repr
from slipwise.studies.campaigns.outcome import Outcome, standard_error

#: A number has changed when it differs by this many standard errors: of the thirty or so numbers of two campaigns, less
#: than one in ten pairs of campaigns would show one by chance.
CHANGED = 3.0


@short_repr
@dataclass(frozen=True)
class EffectDifference:
    """An effect that not all campaigns have.

    Attributes:
        effect: its name.
        has: campaign -> what `Outcome.has` says.
    """

    effect: str
    has: Mapping[str, str]


@dataclass(frozen=True)
class ValueChange:
    """A fitted number in two campaigns.

    Attributes:
        key: "rig.mass", "run_in.share" ...
        unit: SI unit.
        first: campaign, the first that has it.
        other: campaign that is held against it.
        before: value in the first [unit].
        after: value in the other [unit].
        errors: by how many standard errors of the difference they differ [1]; None where one of them has none.
    """

    key: str
    unit: str
    first: str
    other: str
    before: float
    after: float
    errors: float | None

    @property
    def significant(self) -> bool:
        """Whether it has changed by more than chance would."""
        return self.errors is not None and self.errors >= CHANGED


@short_repr
@dataclass(frozen=True)
class Compared:
    """What many campaigns say together.

    Attributes:
        common: effects that every campaign has that was diagnosed.
        differs: effects that some have.
        changes: numbers of the effects and, among campaigns of one rig, of the base model; largest change first.
    """

    common: tuple[str, ...]
    differs: tuple[EffectDifference, ...]
    changes: tuple[ValueChange, ...]


def compare_outcomes(outcomes: Sequence[Outcome]) -> Compared:
    """Hold campaigns against each other; those that failed take no part.

    Each number is held against that of the first campaign that has it.
    """
    told = [outcome for outcome in outcomes if not outcome.failed]
    names = dict.fromkeys(name for outcome in told for name in outcome.numbers["effects"])
    has = {name: {outcome.name: outcome.has(name) for outcome in told} for name in names}
    common = tuple(name for name in names if set(has[name].values()) == {"yes"})
    differs = tuple(EffectDifference(name, has[name]) for name in names if name not in common)
    rigs = dict.fromkeys(outcome.numbers["rig"] for outcome in told)
    changes = _changes([(outcome.name, outcome.sizes) for outcome in told])
    for rig in rigs:
        changes += _changes([(outcome.name, outcome.base) for outcome in told if outcome.numbers["rig"] == rig])
    changes.sort(key=lambda change: -(change.errors or 0.0))
    return Compared(common if len(told) > 1 else (), differs, tuple(changes))


def _changes(given: Sequence[tuple[str, Mapping[str, Mapping]]]) -> list[ValueChange]:
    """Return every number that two campaigns have: name of the campaign, and its numbers by key."""
    first: dict[str, tuple[str, Mapping]] = {}
    out = []
    for name, numbers in given:
        for key, entry in numbers.items():
            if entry["value"] is None:
                continue
            if key not in first:
                first[key] = (name, entry)
                continue
            origin, before = first[key]
            errors = _errors(before, entry)
            out.append(ValueChange(key, entry["unit"], origin, name, before["value"], entry["value"], errors))
    return out


def _errors(before: Mapping, after: Mapping) -> float | None:
    one, other = standard_error(before), standard_error(after)
    return None if one is None or other is None else abs(after["value"] - before["value"]) / hypot(one, other)
