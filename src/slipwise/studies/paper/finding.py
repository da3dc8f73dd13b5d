"""What is said of one table, figure or sentence of the paper."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from slipwise.errors import SettingError
from slipwise.short_repr import short_repr

HOLDS, LIMITS, FAILS, UNCHECKED = "holds", "holds with limits", "does not hold", "cannot be checked"
VERDICTS = (HOLDS, LIMITS, FAILS, UNCHECKED)


@short_repr
@dataclass(frozen=True)
class Finding:
    """One statement of the paper and what became of it.

    Attributes:
        place: where the paper makes it, e.g. "Table 1" or "Conclusion 2".
        says: what the paper states, in our words.
        brief: what we get, in half a line.
        gets: what we get, with numbers.
        verdict: one of `VERDICTS`.
        why: the range within which it holds, or why it cannot be checked.
        assumed: names of settings, or words, on which the answer rests.
        numbers: behind `gets`, as JSON can hold them.
    """

    place: str
    says: str
    brief: str
    gets: str
    verdict: str
    why: str
    assumed: tuple[str, ...] = ()
    numbers: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse a verdict that is none."""
        if self.verdict not in VERDICTS:
            raise SettingError(f"{self.verdict!r} is no verdict; possible: {', '.join(VERDICTS)}")


@short_repr
@dataclass(frozen=True)
class Study:
    """One section of the paper, re-enacted.

    Attributes:
        name: short, the key in paper.json.
        title: as a heading.
        findings: in the paper's order.
        tables: heading -> rows (column -> value) as they are printed.
        curves: arrays for the pictures [SI]; they do not go into paper.json.
    """

    name: str
    title: str
    findings: tuple[Finding, ...]
    tables: Mapping[str, list[dict[str, Any]]] = field(default_factory=dict)
    curves: Mapping[str, Any] = field(default_factory=dict)
