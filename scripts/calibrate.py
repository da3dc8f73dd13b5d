"""Fit the probabilities of a diagnosis to answers of the benches, and write `evidence/calibration.json`.

    python scripts/07_bench.py --dirty --count 200 --seed 81000 --out out/dirty
    python scripts/07_bench.py --count 200 --seed 81000 --out out/clean
    python scripts/calibrate.py out/dirty/results.jsonl out/clean/results.jsonl
    python scripts/calibrate.py out/dirty/results.jsonl --check    # writes nothing

Each model is a logistic regression in a few numbers (scikit-learn, ridge 1 on numbers of unit spread): whether an
effect that was found is there, whether it matters, whether effects are of the right family whatever they leave,
whether a hypothesis or its nearest rival is right, and whether all of a verdict is right, by the product of these. That
last one is fitted to verdicts that models of other campaigns have made (in five parts), or it would be told how well
the others remember.

Clean campaigns tell what is there, but not whether it matters to anybody: their answer key has no limits.

Probabilities that are published are checked on other seeds than those given here.
"""

import argparse
import json
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from sklearn.linear_model import LogisticRegression

from slipwise.campaign.materiality import Materiality
from slipwise.evidence.calibration import Calibration, Logistic, compute_log_odds
from slipwise.evidence.decision import decide, is_left

TESTS = Path(__file__).parents[1] / "tests"
OUT = Path(__file__).parents[1] / "src" / "slipwise" / "evidence" / "calibration.json"
PRESENT = ("lead", "worth", "share", "rival", "gauge", "stays")
MATTERS = ("size",)
FAMILY = ("explained", "left", "relative")
PARTS = 5
#: Fewer cases leave a model as it was.
LEAST = 10
Case = tuple[dict[str, float], bool]
Result = dict[str, Any]


def cases_of_presence(result: Result) -> list[Case]:
    """Give every effect that was found, and whether it is there."""
    from bench.score_dirty import may_be_named  # pyright: ignore[reportMissingImports]

    truth = result["truth"]
    there = set(truth["effects"]) | may_be_named(truth) if _is_dirty(result) else _clean_names(truth)
    return [(of, name in there) for name, of in _effects(result).items()]


def cases_of_matter(result: Result) -> list[Case]:
    """Give every effect that was found and is there, and whether it matters; not those near the limit, see NEAR."""
    from bench.score_dirty import NEAR  # pyright: ignore[reportMissingImports]

    if not _is_dirty(result):
        return []
    sizes = {name: entry["of_limit"] for name, entry in result["truth"]["effects"].items()}
    found = {name: of for name, of in _effects(result).items() if name in sizes}
    return [(of, sizes[name] >= 1.0) for name, of in found.items() if not NEAR <= sizes[name] < 1.0]


def cases_of_family(result: Result) -> list[Case]:
    """Give what is left where that matters, and whether nothing is hidden that the catalogue does not have."""
    rest = result["said"]["evidence"]["rest"]
    if not is_left(rest, Materiality().channel):
        return []
    return [(rest, "unknown" not in result["truth"]["missing"])]


def cases_of_rivals(result: Result) -> list[Case]:
    """Give by how much an effect leads its nearest rival, and whether it is the one that is there."""
    if not _is_dirty(result):  # there rivals are so far behind that they tell nothing of ties
        return []
    truth, out = result["truth"]["effects"], []
    for name, of in _effects(result).items():
        instead = of["instead"]
        if len(instead) == 1 and (name in truth) != (instead[0] in truth):
            out.append(({"lead": of["rival"]}, name in truth))
    return out


def _is_dirty(result: Result) -> bool:
    return "effects" in result["truth"]


def _clean_names(truth: dict[str, Any]) -> set[str]:
    """Give every name that is right in a clean campaign: what is missing, and what is one thing with it."""
    from bench.score import SAME  # pyright: ignore[reportMissingImports]

    missing = set(truth["missing"])
    return missing.union(*(pair for pair in SAME if pair & missing)) | _moved_by_gaps(missing)


def _moved_by_gaps(missing: set[str]) -> set[str]:
    """Give what lost samples look like where they moved up the rest."""
    return {"channel_delay"} if "dropped_samples" in missing else set()


def _right_of_clean(truth: dict[str, Any], kind: str, names: set[str]) -> bool:
    """Tell whether a verdict without its last step, which joins what is one thing, is right on a clean campaign."""
    from bench.score import SAME, SMALLEST  # pyright: ignore[reportMissingImports]

    missing = set(truth["missing"])
    if not missing or missing == {"unknown"}:
        return kind == ("unknown" if missing else "complete")
    if kind == "complete":
        return truth["size_after_fit"] < SMALLEST
    seen = {name for name in missing if truth.get("alone", {}).get(name, SMALLEST) >= SMALLEST}
    found = all(name in names or any(name in pair and pair & names for pair in SAME) for name in seen)
    return kind != "unknown" and found and names <= _clean_names(truth)


def _effects(result: Result) -> dict[str, dict[str, Any]]:
    return result["said"]["evidence"]["effects"]


def fitted(cases: Sequence[Case], names: Sequence[str], before: Logistic) -> Logistic:
    """Fit a logistic model; the one of before where the cases are all of one kind or too few."""
    answers = np.array([right for _, right in cases])
    if len(cases) < LEAST or answers.all() or not answers.any():
        print(f"  {len(cases)} cases of one kind or too few: kept as it was")
        return before
    numbers = np.array([[of[name] for name in names] for of, _ in cases])
    middle, spread = numbers.mean(axis=0), np.maximum(numbers.std(axis=0), 1e-9)
    found = LogisticRegression(C=1.0).fit((numbers - middle) / spread, answers)
    weights = found.coef_[0] / spread
    constant = float(found.intercept_[0] - weights @ middle)
    kept = {name: round(float(weight), 3) for name, weight in zip(names, weights, strict=True)}
    print(f"  {len(cases)} cases, {int(answers.sum())} right: {kept}")
    return Logistic(round(constant, 3), kept)


def parts_fitted(results: Sequence[Result], before: Calibration) -> Calibration:
    """Fit the models of the parts of a verdict; the one of the whole stays."""

    def over(cases: Callable[[Result], list[Case]]) -> list[Case]:
        return [case for result in results for case in cases(result)]

    return Calibration(
        fitted(over(cases_of_presence), PRESENT, before.present),
        fitted(over(cases_of_matter), MATTERS, before.matters),
        fitted(over(cases_of_family), FAMILY, before.right_family),
        fitted(over(cases_of_rivals), ("lead",), before.leads_rival),
        Logistic(0.0, {"product": 1.0}),
    )


def verdict_cases(results: Sequence[Result], chances: Calibration) -> list[Case]:
    """Give what a calibration would say of campaigns, as log-odds of the product, and whether that is right."""
    from bench.score_dirty import right  # pyright: ignore[reportMissingImports]

    out = []
    for result in results:
        truth, evidence = result["truth"], result["said"]["evidence"]
        decided = decide(evidence["effects"], evidence["rest"], Materiality().channel, chances)
        faults = [name for name in result["said"]["effects"] if name not in evidence["effects"]]
        said = {**result["said"], "verdict": decided.kind, "effects": [*decided.named, *faults], "leftover": ""}
        if decided.kind == "named" and is_left(evidence["rest"], Materiality().channel):
            said["leftover"] = "unknown"
        if decided.kind != "unknown":
            names = set(said["effects"])
            good = (
                right(truth, said)
                if _is_dirty(result)
                else _right_of_clean(truth, "instrument" if faults else decided.kind, names)
            )
            out.append(({"product": compute_log_odds(decided.probability)}, good))
    return out


def _seeds(path: Path) -> str:
    """Give the names of a bench's first and last campaign."""
    names = sorted(json.loads(line)["name"] for line in path.read_text(encoding="utf-8").splitlines())
    return f"{names[0]} to {names[-1]}"


def main() -> None:
    """Read results, fit, write."""
    sys.path.insert(0, str(TESTS))
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path, nargs="+", help="results.jsonl of benches")
    parser.add_argument("--check", action="store_true", help="write nothing")
    chosen = parser.parse_args()
    lines = [line for path in chosen.results for line in path.read_text(encoding="utf-8").splitlines()]
    results = [r for r in map(json.loads, lines) if "evidence" in r["said"]]
    content = json.loads(OUT.read_text(encoding="utf-8"))
    before = Calibration(**{n: Logistic(of["constant"], of["weights"]) for n, of in content["models"].items()})
    whole: list[Case] = []
    for part in range(PARTS):
        others = [r for i, r in enumerate(results) if i % PARTS != part]
        whole += verdict_cases(results[part::PARTS], parts_fitted(others, before))
    chances = parts_fitted(results, before)
    chances = replace(chances, all_right=fitted(whole, ("product",), before.all_right))
    kept = [name for name, model in vars(chances).items() if model is getattr(before, name)]
    content["provenance"] = (
        f"{len(results)} campaigns of the benches, {', '.join(sorted({_seeds(path) for path in chosen.results}))}, "
        f"{datetime.now(UTC):%Y-%m-%d}; scripts/calibrate.py; "
        f"too few cases, chosen by judgement: {', '.join(kept) or 'none'}"
    )
    content["models"] = {n: {"constant": m.constant, "weights": m.weights} for n, m in vars(chances).items()}
    print(json.dumps(content, indent=1))
    if not chosen.check:
        OUT.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
