"""Diagnose campaigns of the families as they are and written down in other ways: a verdict must stay the same.

    python scripts/16_families.py --out out/families --count 3
    python scripts/18_rewritten.py --out out/families --to out/rewritten --count 12
    python scripts/18_rewritten.py --out out/families --to out/rewritten --only clean sliders pendulums --count 1
    python scripts/18_rewritten.py --quick

`slipwise_benchmarks.rewritten` lists the ways. Of each family `--count` campaigns are taken. Every verdict is one line
of TO/rewritten.jsonl, and the same command goes on where it stopped. Printed are, for each way: of how many campaigns
kind and names stay, the largest change of the probability where they do, and every campaign of which they do not. A
zero of the slip that was put off may be named.
"""

import argparse
import json
import time
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from slipwise.campaign import Campaign, load_campaign
from slipwise.diagnosis.diagnose import diagnose
from slipwise.errors import SlipwiseError
from slipwise_benchmarks.families import FAMILIES
from slipwise_benchmarks.family_store import make, orders
from slipwise_benchmarks.rewritten import REWRITINGS

#: What stands for the campaign as it is.
ORIGINAL = "as it is"
#: What `--quick` diagnoses: single sliders take seconds.
QUICKEST = "tribometers"


def verdict_of(campaign: Campaign) -> dict[str, Any]:
    """Give what is said of a campaign; "failed" where a user would see an error."""
    began = time.perf_counter()
    try:
        found = diagnose(campaign)
    except SlipwiseError as error:
        return {"verdict": "failed", "effects": [], "probability": 0.0, "words": str(error)}
    said, errors = found.verdict, (found.base_error, found.final_error)
    return {
        "verdict": said.kind,
        "effects": sorted(said.effects),
        "minor": sorted(said.minor),
        "probability": round(said.probability, 4),
        "errors": [float(f"{error:.4g}") for error in errors],
        "seconds": round(time.perf_counter() - began, 1),
    }


def words(row: dict[str, Any]) -> str:
    """Give a verdict in a line."""
    return " ".join([row["verdict"], *row["effects"], f"{row['probability']:.3f}"])


def table(rows: list[dict[str, Any]], ways: Mapping[str, Any]) -> list[str]:
    """Give lines: way of writing, how many say the same, largest change of probability; then those that differ.

    Args:
        rows: verdicts.
        ways: way -> `rewritten.Rewriting`.
    """
    original = {row["name"]: row for row in rows if row["way"] == ORIGINAL}
    groups: dict[str, list[dict[str, Any]]] = defaultdict(list)
    for row in rows:
        if row["way"] != ORIGINAL and row["name"] in original:
            groups[row["way"]].append(row)
    lines, differ = [], []
    for way, here in groups.items():
        changes = []
        for row in here:
            was = original[row["name"]]
            if ways[way].is_same(row["verdict"], row["effects"], was["verdict"], was["effects"]):
                changes.append(abs(row["probability"] - was["probability"]))
            else:
                differ.append(f"{row['name']}, {way}: {words(row)}; as it is: {words(was)}")
        largest = f"{max(changes):.3f}" if changes else "-"
        lines.append(f"{way:32s} {len(changes):3d} of {len(here):3d} the same, probability within {largest}")
    return lines + differ


def main() -> None:
    """Diagnose what is missing, and compare all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/families"), help="where the campaigns are")
    parser.add_argument("--to", type=Path, help="folder of rewritten.jsonl; that of the campaigns when not given")
    parser.add_argument("--only", nargs="*", default=[""], help="campaigns whose names begin so")
    parser.add_argument("--ways", nargs="*", default=[""], help="ways of writing whose names begin so")
    parser.add_argument("--count", type=int, default=12, help="campaigns of each family")
    parser.add_argument("--quick", action="store_true", help="make one campaign, written in one other way")
    chosen = parser.parse_args()

    if chosen.quick:
        chosen.ways = [REWRITINGS[0].name]
        for order in orders(chosen.out, [FAMILIES[QUICKEST]], ["ode"], 1):
            make(order)
    names = [p.parent.name for p in sorted(chosen.out.glob("campaigns/*/campaign.toml"))]
    taken: dict[str, list[str]] = defaultdict(list)
    for name in names:
        family = taken[name.split("-")[0]]
        if name.startswith(tuple(chosen.only)) and len(family) < chosen.count:
            family.append(name)
    if not any(taken.values()):
        parser.error(f"{chosen.out} holds no such campaigns; make them there with scripts/16_families.py --out")
    path = (chosen.to or chosen.out) / "rewritten.jsonl"
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    rows = {(row["name"], row["way"]): row for row in map(json.loads, lines)}
    with path.open("a", encoding="utf-8") as stream:
        for name in (name for family in taken.values() for name in family):
            campaign = load_campaign(chosen.out / "campaigns" / name)
            ways = {r.name: r.of for r in REWRITINGS if r.applies(campaign) and r.name.startswith(tuple(chosen.ways))}
            for way, rewrite in {ORIGINAL: lambda as_it_is: as_it_is, **ways}.items():
                if (name, way) in rows:
                    continue
                row = rows[name, way] = {"name": name, "way": way, **verdict_of(rewrite(campaign))}
                print(json.dumps(row), file=stream, flush=True)
                print(f"{name}, {way}: {words(row)}", flush=True)
    print("\n".join(table(list(rows.values()), {r.name: r for r in REWRITINGS})))


if __name__ == "__main__":
    main()
