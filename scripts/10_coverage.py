"""Repeat a campaign with fresh noise: do the 95 % intervals of the base parameters hold the truth 95 times in 100?

    python scripts/10_coverage.py [--repeats 40] [--seed 700] [--out out/coverage] [--quick]

Campaigns of the second simulator of `benchmarks`, in which nothing is missing, are measured again and again with
correlated noise, and fitted. A new rig, with base parameters off by several per cent, comes every fifth repeat.
"""

import argparse
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.estimation.base_fit import fit_base
from slipwise.estimation.intervals import compute_intervals
from slipwise.record import write_json
from slipwise_benchmarks import build_campaign, with_faults
from slipwise_benchmarks.in_memory import as_campaign

#: Correlation of a sample's noise with that of the one before [1].
CORRELATION = 0.5
REPEATS_EACH = 5


def truth_of(made: Any) -> dict[str, float]:
    """Give the true value of every number that is judged."""
    base = made.truth.base
    return {
        "shear_rate.strength": base.s1,
        "shear_rate.rate": base.n,
        "contact_area.saturation": base.k,
        "shear_rate.slow": base.alpha,
        "rig.buffer_stiffness": base.buffer_stiffness,
        "rig.mass": base.mass,
        "rig.centre_height": base.height,
    }


def main() -> None:
    """Measure, fit, count, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/coverage"))
    parser.add_argument("--repeats", type=int, default=40)
    parser.add_argument("--seed", type=int, default=700)
    parser.add_argument("--quick", action="store_true", help="two repeats only")
    chosen = parser.parse_args()

    count = 2 if chosen.quick else chosen.repeats
    inside: dict[str, list[bool]] = {}
    away: dict[str, list[float]] = {}
    made: Any = None
    for repeat in range(count):
        if repeat % REPEATS_EACH == 0:
            made = build_campaign(chosen.seed + repeat, effects=())
            chain = replace(made.truth.logger, correlation=CORRELATION, stated=True)
            made = replace(made, truth=replace(made.truth, logger=chain))
        fit = fit_base(as_campaign(with_faults(made, (), chosen.seed + 1000 + repeat)))
        found = {i.key: i for i in compute_intervals(fit).entries}
        for key, true in truth_of(made).items():
            i = found[key]
            inside.setdefault(key, []).append(i.low <= true <= i.high)
            away.setdefault(key, []).append((i.value - true) / (0.5 * (i.high - i.low)))
        print(f"repeat {repeat + 1:3d} of {count}  " + " ".join(f"{a[-1]:+.2f}" for a in away.values()), flush=True)
    rows = {}
    for key, hits in inside.items():
        mean, spread = float(np.mean(away[key])), float(np.std(away[key]))
        rows[key] = {"inside": sum(hits), "of": len(hits), "mean": mean, "spread": spread}
    for key, row in rows.items():
        print(
            f"{key:26s} inside {row['inside']:3d} of {row['of']}, error in half widths: mean {row['mean']:+.2f}, "
            f"standard deviation {row['spread']:.2f} (0.51 if right)"
        )
    total = sum(row["inside"] for row in rows.values())
    print(f"all together: {total} of {count * len(rows)}")
    write_json(chosen.out / "coverage.json", rows)


if __name__ == "__main__":
    main()
