"""Fit the probabilities of a diagnosis to answers of the families, and write `evidence/calibration.json`.

    python scripts/16_families.py --out out/families --count 12
    python scripts/17_verdicts.py --out out/families
    python scripts/calibrate.py out/families
    python scripts/calibrate.py out/families --check    # writes nothing
    python scripts/calibrate.py --whole benchmarks/results/verdicts.jsonl --lines 334

Each model is a logistic regression in a few numbers (ridge 1 on numbers of unit spread, signs of the weights held to
what more of a number can only mean): whether an effect that was found is there, whether its size is what the
posterior says, whether effects are of the right family whatever they leave, and whether all of a verdict is right, by
the product of these and by the floors that names leave. That last one is fitted to verdicts that models of other
campaigns have made (in five parts, the two makers' campaigns of a seed in one), or it would be told how well the
others remember; `--whole` fits the last two alone to kept verdicts of campaigns that the other models have not seen:
few campaigns leave something that matters. Families that are held out take no part; what the models say of them is
printed apart.

Printed are, of verdicts by models that have not seen them: how many are right, the Brier score, and how often claims of
each fifth come true.
"""

import argparse
import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize
from scipy.special import expit
from sklearn.isotonic import IsotonicRegression

from slipwise.arrays import Array
from slipwise.campaign.materiality import Materiality
from slipwise.evidence.calibration import Calibration, Logistic, compute_log_odds
from slipwise.evidence.decision import EVEN_ODDS, is_left
from slipwise_benchmarks.evidence import PRODUCT, decide_by_product
from slipwise_benchmarks.family_score import may_be_named, right

OUT = Path(__file__).parents[1] / "src" / "slipwise" / "evidence" / "calibration.json"
PRESENT = ("lead", "share", "stays", "gauge", "inclusion", "spread", "seen", "beside", "left")
MATTERS = ("spread", "gauge", "lead", "beside", "left")
FAMILY = ("explained", "left", "relative")
WHOLE = ("product", "floors")
#: Numbers of which more can only make a claim likelier, or less likely: a few campaigns must not say the opposite.
WAYS = {name: (0.0, None) for name in ("lead", "share", "stays", "inclusion", "seen", "explained", "product")}
WAYS |= {name: (None, 0.0) for name in ("spread", "beside", "left", "relative", "floors")}
PARTS, FIFTHS = 5, 5
#: Fewer cases of either kind leave a model as it was.
LEAST = 5
#: An effect so near to what matters is neither right nor wrong to name.
NEAR = 0.7
Case = tuple[dict[str, float], bool]
Row = dict[str, Any]


def read(folder: Path) -> list[Row]:
    """Give verdicts with their answer keys, and the evidence of each effect in one dictionary."""
    lines = (folder / "verdicts.jsonl").read_text(encoding="utf-8").splitlines()
    rows = [row for row in map(json.loads, lines) if "evidence" in row]
    for row in rows:
        row["evidence"] = {name: {**of, "left": row["rest"]["left"]} for name, of in row["evidence"].items()}
        row["answer"] = json.loads((folder / "answers" / f"{row['name']}.json").read_text(encoding="utf-8"))
        row["group"] = row["name"].rsplit("-", 2)[0] + row["name"].rsplit("-", 1)[1]
    return rows


def cases_of_presence(row: Row) -> list[Case]:
    """Give every effect that was found, and whether it is there."""
    there = set(row["answer"]["effects"]) | may_be_named(row["answer"])
    return [(of, name in there) for name, of in row["evidence"].items()]


def cases_of_matter(row: Row) -> list[Case]:
    """Give every effect that matters if its size is what the posterior says, and whether it is there and near that."""
    sizes = {name: entry["of_limit"] for name, entry in row["answer"]["effects"].items()}
    named = may_be_named(row["answer"])
    clear = {name: of for name, of in row["evidence"].items() if not NEAR <= sizes.get(name, 0.0) < 1.0}
    return [(of, name in named) for name, of in clear.items() if of["inclusion"] > 0.0]


def cases_of_family(row: Row) -> list[Case]:
    """Give what is left where that matters, and whether nothing is hidden that the catalogue does not have."""
    if not is_left(row["rest"], Materiality().channel):
        return []
    return [(row["rest"], "unknown" not in row["answer"]["missing"])]


def fitted(cases: Sequence[Case], names: Sequence[str], before: Logistic) -> Logistic:
    """Fit a logistic model; the one of before where there are too few cases of a kind."""
    answers = np.array([right for _, right in cases])
    if min(np.sum(answers), np.sum(~answers)) < LEAST:
        return before
    numbers = np.array([[of[name] for name in names] for of, _ in cases])
    middle, spread = numbers.mean(axis=0), np.maximum(numbers.std(axis=0), 1e-9)
    known, truth = (numbers - middle) / spread, np.where(answers, 1.0, -1.0)

    def loss(x: Array) -> tuple[float, Array]:
        margin = truth * (x[0] + known @ x[1:])
        pull = -truth * expit(-margin)
        slopes = np.r_[pull.sum(), known.T @ pull + x[1:]]
        return float(np.sum(np.logaddexp(0.0, -margin)) + 0.5 * x[1:] @ x[1:]), slopes

    bounds = [(None, None), *(WAYS.get(name, (None, None)) for name in names)]
    found = minimize(loss, np.zeros(len(names) + 1), jac=True, method="L-BFGS-B", bounds=bounds).x
    weights = found[1:] / spread
    constant = float(found[0] - weights @ middle)
    kept = {name: round(float(weight), 3) for name, weight in zip(names, weights, strict=True)}
    return Logistic(round(constant, 3), kept)


def parts_fitted(rows: Sequence[Row], before: Calibration) -> Calibration:
    """Fit the models of the parts of a verdict; the one of the whole stays."""

    def over(cases: Callable[[Row], list[Case]]) -> list[Case]:
        return [case for row in rows for case in cases(row)]

    return Calibration(
        fitted(over(cases_of_presence), PRESENT, before.present),
        fitted(over(cases_of_matter), MATTERS, before.matters),
        fitted(over(cases_of_family), FAMILY, before.right_family),
        before.leads_rival,
        before.all_right,
    )


def said_by(row: Row, parts: Calibration) -> tuple[Case, bool]:
    """Give what the parts of a calibration say of a campaign, whether that is right, and whether it is unknown."""
    decided = decide_by_product(row, parts)
    faults = [name for name in row["effects"] if name not in row["evidence"]]
    left = is_left(row["rest"], Materiality().channel)
    said = {"verdict": decided.kind, "effects": [*decided.named, *faults], "minor": decided.minor}
    said["leftover"] = "unknown" if decided.named and left else ""
    floors = row["rest"]["floors"] if decided.named else 0.0
    product = {"product": compute_log_odds(decided.probability), "floors": floors}
    return (product, right(row["answer"], said)), decided.kind == "unknown"


def by_others(rows: Sequence[Row], before: Calibration) -> list[tuple[Case, bool]]:
    """Give what models fitted to other groups say of every campaign."""
    groups = sorted({row["group"] for row in rows})
    out = []
    for part in range(PARTS):
        own = set(groups[part::PARTS])
        chances = parts_fitted([row for row in rows if row["group"] not in own], before)
        out += [said_by(row, chances) for row in rows if row["group"] in own]
    return out


def venn_abers(chance: Array, good: Array, claim: float) -> tuple[float, float]:
    """Give the two probabilities between which a claim is calibrated, whatever the truth of the next case.

    Isotonic regressions of what came true, with one more case at the claim that did not and that did (Vovk and Petej,
    2014, Venn-Abers predictors).
    """
    claims = np.append(chance, claim)
    low, high = (
        IsotonicRegression(out_of_bounds="clip").fit(claims, np.append(good, truth)).predict([claim])[0]
        for truth in (0.0, 1.0)
    )
    return float(low), float(high)


def report(said: Sequence[tuple[float, bool]], what: str) -> None:
    """Print how many are right, the Brier score, and how often claims of each fifth come true, with intervals."""
    chance, good = np.array([p for p, _ in said]), np.array([g for _, g in said])
    if not len(said):
        return
    print(f"{what}: {good.sum()} of {len(good)} right, Brier {np.mean((chance - good) ** 2):.3f}")
    for fifth in np.array_split(np.argsort(chance), FIFTHS):
        if len(fifth):
            line = f"  said {chance[fifth].mean():.2f}, came true {good[fifth].mean():.2f} of {len(fifth)}"
            if len(good) >= FIFTHS**2:
                low, high = venn_abers(chance, good, chance[fifth].mean())
                line += f", between {low:.2f} and {high:.2f}"
            print(line)


def chances_of(said: Sequence[tuple[Case, bool]], whole: Logistic) -> list[tuple[float, bool]]:
    """Give the chance of every verdict, and whether it is right; of unknown the parts say it."""
    return [((PRODUCT if unknown else whole)(of), good) for (of, good), unknown in said]


def read_kept(file: Path, lines: int | None) -> list[Row]:
    """Give the kept verdicts that say what they rest on, of the first lines or of all."""
    kept = file.read_text(encoding="utf-8").splitlines()[:lines]
    return [row for row in map(json.loads, kept) if "product" in row]


def kept_cases_of_family(rows: Sequence[Row]) -> list[Case]:
    """Give what kept verdicts leave where that matters, and whether nothing is hidden that the catalogue has not."""
    left = [row for row in rows if "rest" in row and is_left(row["rest"], Materiality().channel)]
    return [(row["rest"], "unknown" not in row["missing"]) for row in left]


def said_by_kept(row: Row, right_family: Logistic) -> tuple[Case, bool]:
    """Give what a kept verdict says of a campaign, whether that is right, and whether it is unknown."""
    left = "rest" in row and is_left(row["rest"], Materiality().channel)
    exact = right_family(row["rest"]) if left else 1.0
    if row["verdict"] == "unknown":
        return ({"product": compute_log_odds(1.0 - exact if left else EVEN_ODDS), "floors": 0.0}, row["right"]), True
    named = row["verdict"] in ("named", "ambiguous", "instrument")
    chance = PRODUCT({"product": compute_log_odds(float(expit(row["product"])) * max(exact, 1.0 - exact))})
    of = {"product": compute_log_odds(chance), "floors": float(np.log(max(1.0, row["final_error"]))) if named else 0.0}
    return (of, row["right"]), False


def main() -> None:
    """Read verdicts, fit, write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "source", type=Path, help="a folder with verdicts.jsonl and answers, of 17_verdicts.py, or a file"
    )
    parser.add_argument("--whole", action="store_true", help="fit the last model alone, to a file of kept verdicts")
    parser.add_argument("--lines", type=int, help="of that file, from the first; the others can be a test")
    parser.add_argument("--check", action="store_true", help="write nothing")
    chosen = parser.parse_args()
    content = json.loads(OUT.read_text(encoding="utf-8"))
    before = Calibration(**{n: Logistic(of["constant"], of["weights"]) for n, of in content["models"].items()})
    today = f"{datetime.now(UTC):%Y-%m-%d}"
    if chosen.whole:
        rows = read_kept(chosen.source, chosen.lines)
        left = kept_cases_of_family(rows)
        family = fitted(left, FAMILY, before.right_family)
        said = [said_by_kept(row, family) for row in rows]
        cases = [case for case, unknown in said if not unknown]
        chances = replace(before, right_family=family, all_right=fitted(cases, WHOLE, before.all_right))
        report(chances_of([said_by_kept(row, before.right_family) for row in rows], before.all_right), "as before")
        report(chances_of(said, chances.all_right), "fitted to them")
        report([(family(of), good) for of, good in left], "what is left is no law outside the catalogue")
        source = f"verdicts of {chosen.source}, {today}; scripts/calibrate.py"
        content["provenance_of_all_right"] = f"{len(cases)} {source}"
        content["provenance_of_right_family"] = f"{len(left)} {source}"
    else:
        every = read(chosen.source)
        rows = [row for row in every if not row["answer"]["held_out_family"]]
        said = by_others(rows, before)
        chances = parts_fitted(rows, before)
        whole = fitted([case for case, unknown in said if not unknown], WHOLE, before.all_right)
        chances = replace(chances, all_right=whole)
        report(chances_of(said, whole), "by models of other campaigns")
        held = [said_by(row, chances) for row in every if row["answer"]["held_out_family"]]
        report(chances_of(held, whole), "families held out")
        kept = [name for name, model in vars(chances).items() if model is getattr(before, name)]
        seeds = sorted(row["answer"]["seed"] for row in rows)
        content["provenance"] = (
            f"{len(rows)} campaigns of the families, seeds {seeds[0]} to {seeds[-1]}, {today}; "
            f"scripts/calibrate.py; too few cases, chosen by judgement: {', '.join(kept) or 'none'}"
        )
        content["provenance_of_all_right"] = content["provenance_of_right_family"] = "as the others"
    content["models"] = {n: {"constant": m.constant, "weights": m.weights} for n, m in vars(chances).items()}
    print(json.dumps(content, indent=1))
    if not chosen.check:
        OUT.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
