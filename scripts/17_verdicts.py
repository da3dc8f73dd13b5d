"""Diagnose the campaigns of the families, score every verdict, and keep the evidence on which it rests.

    python scripts/16_families.py --out out/families --count 3
    python scripts/17_verdicts.py --out out/families
    python scripts/17_verdicts.py --out out/families --only dirty gains
    python scripts/17_verdicts.py --out out/families --without pads
    python scripts/17_verdicts.py --quick

Every verdict is one line of OUT/verdicts.jsonl, and the same command goes on where it stopped; `--anew` begins again.
Printed are, by family and for all together: right, something absent named, material effects missed, and the median of
the seconds. `--without` takes gauges of the pads from the records first (single sliders stay out: nothing of them would
be left): a law is then not missed where it is a rival, or is said to be what the campaign cannot tell.
`slipwise_benchmarks.family_score` says what is right. `scripts/calibrate.py` takes the evidence.
"""

import argparse
import json
import time
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path
from statistics import median
from typing import Any

from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.verdict import evidence_of, evidence_of_rest, list_shares_of_limit
from slipwise.errors import SlipwiseError
from slipwise.evidence.calibration import compute_log_odds, load_calibration
from slipwise_benchmarks.evidence import decide_by_product
from slipwise_benchmarks.families import FAMILIES
from slipwise_benchmarks.family_score import accused, missed, right
from slipwise_benchmarks.family_store import make, orders
from slipwise_benchmarks.without_gauges import answer_without, write_without

#: What `--quick` diagnoses: single sliders take seconds.
QUICKEST = ("springs_and_walls",)
#: Families of one slider on an actuator.
ONE_SLIDER = ("sliders", "tribometers", "springs_and_walls", "pendulums_constant_load", "pendulums_varying_load")


def verdict_of(folder: Path) -> dict[str, Any]:
    """Give what is said of a campaign and why; "failed" where a user would see an error."""
    began = time.perf_counter()
    try:
        found = diagnose(folder)
    except SlipwiseError as error:
        return {"verdict": "failed", "words": str(error), "seconds": time.perf_counter() - began}
    said, state = found.verdict, found.search
    surface = said.surface
    rest = evidence_of_rest(state.path[0], state.final, surface, state.unexplained, list_shares_of_limit(state))
    row = {
        "verdict": said.kind,
        "effects": list(said.effects),
        "minor": list(said.minor),
        "leftover": said.leftover,
        "probability": round(said.probability, 3),
        "base_error": float(f"{found.base_error:.4g}"),
        "final_error": float(f"{found.final_error:.4g}"),
        "evidence": {f.name: rounded(evidence_of(f)) for f in said.findings},
        "rivals": sorted({name for rival in said.rivals for name in rival.names}),
        "cannot_tell": [words.split(":")[0] for words in found.cannot_tell],
        "at_limit": [f.name for f in said.findings if f.at_limit or f.is_trifle],
        "posterior": {n: rounded(vars(of)) for n, of in state.inclusions.items() if of.present > 0.02},
        "rest": rounded(rest),
        "unexplained": rounded(state.unexplained),
        "rest_of_base": rounded(evidence_of_rest(state.path[0], state.path[0], None)),
        "held_out": bool(state.base.objective.held_out),
        "errors": [float(f"{e:.4g}") for e in (found.base_error, found.final_error)],
        "seconds": round(time.perf_counter() - began, 1),
    }
    product = decide_by_product(row, load_calibration()).probability
    return {**row, "product": round(compute_log_odds(product), 3)}


def rounded(numbers: Mapping[str, float]) -> dict[str, float]:
    """Give numbers with four figures."""
    return {name: float(f"{value:.4g}") for name, value in numbers.items()}


def table(rows: list[dict[str, Any]]) -> list[str]:
    """Give lines: family, right, with something absent, with something missed, seconds."""
    groups: dict[str, list[dict[str, Any]]] = defaultdict(list)
    for row in rows:
        groups[row["family"]].append(row)
        groups["all"].append(row)
    return [
        f"{family:26s} {sum(r['right'] for r in here):3d} of {len(here):3d} right, "
        f"{sum(bool(r['accused']) for r in here):3d} name something absent, {sum(bool(r['missed']) for r in here):3d} "
        f"miss something, median {median(r['seconds'] for r in here):.0f} s"
        for family, here in sorted(groups.items())
    ]


def main() -> None:
    """Diagnose what is missing, and score all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/families"))
    parser.add_argument("--only", nargs="*", default=[""], help="campaigns whose names begin so")
    parser.add_argument("--without", choices=("pads", "forces"), help="gauges that the records lose first")
    parser.add_argument("--anew", action="store_true", help="diagnose again what was diagnosed")
    parser.add_argument("--quick", action="store_true", help="make and diagnose one campaign")
    chosen = parser.parse_args()

    if chosen.quick:
        for order in orders(chosen.out, [FAMILIES[name] for name in QUICKEST], ["ode"], 1):
            make(order)
    answers = {f.stem: json.loads(f.read_text(encoding="utf-8")) for f in sorted(chosen.out.glob("answers/*.json"))}
    if not answers:
        parser.error(f"{chosen.out} holds no answer keys; make campaigns there with scripts/16_families.py --out")
    path = chosen.out / (f"verdicts_without_{chosen.without}.jsonl" if chosen.without else "verdicts.jsonl")
    if chosen.anew:
        path.unlink(missing_ok=True)
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    rows = {row["name"]: row for row in map(json.loads, lines)}
    with path.open("a", encoding="utf-8") as stream:  # two of these may write side by side
        for name, answer in answers.items():
            if name in rows or not name.startswith(tuple(chosen.only)):
                continue
            if chosen.without and answer["family"] in ONE_SLIDER:
                continue
            folder = chosen.out / "campaigns" / name
            if chosen.without:
                lean = chosen.out / f"campaigns_without_{chosen.without}" / name
                write_without(folder, lean, chosen.without)
                folder, answer = lean, answer_without(answer, chosen.without)
            said = verdict_of(folder)
            wrong = {"accused": sorted(accused(answer, said)), "missed": sorted(missed(answer, said))}
            row = {"name": name, "family": answer["family"], "right": right(answer, said)}
            if chosen.without and not wrong["accused"] and said["verdict"] != "failed":
                # what a campaign cannot tell, and says so, is not missed
                wrong["missed"] = sorted({*wrong["missed"]} - {*said["cannot_tell"], *said["rivals"]})
                row["right"] = not wrong["missed"]
            rows[name] = {**row, **said, **wrong, "missing": answer["missing"]}
            print(json.dumps(rows[name]), file=stream, flush=True)
            print(f"{name}: {'right' if row['right'] else f'wrong {wrong}'}", flush=True)
    print("\n".join(table(list(rows.values()))))


if __name__ == "__main__":
    main()
