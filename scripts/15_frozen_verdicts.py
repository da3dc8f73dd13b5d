"""Verdicts that are kept: 60 campaigns of fixed seeds and six replays, held against what was stored before.

    python scripts/15_frozen_verdicts.py --out out/frozen
    python scripts/15_frozen_verdicts.py --out out/frozen --practice ../shared/practice
    python scripts/15_frozen_verdicts.py --out out/frozen --store
    python scripts/15_frozen_verdicts.py --quick

A step that only moves code leaves every line as it is; one that decides anew lists what it changes. Kind and names are
held exactly, probabilities to 3 digits, errors to 4, replays bit by bit. Every finished campaign is one line of
results.jsonl, and the same command goes on where it stopped. `--store` writes tests/frozen_verdicts.json. Of campaigns
in the folders of `--practice` the verdicts are held too.

Campaigns are made by `benchmarks`, whose physics is not the library's: clean ones, those with many imperfections,
rigs that are drawn, single sliders, and records sampled five times as finely, which are cut to what can be fitted.
"""

import argparse
import hashlib
import json
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.signal import resample_poly

import slipwise as sw
from slipwise.diagnosis.diagnose import diagnose
from slipwise_benchmarks import DRAWN, make_bearing, make_campaign, make_dirty, plan
from slipwise_benchmarks.bearing import KINDS

TESTS = Path(__file__).parents[1] / "tests"
STORED = TESTS / "frozen_verdicts.json"
SEED = 54000
#: How often a long record is sampled more finely.
FINER = 5
#: Rig, effects beside the paper's law (None: Coulomb's law), and motion of each replay.
REPLAYS: dict[str, tuple[str, tuple[str, ...] | None, str]] = {
    "replay0": ("bridge1", (), "sine:2Hz,0.3g,cycles=12"),
    "replay1": ("block", None, "sine:5Hz,0.4g,cycles=20"),
    "replay2": ("bridge2", (), "quake:seed=1,peak=0.7g,vertical=0.3g"),
    "replay3": ("bridge1", ("breakaway", "heating"), "quake:seed=2,peak=0.5g"),
    "replay4": ("block", (), "sine:1Hz,0.2g,cycles=9"),
    "replay5": ("block", ("rate_and_state",), "sine:3Hz,0.35g,cycles=10"),
}
#: What is held of a verdict; times are only written down.
HELD = ("kind", "names", "probability", "base_error", "final_error", "relations", "bits")


def campaigns() -> dict[str, tuple[Callable[..., Any], dict[str, Any]]]:
    """Return name -> what makes the campaign in a folder, and its arguments."""

    def hidden(case: Any) -> dict[str, Any]:
        return {"effects": case.effects, "size": case.size, "rich": case.rich}

    out: dict[str, tuple[Callable[..., Any], dict[str, Any]]] = {}
    out |= {f"clean{i:02d}": (make_campaign, {"seed": SEED + i, **hidden(c)}) for i, c in enumerate(plan(18, SEED))}
    out |= {f"dirty{i:02d}": (make_dirty, {"seed": SEED + 100 + i}) for i in range(14)}
    out |= {f"drawn{i:02d}": (make_campaign, {"seed": SEED + 200 + i, "rig": DRAWN}) for i in range(8)}
    out |= {
        f"slider{i:02d}": (make_bearing, {"kind": KINDS[i % len(KINDS)], "seed": SEED + 300 + i}) for i in range(16)
    }
    late = enumerate(plan(4, SEED + 400))
    return out | {f"long{i:02d}": (make_campaign, {"seed": SEED + 400 + i, **hidden(c)}) for i, c in late}


def verdict_of(folder: Path, finer: int = 1) -> dict[str, Any]:
    """Return what is held of one campaign: kind, names, probability, and the errors before and after."""
    began = time.perf_counter()
    campaign = sw.load_campaign(folder)
    if finer > 1:
        runs = tuple(replace(run, record=_finer(run.record, finer)) for run in campaign.runs)
        campaign = replace(campaign, runs=runs)
    found = diagnose(campaign)
    return {
        "kind": found.verdict.kind,
        "names": list(found.verdict.effects),
        "probability": round(found.verdict.probability, 3),
        "base_error": _digits(found.base_error),
        "final_error": _digits(found.final_error),
        "relations": {relation: [_digits(x) for x in pair] for relation, pair in found.relations.items()},
        "seconds": round(time.perf_counter() - began, 1),
    }


def _finer(record: sw.Record, by: int) -> sw.Record:
    """Return a record sampled so many times as finely, as a faster logger would have written it."""
    time_axis = np.arange(len(record) * by) * (record.dt / by) + record.time[0]
    channels = {name: resample_poly(values, by, 1, padtype="line") for name, values in record.channels.items()}
    return sw.Record(time_axis, channels, record.provenance)


def _digits(x: float) -> float:
    return float(f"{x:.4g}")


def bits_of(rig: str, effects: tuple[str, ...] | None, motion: str) -> str:
    """Return a hash of every bit of a replay's record."""
    model = sw.base_model(rig, () if effects is None else None)
    record = sw.replay(model.adding(*(sw.use(name) for name in effects or ())), motion).record
    bits = b"".join(name.encode() + np.ascontiguousarray(values).tobytes() for name, values in record.channels.items())
    return hashlib.sha256(record.time.tobytes() + bits).hexdigest()[:20]


def results(chosen: argparse.Namespace, done: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield what is not there yet, one after another."""
    cases = campaigns()
    if chosen.quick:
        cases = {"slider00": cases["slider00"]}
    for name, (rig, effects, motion) in REPLAYS.items():
        if name not in done:
            yield {"name": name, "bits": bits_of(rig, effects, motion)}
    for name, (make, arguments) in cases.items():
        if name not in done and name.startswith(tuple(chosen.only)):
            folder = chosen.out / "campaigns" / name
            if not folder.exists():
                make(folder, **arguments)
            yield {"name": name, **verdict_of(folder, FINER if name.startswith("long") else 1)}
    for folder in sorted(path.parent for path in chosen.practice.glob("*/campaign.toml")) if chosen.practice else ():
        if folder.name not in done:
            yield {"name": folder.name, **verdict_of(folder)}


def differences(done: dict[str, Any], stored: dict[str, Any]) -> list[str]:
    """Return a line for everything that is held and differs from what was stored."""
    out: list[str] = []
    for name in sorted(set(done) & set(stored)):
        now, before = done[name], stored[name]
        out += [
            f"{name}: {what} was {before[what]}, is {now[what]}"
            for what in HELD
            if what in before and before[what] != now.get(what)
        ]
    return out


def main() -> None:
    """Run what is missing, and say what differs."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/frozen"))
    parser.add_argument("--only", nargs="*", default=[""], help="campaigns whose names begin so")
    parser.add_argument("--practice", type=Path, help="a folder of campaigns whose verdicts are held too")
    parser.add_argument("--store", action="store_true", help=f"write {STORED.name} instead of holding against it")
    parser.add_argument("--quick", action="store_true", help="the replays and one campaign of a slider")
    chosen = parser.parse_args()
    chosen.out.mkdir(parents=True, exist_ok=True)
    path = chosen.out / "results.jsonl"
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    done = {result["name"]: result for result in map(json.loads, lines)}
    with path.open("a", encoding="utf-8") as stream:
        for result in results(chosen, done):
            done[result["name"]] = result
            print(json.dumps(result), file=stream, flush=True)
            print(json.dumps(result), flush=True)
    if chosen.store:
        kept = {name: {k: v for k, v in of.items() if k in HELD} for name, of in sorted(done.items())}
        rows = ",\n".join(f"{json.dumps(name)}: {json.dumps(of)}" for name, of in kept.items())
        STORED.write_text(f"{{\n{rows}\n}}\n", encoding="utf-8")
        return
    stored = json.loads(STORED.read_text(encoding="utf-8")) if STORED.exists() else {}
    found = differences(done, stored)
    print("\n".join(found) or f"{len(set(done) & set(stored))} of {len(stored)} held: nothing differs")


if __name__ == "__main__":
    main()
