"""How right the verdicts on hidden-effect campaigns are: exact names, confusion, calibration."""

from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from typing import Any

#: Never a missing effect by itself.
BASE = {"pad_compliance"}
#: One thing to a rig without the gauges that would part them.
SAME = (
    {"buffer_damping", "guide_drag"},
    {"direction_asymmetry", "channel_offset"},
    {"channel_delay", "channel_filter"},
    {"pad_spread", "channel_gain"},
)
INSTRUMENT = {
    "channel_delay", "channel_gain", "channel_sign", "channel_offset", "channel_drift", "channel_filter",
    "channel_clipping", "dropped_samples", "clock_skew", "load_crosstalk", "cell_inertia",
}  # fmt: skip
#: Below this size in floors, after what the base parameters absorb, "complete" counts as right; a member of a pair that
#: alone is below it need not be named.
SMALLEST = 1.2
#: Error left by a right name that counts as down to the floor [floors].
DOWN = 1.15


def right(truth: dict[str, Any], said: dict[str, Any]) -> bool:
    """Tell whether the verdict and every name are exactly right."""
    missing, names = list(truth["missing"]), set(said.get("effects", [])) - BASE
    verdict = said.get("verdict")
    if verdict == "complete" and not names:
        return not missing or truth["size_after_fit"] < SMALLEST
    if missing == ["unknown"]:
        return verdict == "unknown"
    if verdict == "ambiguous" and any(_but_for(pair, names, set(missing)) for pair in SAME):
        return True
    if verdict == "instrument" and not set(missing) & INSTRUMENT:
        return False
    seen = {name for name in missing if truth.get("alone", {}).get(name, SMALLEST) >= SMALLEST}
    return verdict in ("named", "instrument") and bool(names) and seen <= names <= set(missing)


def _but_for(pair: set[str], names: set[str], missing: set[str]) -> bool:
    """Tell whether two lists of names differ by no more than which of a pair that cannot be parted is meant."""
    return bool(names & pair) and bool(missing & pair) and names - pair == missing - pair


def kind(truth: dict[str, Any]) -> str:
    """Sort a campaign: complete, single, pair, unknown, or instrument."""
    missing = truth["missing"]
    if not missing:
        return "complete"
    if missing == ["unknown"]:
        return "unknown"
    if len(missing) > 1:
        return "pair"
    return "instrument" if missing[0] in INSTRUMENT else "single"


def rates(results: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Give the shares that the targets speak of; each result holds name, truth and said."""
    groups: dict[str, list[bool]] = defaultdict(list)
    accused = called = physics = 0
    left: list[bool] = []
    totals: Counter[str] = Counter()
    for result in results:
        truth, said = result["truth"], result["said"]
        group, good = kind(truth), right(truth, said)
        groups[group].append(good)
        totals[group] += 1
        if group not in ("complete", "unknown"):
            large = truth["size_after_fit"] >= 3.0
            groups["3 floors or more" if large else "below 3 floors"].append(good)
            if group in ("single", "instrument") and large:
                groups["singles of 3 floors or more"].append(good)
        if good and said["verdict"] in ("named", "instrument"):
            left.append(said["final_error"] <= DOWN)
        accused += group == "complete" and said.get("verdict") != "complete"
        called += group == "unknown" and said.get("verdict") in ("named", "instrument")
        physics += group == "instrument" and said.get("verdict") == "named" and not set(said["effects"]) & INSTRUMENT
    return {
        "exactly right": {name: [sum(values), len(values)] for name, values in sorted(groups.items())},
        "complete models accused": [accused, totals["complete"]],
        "outside the catalogue, called by a catalogue name": [called, totals["unknown"]],
        "instruments taken for physics": [physics, totals["instrument"]],
        f"rightly named, final error at most {DOWN} floors": [sum(left), len(left)],
    }


def confusion(results: Sequence[dict[str, Any]]) -> dict[str, Counter[str]]:
    """Give for every hidden thing what was said of it, and how often."""
    table: dict[str, Counter[str]] = defaultdict(Counter)
    for result in results:
        said = result["said"]
        words = " + ".join(said.get("effects") or []) or str(said.get("verdict"))
        if said.get("verdict") == "ambiguous":
            words = f"ambiguous: {words}"
        table[" + ".join(result["truth"]["missing"]) or "complete"][words] += 1
    return dict(sorted(table.items()))


def calibration(
    results: Sequence[dict[str, Any]], bins: int = 10, judge: Callable[[dict[str, Any], dict[str, Any]], bool] = right
) -> list[dict[str, float]]:
    """Give for every tenth of probability the mean probability, the share right, and the count.

    Args:
        results: each holds truth and said.
        bins: that probability is cut into.
        judge: tells from truth and said whether a verdict is right.
    """
    rows = []
    for i in range(bins):
        low, high = i / bins, (i + 1) / bins
        here = [
            r
            for r in results
            if low <= r["said"].get("probability", 0.0) < high
            or (i == bins - 1 and r["said"].get("probability") == 1.0)
        ]
        if here:
            rows.append(
                {
                    "low": low,
                    "high": high,
                    "said": sum(r["said"]["probability"] for r in here) / len(here),
                    "right": sum(judge(r["truth"], r["said"]) for r in here) / len(here),
                    "count": len(here),
                }
            )
    return rows
