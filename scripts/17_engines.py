"""Hold the posterior against the search: both diagnose the same campaigns of the families, and are scored alike.

    python scripts/16_families.py --out out/families --count 3
    python scripts/17_engines.py --out out/families
    python scripts/17_engines.py --out out/families --engines posterior --only dirty gains
    python scripts/17_engines.py --quick

Every verdict is one line of OUT/verdicts.jsonl, and the same command goes on where it stopped; a line goes once a file
that the engine imports has changed and `--anew` is given. Printed are, by family and for all together: right, something
absent named, material effects missed, and the median of the seconds. `tests/bench/family_score.py` says what is right.
"""

import argparse
import json
import sys
import time
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.selection import SelectionResult, select_effects
from slipwise.errors import SlipwiseError
from slipwise.selection.select import select_by_posterior

TESTS = Path(__file__).parents[1] / "tests"
ENGINES: dict[str, Callable[..., SelectionResult]] = {"search": select_effects, "posterior": select_by_posterior}
#: What `--quick` diagnoses: single sliders take seconds.
QUICKEST = ("springs_and_walls",)


def verdict_of(folder: Path, engine: str) -> dict[str, Any]:
    """Give what an engine says of a campaign; "failed" where it raises what a user would see as an error."""
    began = time.perf_counter()
    try:
        found = diagnose(folder, select=ENGINES[engine])
    except SlipwiseError as error:
        return {"verdict": "failed", "words": str(error), "seconds": time.perf_counter() - began}
    said = found.verdict
    return {
        "verdict": said.kind,
        "effects": list(said.effects),
        "minor": list(said.minor),
        "leftover": said.leftover,
        "probability": round(said.probability, 3),
        "base_error": float(f"{found.base_error:.4g}"),
        "final_error": float(f"{found.final_error:.4g}"),
        "findings": {
            f.name: {"lead": round(f.lead, 2), "share": round(f.share, 3), "limits": round(f.material, 2)}
            for f in said.findings
        },
        "seconds": round(time.perf_counter() - began, 1),
    }


def table(rows: list[dict[str, Any]]) -> list[str]:
    """Give lines: engine and family, right, with something absent, with something missed, seconds."""
    groups: dict[tuple[str, str], list[dict[str, Any]]] = defaultdict(list)
    for row in rows:
        groups[row["engine"], row["family"]].append(row)
        groups[row["engine"], "all"].append(row)
    return [
        f"{engine:10s} {family:26s} {sum(r['right'] for r in here):3d} of {len(here):3d} right, "
        f"{sum(bool(r['accused']) for r in here):3d} name something absent, {sum(bool(r['missed']) for r in here):3d} "
        f"miss something, median {median(r['seconds'] for r in here):.0f} s"
        for (engine, family), here in sorted(groups.items())
    ]


def main() -> None:
    """Diagnose what is missing, and score all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/families"))
    parser.add_argument("--engines", nargs="*", choices=list(ENGINES), default=list(ENGINES))
    parser.add_argument("--only", nargs="*", default=[""], help="campaigns whose names begin so")
    parser.add_argument("--anew", action="store_true", help="diagnose again what was diagnosed")
    parser.add_argument("--quick", action="store_true", help="make and diagnose one campaign")
    chosen = parser.parse_args()
    sys.path.insert(0, str(TESTS))
    from bench.families import FAMILIES  # pyright: ignore[reportMissingImports]
    from bench.family_score import accused, missed, right  # pyright: ignore[reportMissingImports]
    from bench.family_store import make, orders  # pyright: ignore[reportMissingImports]

    if chosen.quick:
        for order in orders(chosen.out, [FAMILIES[name] for name in QUICKEST], ["ode"], 1):
            make(order)
    answers = {f.stem: json.loads(f.read_text(encoding="utf-8")) for f in sorted(chosen.out.glob("answers/*.json"))}
    if not answers:
        parser.error(f"{chosen.out} holds no answer keys; make campaigns there with scripts/16_families.py --out")
    path = chosen.out / "verdicts.jsonl"
    if chosen.anew:
        path.unlink(missing_ok=True)
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    rows = {(row["name"], row["engine"]): row for row in map(json.loads, lines)}
    with path.open("a", encoding="utf-8") as stream:  # two engines may write side by side
        for name, answer in answers.items():
            for engine in chosen.engines:
                if (name, engine) in rows or not name.startswith(tuple(chosen.only)):
                    continue
                said = verdict_of(chosen.out / "campaigns" / name, engine)
                wrong = {"accused": sorted(accused(answer, said)), "missed": sorted(missed(answer, said))}
                row = {"name": name, "engine": engine, "family": answer["family"], "right": right(answer, said)}
                rows[name, engine] = {**row, **said, **wrong, "missing": answer["missing"]}
                print(json.dumps(rows[name, engine]), file=stream, flush=True)
                print(f"{name} {engine}: {'right' if row['right'] else f'wrong {wrong}'}", flush=True)
    print("\n".join(table(list(rows.values()))))


if __name__ == "__main__":
    main()
