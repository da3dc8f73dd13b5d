"""The blind bench: hidden-effect campaigns of a second simulator, diagnosed and scored.

    python scripts/07_bench.py --out out/bench --count 300 --seed 20000
    python scripts/07_bench.py --quick

Campaigns are made by `tests/bench`, whose physics is not the library's. Every finished campaign is one line of
results.jsonl, so an interrupted run goes on where it stopped. The page shows who is taken for whom and whether verdicts
of probability 0.9 are right nine times in ten.
"""

import argparse
import json
import shutil
import sys
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from multiprocessing import get_context
from pathlib import Path
from typing import Any

TESTS = Path(__file__).parents[1] / "tests"


def one(folder: Path, name: str, seed: int, effects: tuple[str, ...], size: str, rich: bool) -> dict[str, Any]:
    """Make one campaign, diagnose it blind, and give both answers."""
    sys.path.insert(0, str(TESTS))
    from bench import make_campaign  # pyright: ignore[reportMissingImports]
    from slipwise.campaign import load_campaign
    from slipwise.diagnose import diagnose

    truth = make_campaign(folder / name, seed, effects=effects, size=size, rich=rich)
    began = time.perf_counter()
    try:
        said = diagnose(load_campaign(folder / name), system=False).as_json()
    except Exception as error:  # a campaign that breaks the diagnosis is counted as wrong, and shown
        said = {"verdict": f"failed: {type(error).__name__}: {error}", "effects": [], "probability": 0.0}
    said["seconds"] = time.perf_counter() - began
    shutil.rmtree(folder / name)
    return {"name": name, "truth": truth.as_dict(), "said": said}


def _line(result: dict[str, Any], number: int, total: int) -> str:
    said, truth = result["said"], result["truth"]
    hidden, named = "+".join(truth["missing"]) or "complete", "+".join(said["effects"])
    size = f"{truth['size_after_fit']:6.1f} floors"
    words = f"{said['verdict']:10.60s} {named:32s} p={said['probability']:.2f} {said['seconds']:.0f} s"
    return f"{number:4d} of {total}  {hidden:32s} {size}  {words}"


def run(out: Path, count: int, seed: int, workers: int) -> list[dict[str, Any]]:
    """Run the campaigns that have no result yet; gives all results in order."""
    sys.path.insert(0, str(TESTS))
    from bench import plan  # pyright: ignore[reportMissingImports]

    out.mkdir(parents=True, exist_ok=True)
    lines = out / "results.jsonl"
    done = {r["name"]: r for r in map(json.loads, lines.read_text().splitlines())} if lines.exists() else {}
    cases = {f"b{seed + i:05d}": (seed + i, case) for i, case in enumerate(plan(count, seed))}
    left = {name: entry for name, entry in cases.items() if name not in done}
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool, lines.open("a") as stream:
        jobs = [pool.submit(one, out / "campaigns", n, s, c.effects, c.size, c.rich) for n, (s, c) in left.items()]
        for number, job in enumerate(as_completed(jobs), start=1):
            result = job.result()
            done[result["name"]] = result
            stream.write(json.dumps(result) + "\n")
            stream.flush()
            print(_line(result, number, len(left)), flush=True)
    return [done[name] for name in cases]


def draw(results: list[dict[str, Any]], path: Path) -> None:
    """Draw the calibration: what was said against what came true."""
    from bench.score import calibration  # pyright: ignore[reportMissingImports]
    from slipwise.view.canvas import new_figure, save_figure

    figure = new_figure(6.0, 5.5, "Is a probability worth its name?")
    axes = figure.subplots()
    axes.plot([0, 1], [0, 1], color="0.7", lw=1)
    for row in calibration(results):
        axes.plot(row["said"], row["right"], "o", color="#0072b2", markersize=4 + row["count"] ** 0.5)
        axes.annotate(f" {row['count']:.0f}", (row["said"], row["right"]))
    axes.set_xlabel("probability of the verdict")
    axes.set_ylabel("share that was exactly right")
    save_figure(figure, path)


def main() -> None:
    """Run, score, print, draw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument(
        "--seed", type=int, default=20000, help="of the first campaign; thresholds were frozen on others"
    )
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--quick", action="store_true", help="two campaigns only")
    chosen = parser.parse_args()
    results = run(chosen.out, 2 if chosen.quick else chosen.count, chosen.seed, chosen.workers)
    from bench.score import calibration, confusion, rates  # pyright: ignore[reportMissingImports]
    from bench.sizes import sizes  # pyright: ignore[reportMissingImports]
    from slipwise.record import write_json

    scored = rates(results)
    for name, (good, total) in scored["exactly right"].items():
        print(f"exactly right, {name:32s} {good:4d} of {total}")
    held = sizes(results)
    scored["size inside its 95 % interval"] = [sum(row["inside"] for row in held), len(held)]
    for name, (count, total) in ((n, v) for n, v in scored.items() if n != "exactly right"):
        print(f"{name:55s} {count:4d} of {total}")
    table = {hidden: dict(said) for hidden, said in confusion(results).items()}
    content = {**scored, "confusion": table, "calibration": calibration(results), "sizes": held}
    write_json(chosen.out / "bench.json", content)
    draw(results, chosen.out / "calibration.png")


if __name__ == "__main__":
    main()
