"""Many campaigns in tables and sentences: one row each, what is common to all, and what differs."""

from collections.abc import Mapping, Sequence
from typing import Any

from slipwise.effects import catalogue
from slipwise.specimens.result import SpecimensReport
from slipwise.studies.campaigns import Compared, EffectDifference, Outcome, Scored, ValueChange, rates
from slipwise.units import convert
from slipwise.view.words.diagnosis_words import floors
from slipwise.view.words.number_names import CALLED
from slipwise.view.words.numbers import counted, usual_unit

#: What `Outcome.has` says -> how it is told of several campaigns.
_TOLD = {
    "yes": "has it: {}",
    "perhaps": "may have it, one of several explanations: {}",
    "minor": "present, but not material: {}",
    "no": "has it not: {}",
    "unknown": "something without a name instead: {}",
    "untested": "could not test it: {}",
}


def title(count: int) -> str:
    """Head a table of campaigns."""
    return f"{counted(count, 'campaign')}; error before and after, in noise floors"


def campaign_rows(outcomes: Sequence[Outcome]) -> list[dict[str, Any]]:
    """Return one row for every campaign; why one could not be diagnosed is told by `failure_sentences`."""
    return [_row(outcome) for outcome in outcomes]


def failure_sentences(outcomes: Sequence[Outcome]) -> list[str]:
    """Say why campaigns could not be diagnosed: such words are too long for a table."""
    return [f"{outcome.name} failed: {outcome.failed}" for outcome in outcomes if outcome.failed]


def score_rows(scored: Sequence[Scored]) -> list[dict[str, Any]]:
    """Return one row for every campaign whose answer is known."""
    rows = []
    for one in scored:
        said = one.outcome.numbers
        row = {"campaign": one.outcome.name, "right": "yes" if one.right else "NO"}
        row["hidden"] = " + ".join(one.missing) or "nothing"
        if one.outcome.failed:
            rows.append({**row, "verdict": "failed, see below"})
            continue
        row |= {
            "verdict": _verdict(said),
            "probability": said["probability"],
            "error": " to ".join(_fall(said).values()),
        }
        rows.append({**row, "time [s]": round(said["seconds"])})
    return rows


def rate_rows(scored: Sequence[Scored]) -> list[dict[str, Any]]:
    """Return how many of how many were right, and the mistakes that mislead most; nothing of what there was none."""
    counted = rates(scored)
    return [{"": what, "campaigns": f"{count} of {total}"} for what, (count, total) in counted.items() if total]


def compared_sentences(found: Compared) -> tuple[list[str], list[str]]:
    """Say what is common to all campaigns, and what differs."""
    common = [", ".join(found.common)] if found.common else []
    changed = [change for change in found.changes if change.significant]
    return common, [*map(_difference, found.differs), *map(change_words, changed)]


def change_words(of: ValueChange) -> str:
    """Say how a number changed from one campaign to another."""
    unit = shown_unit(of.key, of.unit)
    before, after = (f"{convert(value, of.unit, unit):.4g}" for value in (of.before, of.after))
    errors = "" if of.errors is None else f", by {of.errors:.1f} standard errors"
    shown = "" if unit == "1" else f" {unit}"
    return f"{of.key} changed from {before} to {after}{shown} between {of.first} and {of.other}{errors}"


def flat_rows(outcomes: Sequence[Outcome]) -> list[dict[str, Any]]:
    """Return one row for every campaign with all its numbers, SI: for a spreadsheet."""
    rows = []
    for outcome in outcomes:
        said = outcome.numbers
        row: dict[str, Any] = {"campaign": outcome.name, "failed": outcome.failed}
        if not outcome.failed:
            row |= {k: said[k] for k in ("rig", "verdict", "probability", "base_error", "final_error", "confirmed")}
            row |= {k: " + ".join(said[k]) for k in ("effects", "minor")}
            for key, entry in {**outcome.sizes, **outcome.base}.items():
                row[f"{key} [{entry['unit']}]"] = entry["value"]
                row |= {f"{key} {end}": entry[end] for end in ("low", "high")}
        rows.append(row)
    return rows


def summary_json(
    outcomes: Sequence[Outcome], found: Compared, together: SpecimensReport | None = None
) -> dict[str, Any]:
    """Return the content of summary.json, with the law over all where there is one."""
    changes = [
        {"key": c.key, "first": c.first, "other": c.other, "before": c.before, "after": c.after, "unit": c.unit,
         "standard_errors": None if c.errors is None else round(c.errors, 2), "changed": c.significant}
        for c in found.changes
    ]  # fmt: skip
    return {
        "schema": 1,
        "campaigns": [{"name": outcome.name, **outcome.numbers} for outcome in outcomes],
        "common": list(found.common),
        "differs": [{"effect": d.effect, "has": dict(d.has)} for d in found.differs],
        "changes": changes,
        "specimens": None if together is None else together.as_json(),
    }


def size_words(key: str, entry: Mapping[str, Any]) -> str:
    """Write a fitted number with its interval, in the unit in which people read it."""
    unit = shown_unit(key, entry["unit"])
    value, low, high = (
        "" if entry[end] is None else f"{convert(entry[end], entry['unit'], unit):.3g}"
        for end in ("value", "low", "high")
    )
    shown = "" if unit == "1" else f" {unit}"
    if entry.get("at_bound"):
        return f"{key} {value}{shown} (on its bound)"
    if entry.get("limit"):
        return f"{key} at most {high}{shown}"
    return f"{key} {value}{shown} ({low} to {high})" if low and high else f"{key} {value}{shown}"


def _row(outcome: Outcome) -> dict[str, Any]:
    said = outcome.numbers
    if outcome.failed:
        return {"campaign": outcome.name, "verdict": "failed, see below"}
    sizes = [
        size_words(key, entry)
        for key, entry in outcome.sizes.items()
        if key.partition(".")[0].partition("[")[0] in said["effects"]
    ]
    row = {"campaign": outcome.name, "verdict": _verdict(said), "sizes (95 % interval)": "; ".join(sizes)}
    return {**row, "probability": said["probability"], **_fall(said)}


def _verdict(said: Mapping[str, Any]) -> str:
    """Write the kind of a verdict, and what it names."""
    named = (" or " if said["verdict"] == "ambiguous" else " + ").join(said["effects"])
    return f"{said['verdict']}: {named}" if named else said["verdict"]


def _fall(said: Mapping[str, Any]) -> dict[str, str]:
    ends = {"before": said["base_error"], "after": said["final_error"]}
    return {when: floors(float("nan") if error is None else error) for when, error in ends.items()}


def _difference(of: EffectDifference) -> str:
    groups = {state: [name for name, said in of.has.items() if said == state] for state in _TOLD}
    parts = [words.format(", ".join(groups[state])) for state, words in _TOLD.items() if groups[state]]
    return f"{of.effect}: {'; '.join(parts)}"


def shown_unit(key: str, unit: str) -> str:
    """Return the unit in which a number is read: the rig's, the parameter's own, or the usual one."""
    if key in CALLED:
        return CALLED[key][1]
    owner, _, name = key.rpartition(".")
    effect = catalogue().get(owner.partition("[")[0])
    if effect is not None and name.partition("[")[0] in effect.parameter_names:
        return effect.parameter(name).shown_in or unit
    return usual_unit(unit)
