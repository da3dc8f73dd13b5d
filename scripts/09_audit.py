"""Plant faults of gauges in recorded campaigns: does the audit find the right fault, channel and size?

    python scripts/09_audit.py [--count 100] [--seed 900] [--out out/audit] [--quick]

A few campaigns of the second simulator of `benchmarks`, in which nothing is missing, are measured again and again:
each time with fresh noise and one fault of random size. A planting counts as right when the fault is found on its own
channel or card, its size is within 15 %, and no other gauge is accused. Complete campaigns, and the practice campaigns
where they lie beside the project, are audited too: nobody must be accused.
"""

import argparse
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.campaign import load_campaign
from slipwise.instruments.audit import audit
from slipwise.instruments.report import AuditReport
from slipwise.record import write_json
from slipwise_benchmarks import GROUPS, Fault, build_campaign, with_faults
from slipwise_benchmarks.in_memory import as_campaign

PRACTICE = Path(__file__).parents[2] / "shared" / "practice"
#: Planted size is found within this [1].
NEAR = 0.15
GROUPED = ("slip", "girder", "forces", "loads")
#: Fault -> channels or cards that it is planted in ("force ?": one cell), smallest and largest size, SI, both signs.
PLANTED: dict[str, tuple[tuple[str, ...], float, float, bool]] = {
    "channel_delay": ((*GROUPED, "force ?", "load ?"), 2e-3, 10e-3, False),
    "channel_gain": ((*GROUPED, "force ?", "load ?"), 0.02, 0.10, True),
    "load_crosstalk": (("forces", "force ?"), 0.005, 0.02, True),
    "cell_inertia": (("cells",), 15.0, 60.0, False),
}


def draw(rng: np.random.Generator, effect: str) -> Any:
    """Draw one fault: where, how large, which variant."""
    places, low, high, both = PLANTED[effect]
    place = str(rng.choice(places)).replace("?", str(rng.choice(list("ABCD"))))
    size = float(rng.uniform(low, high)) * (float(rng.choice([-1.0, 1.0])) if both else 1.0)
    form = {"load_crosstalk": ("zeroed at rest", "not zeroed"), "cell_inertia": ("subtracted", "added")}.get(effect)
    channels = GROUPS["forces"] + GROUPS["loads"] if place == "cells" else GROUPS[place]
    return Fault(effect, channels, size, str(rng.choice(form)) if form else "")


def channel_of(fault: Any) -> str:
    """Write a fault's channels as a finding does."""
    if len(fault.channels) == 1:
        return fault.channels[0]
    return "pad_*" if len(fault.channels) > 4 else "pad_*_" + fault.channels[0].split("_")[-1]


def score(fault: Any, report: AuditReport) -> dict[str, Any]:
    """Say what an audit made of one planted fault."""
    own = [f for f in report.findings if (f.what, f.channel) == (fault.effect, channel_of(fault))]
    size = own[0].size if own else float("nan")
    near = bool(own) and abs(size / fault.size - 1.0) <= NEAR
    return {
        "effect": fault.effect, "channel": channel_of(fault), "planted": fault.size, "form": fault.form,
        "found": size if own else None, "right": bool(near and len(report.findings) == 1),
        "inside": bool(own and own[0].low <= fault.size <= own[0].high),
        "accused": [f.words for f in report.findings],
        "notes": list(report.notes),
    }  # fmt: skip


def plantings(bases: list[Any], count: int, seed: int) -> Iterator[dict[str, Any]]:
    """Plant, audit and score, one kind of fault after the other."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        fault = draw(rng, list(PLANTED)[number % len(PLANTED)])
        base = bases[(number // len(PLANTED)) % len(bases)]
        report = audit(as_campaign(with_faults(base, [fault], int(rng.integers(2**31)))))
        yield {**score(fault, report), "campaign": base.truth.seed, "rig": base.truth.rig}


def innocent(bases: list[Any]) -> dict[str, list[str]]:
    """Audit the complete campaigns, and the practice campaigns whose gauges are right; give what is accused."""
    reports: dict[str, Callable[[], AuditReport]] = {
        f"complete {base.truth.seed}": lambda base=base: audit(as_campaign(base)) for base in bases
    }
    for folder in sorted(PRACTICE.glob("p*")):
        reports[folder.name] = lambda folder=folder: audit(load_campaign(folder))
    return {name: [f.words for f in report().findings] for name, report in reports.items()}


def main() -> None:
    """Plant, audit, print, save."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/audit"))
    parser.add_argument("--count", type=int, default=100, help="faults to plant")
    parser.add_argument("--seed", type=int, default=900, help="of campaigns and faults")
    parser.add_argument("--quick", action="store_true", help="one campaign, two faults, no other campaigns")
    chosen = parser.parse_args()

    bases = [
        build_campaign(chosen.seed + i, effects=(), rig=("bridge1", "bridge2")[i % 2])
        for i in range(1 if chosen.quick else 6)
    ]
    results, began = [], time.perf_counter()
    for result in plantings(bases, 2 if chosen.quick else chosen.count, chosen.seed):
        results.append(result)
        word = "right" if result["right"] else "WRONG"
        found = "not found" if result["found"] is None else f"found {result['found']:.4g}"
        print(
            f"{word} {result['effect']:15s} {result['channel']:9s} planted {result['planted']:.4g}, {found}", flush=True
        )
        if not result["right"]:
            print(f"      on {result['rig']} {result['campaign']} {result['form']}: {'; '.join(result['accused'])}")
            print("".join(f"      {note}\n" for note in result["notes"]), end="", flush=True)
    right, inside = (sum(r[key] for r in results) for key in ("right", "inside"))
    print(f"right fault, channel and size: {right} of {len(results)}; truth inside the 95 % interval: {inside}")
    print(f"{(time.perf_counter() - began) / len(results):.1f} s for each planting")
    accused = {} if chosen.quick else innocent(bases)
    for name, words in accused.items():
        print(f"{name}: {'; '.join(words) or 'nobody accused'}")
    content = {"right": right, "inside": inside, "of": len(results), "plantings": results, "innocent": accused}
    write_json(chosen.out / "audit.json", content)


if __name__ == "__main__":
    main()
