"""How right verdicts on dirty campaigns are: all that matters named, nothing absent accused, first things, importance.

A name that is there but does not matter is wrong among the effects only where its largest true change is below half of
what is material: between half and the limit an honest estimate may fall on either side. What matters but is absorbed by
the base parameters may be named and need not be.
"""

from collections import defaultdict
from collections.abc import Sequence
from math import log
from typing import Any

from slipwise_benchmarks.score import BASE, SAME, calibration

Truth = dict[str, Any]
Said = dict[str, Any]
#: Share of what is material from which an effect that does not matter may be named [1].
NEAR = 0.5
#: Names of the catalogue that tell one of the first things in other words.
ALSO = {
    "dead": {"channel_gain", "channel_clipping"},
    "late": {"channel_delay"},
    "reversed": {"channel_sign"},
    "tared": {"channel_offset"},
    "gravity": {"channel_offset"},
    "wrong_rig": set(),
}
FIGURES = ("peak_slip", "energy", "largest_load")
_VERDICTS = ("complete", "named", "ambiguous", "unknown", "instrument")
#: A probability is never surer than this for the log loss [1].
_SUREST = 0.999


def named(said: Said) -> set[str]:
    """Give what a verdict says is missing and matters; "unknown" where it says so, or of what is left over."""
    names = set(said.get("effects") or []) - BASE
    unknown = said.get("verdict") == "unknown" or said.get("leftover") == "unknown"
    return names | {"unknown"} if unknown else names


def may_be_named(truth: Truth) -> set[str]:
    """Give every name that is no accusation: what matters, what nearly does, what tells a first thing."""
    near = {name for name, entry in truth["effects"].items() if entry["of_limit"] >= NEAR}
    return near.union(*(ALSO[one["kind"]] for one in truth["first"]))


def readings(said: Said) -> list[set[str]]:
    """Give the sets of names that a verdict stands for: an ambiguous one of a pair of `SAME` for either member."""
    names = named(said)
    if said.get("verdict") != "ambiguous":
        return [names]
    return [names - (pair - {meant}) for pair in SAME if pair <= names for meant in sorted(pair)]


def right(truth: Truth, said: Said) -> bool:
    """Tell whether everything that matters and can be seen is named, and nothing else.

    A law whose family is right and whose form is not is right too: "unknown" may be left over beside it.
    """
    if said.get("verdict") not in _VERDICTS:
        return False
    needed, allowed = set(truth["missing"]), may_be_named(truth)
    if said["verdict"] == "named" and said.get("leftover") == "unknown":
        allowed |= {"unknown"}
    return any(needed <= names <= allowed for names in readings(said))


def absent_named(truth: Truth, said: Said) -> set[str]:
    """Give names, among effects and minor ones, of what is not there at all."""
    there = set(truth["effects"]) | may_be_named(truth)
    if said.get("verdict") == "named":  # a form that is not exact accuses nothing
        there |= {"unknown"}
    minor = set(said.get("minor") or []) - BASE
    return min((names | minor for names in readings(said) or [named(said)]), key=lambda n: len(n - there)) - there


def nothing_matters(truth: Truth) -> bool:
    """Tell whether "complete" is the only right verdict: nothing material hides, not even in base parameters."""
    return not truth["missing"] and not truth["hidden_in_base"]


def complete_right(truth: Truth, said: Said) -> bool:
    """Tell whether a campaign in which nothing matters is called complete."""
    return said.get("verdict") == "complete" and not named(said)


def first_right(truth: Truth, said: Said) -> bool:
    """Tell whether exactly the first things that are there were found, with their channels."""
    return _by_kind(truth["first"]) == _by_kind(said.get("first") or [])


def _by_kind(entries: Sequence[dict[str, Any]]) -> dict[str, set[str]]:
    found: dict[str, set[str]] = defaultdict(set)
    for entry in entries:
        found[entry["kind"]] |= set(entry.get("channels") or [])
    return dict(found)


def importances(results: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Hold every importance that a verdict gives against the true one.

    Returns:
        one row per effect that is there and figure of the held-out run: campaign, effect, figure, true, value, low,
        high, inside; all (without - with) / with.
    """
    rows = []
    for result in results:
        for effect, given in (result["said"].get("importance") or {}).items():
            entry = result["truth"]["effects"].get(effect)
            for figure in FIGURES if entry else ():
                value, low, high = given[figure]
                true = entry["importance"][figure]
                row = {"campaign": result["name"], "effect": effect, "figure": figure, "true": true, "value": value}
                rows.append({**row, "low": low, "high": high, "inside": bool(low <= true <= high)})
    return rows


def log_loss(results: Sequence[dict[str, Any]]) -> float:
    """Give the mean of -ln of the probability that a verdict gave to what came out."""
    losses = []
    for result in results:
        said = min(max(result["said"].get("probability", 0.0), 1.0 - _SUREST), _SUREST)
        losses.append(-log(said if right(result["truth"], result["said"]) else 1.0 - said))
    return sum(losses) / len(losses)


def rates(results: Sequence[dict[str, Any]]) -> dict[str, list[int]]:
    """Give the counts that the targets speak of, each [how many, of how many]; results hold name, truth and said."""
    flags: dict[str, list[bool]] = defaultdict(list)
    for result in results:
        truth, said = result["truth"], result["said"]
        good = right(truth, said)
        flags["right"].append(good)
        flags[f"right: {truth['group']}"].append(good)
        flags["something absent named"].append(bool(absent_named(truth, said)))
        if nothing_matters(truth):
            flags["nothing material: called complete"].append(complete_right(truth, said))
        if truth["first"]:
            flags["first things: found"].append(first_right(truth, said))
            flags["first things: found, and the rest right"].append(first_right(truth, said) and good)
        else:
            flags["no first thing: none said"].append(first_right(truth, said))
    inside = [row["inside"] for row in importances(results)]
    return {name: [sum(values), len(values)] for name, values in flags.items()} | {
        "importance inside its interval": [sum(inside), len(inside)]
    }


def calibrated(results: Sequence[dict[str, Any]]) -> list[dict[str, float]]:
    """Give for every tenth of probability the mean probability, the share right, and the count."""
    return calibration(results, judge=right)


def wrong(results: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """Give what was said wrongly: campaign, what lacked, what was named that is absent or does not matter."""
    rows = []
    for result in results:
        truth, said = result["truth"], result["said"]
        if not right(truth, said):
            names, needed = named(said), set(truth["missing"])
            row = {"campaign": result["name"], "verdict": said.get("verdict"), "said": sorted(names)}
            accused = sorted(names - may_be_named(truth))
            rows.append({**row, "needed": sorted(needed), "lacking": sorted(needed - names), "accused": accused})
    return rows
