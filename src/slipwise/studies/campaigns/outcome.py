"""What is kept of one campaign of many: the verdict, the sizes and the base parameters, as plain numbers."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from slipwise.diagnosis.result import Diagnosis, written
from slipwise.estimation.intervals import compute_intervals, compute_standard_error
from slipwise.short_repr import short_repr

#: Of diagnosis.json.
_KEPT = (
    "campaign", "verdict", "effects", "minor", "probability", "component", "base_error", "final_error", "confirmed",
    "system", "cannot_tell", "words", "seconds",
)  # fmt: skip


@short_repr
@dataclass(frozen=True)
class Outcome:
    """One campaign of many.

    Attributes:
        name: of its folder among the results.
        numbers: what `numbers_of` gives; only "failed", the reason, where it could not be diagnosed, and "traceback"
            where that was no fault of the input.
    """

    name: str
    numbers: Mapping[str, Any]

    @property
    def failed(self) -> str:
        """Why it could not be diagnosed; "" where it was."""
        return str(self.numbers.get("failed", ""))

    @property
    def sizes(self) -> Mapping[str, Mapping[str, Any]]:
        """Fitted parameters of the effects that were found, label.parameter -> value, low, high, unit."""
        return self.numbers.get("sizes", {})

    @property
    def base(self) -> Mapping[str, Mapping[str, Any]]:
        """Fitted base parameters, key -> value, low, high, unit."""
        return self.numbers.get("base", {})

    def has(self, effect: str) -> str:
        """Return whether an effect was found.

        Returns:
            "yes", "minor" (present, but not material), "perhaps" (one explanation of an ambiguous verdict), "untested",
            "unknown" (something is there that has no name), "failed" or "no".
        """
        if self.failed:
            return "failed"
        if effect in self.numbers["effects"]:
            return "perhaps" if self.numbers["verdict"] == "ambiguous" else "yes"
        if effect in self.numbers["minor"]:
            return "minor"
        if any(words.startswith(f"{effect}: ") for words in self.numbers["cannot_tell"]):
            return "untested"
        return "unknown" if self.numbers["verdict"] == "unknown" else "no"


def numbers_of(found: Diagnosis) -> dict[str, Any]:
    """Return what is kept of a diagnosis, as JSON can hold it."""
    content = found.as_json()
    added = tuple(f"{term.label}." for term in found.search.best.terms) if found.added else ()
    best = next(iter(content["candidates"]), {"parameters": {}})
    entries = [entry for entry in compute_intervals(found.final).entries if not entry.key.startswith(added)]
    return {
        **{name: content[name] for name in _KEPT},
        "rig": found.final.campaign.rig,
        "held_out": found.held_out,
        "sizes": best["parameters"] if added else {},
        "base": {entry.key: written(entry) for entry in entries},
    }


def standard_error(entry: Mapping[str, Any]) -> float | None:
    """Return the standard error of a number [its unit]; None where it ended on a bound or is a limit only."""
    if entry.get("at_bound") or entry.get("limit") or entry["low"] is None or entry["high"] is None:
        return None
    return compute_standard_error(entry["low"], entry["high"]) or None
