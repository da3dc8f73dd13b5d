"""The bench of laws outside the catalogue: campaigns of a second simulator, discovered and scored.

    python scripts/11_discover.py --out out/discover --count 60 --seed 90000
    python scripts/11_discover.py --quick

Campaigns are made by `benchmarks`, whose physics is not the library's: each has a law that no catalogue has, alone or
beside known effects, or none, clean or with many small imperfections. They go to OUT/campaigns/NAME, each with its
truth.json, and are kept. Every finished campaign is one line of results.jsonl: a run that was stopped (Ctrl-C) shows
what is done, and the same command goes on where it stopped. discover.json has the scores and every answer that is
wrong. A version of slipwise that cannot discover only makes the campaigns.
"""

import argparse
import json
import time
from pathlib import Path
from typing import Any

from slipwise_benchmarks import make_law_campaign
from slipwise_benchmarks import score_discover as score
from slipwise_benchmarks.resumed import read_results, run_jobs
from slipwise_benchmarks.score_constants import constant_rows

TESTS = Path(__file__).parents[1] / "tests"
STORED = TESTS / "bench" / "stored_discoveries.json"


def make(folder: Path, seed: int) -> dict[str, Any]:
    """Make a campaign where it is not there yet, and give its answer, which is written last."""
    answer = folder / "truth.json"
    if not answer.exists():
        make_law_campaign(folder, seed)
    return json.loads(answer.read_text(encoding="utf-8"))


def one(folder: Path, seed: int) -> dict[str, Any]:
    """Make one campaign, discover blind where slipwise can, and give both answers."""
    truth = make(folder, seed)
    return {"name": folder.name, "truth": truth, "said": discovered(folder) if can_discover() else None}


def can_discover() -> bool:
    """Tell whether this version of slipwise can discover laws."""
    import slipwise

    return hasattr(slipwise, "discover")


def discovered(folder: Path) -> dict[str, Any]:
    """Discover the law of a campaign; one that breaks the search is counted as wrong, and shown."""
    import slipwise

    began = time.perf_counter()
    try:
        said = getattr(slipwise, "discover")(folder).as_json()  # noqa: B009 - a version may lack it
    except Exception as error:
        said = {"evidence": f"failed: {type(error).__name__}: {error}", "laws": [], "held_out": None, "file": None}
    return {**said, "seconds": time.perf_counter() - began}


def _line(result: dict[str, Any], number: int, total: int) -> str:
    truth, said = result["truth"], result["said"]
    kind = "+".join([truth["name"] or "no law", *truth["beside"]]) + (", dirty" if truth["dirty"] else ", clean")
    words = f"{number:4d} of {total}  {result['name']}  {kind:60s} {truth['floors']:5.1f} floors"
    if said is None:
        return words
    law = (said["laws"] or [{}])[0]
    over = f"{law['form']} over {' x '.join(law['states'])}, {law['port']}" if law else ""
    return f"{words}  {said['evidence']:10.60s} {over}  {said['seconds']:.0f} s"


def run(out: Path, seeds: range, workers: int) -> list[dict[str, Any]]:
    """Run the campaigns that have no result yet; gives in order all results that there are, fewer if it is stopped."""
    (out / "campaigns").mkdir(parents=True, exist_ok=True)
    kept = read_results(out / "results.jsonl")
    done = {r["name"]: r for r in kept if r["said"] is not None or not can_discover()}
    names = {f"l{seed:05d}": seed for seed in seeds}
    left = {name: (one, out / "campaigns" / name, seed) for name, seed in names.items() if name not in done}
    done |= {r["name"]: r for r in run_jobs(out / "results.jsonl", left, workers, _line)}
    return [done[name] for name in names if name in done]


def show(out: Path, results: list[dict[str, Any]]) -> None:
    """Score results; print the table and what was wrong, write the numbers."""
    from slipwise.record import write_json

    counted, parts, bad = score.rates(results), score.split(results), score.wrong(results)
    for name, (count, total) in counted.items():
        print(f"{name:55s} {count:4d} of {total}")
    for name, (count, total) in parts.items():
        print(f"{'driving state right, ' + name:55s} {count:4d} of {total}")
    for row in bad:
        print(f"{row['campaign']}  {row['evidence']}: there {row['there']}; said {row['said']}")
    good = [r for r in results if score.in_library(r["truth"]) and score.form_first(r["truth"], r["said"])]
    write_json(out / "discover.json", {**counted, "by kind": parts, "wrong": bad, "constants": constant_rows(good)})
    print(f"wrote {out / 'discover.json'}")


def main() -> None:
    """Make, discover, score, print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/discover"))
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=90000, help="of the first campaign")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--quick", action="store_true", help="one campaign is made; answers that are stored are scored")
    chosen = parser.parse_args()
    if chosen.quick:
        truth = make(chosen.out / "campaigns" / f"l{chosen.seed:05d}", chosen.seed)
        print(f"{truth['name'] or 'no law'}: {truth['floors']:.1f} floors")
        show(chosen.out, json.loads(STORED.read_text(encoding="utf-8")))
        return
    results = run(chosen.out, range(chosen.seed, chosen.seed + chosen.count), chosen.workers)
    if len(results) < chosen.count:
        print(f"stopped with {len(results)} of {chosen.count} campaigns done; the same command goes on from there")
    if not can_discover():
        print(f"this version of slipwise cannot discover laws; {len(results)} campaigns are in {chosen.out}/campaigns")
    elif results:
        show(chosen.out, results)


if __name__ == "__main__":
    main()
