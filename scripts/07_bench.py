"""The blind bench: hidden-effect campaigns of a second simulator, diagnosed and scored.

    python scripts/07_bench.py --out out/bench --count 300 --seed 20000
    python scripts/07_bench.py --out out/dirty --dirty --count 200 --seed 81000
    python scripts/07_bench.py --out out/drawn --drawn --count 100 --seed 36000
    python scripts/07_bench.py --out out/bearings --bearings --count 20 --seed 52000
    python scripts/07_bench.py --quick

Campaigns are made by benchmarks/, whose physics is not the library's. Every finished campaign is one line
of results.jsonl: a run that was stopped (Ctrl-C) shows what is done, and the same command goes on where it stopped.
bench.html shows who is taken for whom (confusion.png), whether verdicts of probability 0.9 are right nine times in ten
(calibration.png), how far the error falls (error_ratios.png), and every verdict that is wrong. bench.json has the
numbers. Drawn campaigns are those of rigs of 1 to 100 t on three to eight pads, flat or curved, each with its
specimen.toml.

Tests of single bearings are pendulums under a load that is held, springs without friction, flat faces with a rim and
without; bearings.json has what was said of each.

Dirty campaigns have many small imperfections at once; dirty.json has their scores and every verdict that is wrong. With
`--made DIR` they are those that `make_bench.py --dirty --out DIR` has made, or made there and kept.
"""

import argparse
import json
import shutil
import signal
import time
from pathlib import Path
from typing import Any

from slipwise_benchmarks import (
    DRAWN,
    bearing_plan,
    is_right,
    make_bearing,
    make_campaign,
    make_dirty,
    plan,
    radius_error,
    write_truth,
)
from slipwise_benchmarks import score_dirty as score
from slipwise_benchmarks.evidence import evidence_in
from slipwise_benchmarks.page import bench_page, pictures
from slipwise_benchmarks.resumed import read_results, run_jobs
from slipwise_benchmarks.score import calibration, confusion, rates
from slipwise_benchmarks.sizes import sizes


def one(folder: Path, name: str, seed: int, hidden: dict[str, Any]) -> dict[str, Any]:
    """Make one campaign, diagnose it blind, and give both answers; `hidden` are arguments of `make_campaign`."""
    truth = make_campaign(folder / name, seed, **hidden)
    said = diagnosed(folder / name)
    shutil.rmtree(folder / name)
    return {"name": name, "truth": truth.as_dict(), "said": said}


def one_dirty(folder: Path, name: str, seed: int, keep: bool) -> dict[str, Any]:
    """Make one dirty campaign where it is not there yet, diagnose it blind, and give both answers."""
    answer = folder / "truth" / f"{name}.json"
    if not answer.exists():
        write_truth(answer, make_dirty(folder / name, seed).as_dict())
    said = diagnosed(folder / name)
    if not keep:
        shutil.rmtree(folder / name)
    return {"name": name, "truth": json.loads(answer.read_text(encoding="utf-8")), "said": said}


def one_bearing(folder: Path, name: str, kind: str, seed: int) -> dict[str, Any]:
    """Make one test of a bearing, diagnose it blind, and give both answers."""
    truth = make_bearing(folder / name, kind, seed)
    said = diagnosed(folder / name)
    shutil.rmtree(folder / name)
    return {"name": name, "truth": {**truth, "missing": truth["may_name"], "group": kind}, "said": said}


def diagnosed(folder: Path) -> dict[str, Any]:
    """Diagnose a campaign; one that breaks the diagnosis is counted as wrong, and shown."""
    from slipwise.campaign import load_campaign
    from slipwise.diagnosis.diagnose import diagnose

    began = time.perf_counter()
    try:
        found = diagnose(load_campaign(folder), system=False)
        said = {**found.as_json(), "evidence": evidence_in(found)}
    except Exception as error:
        said = {"verdict": f"failed: {type(error).__name__}: {error}", "effects": [], "probability": 0.0}
    return {**said, "seconds": time.perf_counter() - began}


def _begin() -> None:
    """Be a worker that ends at once, without a word, at a Ctrl-C (Python would print a traceback of each)."""
    from slipwise.jobs.parallel import begin_worker

    signal.signal(signal.SIGINT, signal.SIG_DFL)
    begin_worker()


def _line(result: dict[str, Any], number: int, total: int) -> str:
    said, truth = result["said"], result["truth"]
    hidden, named = "+".join(truth["missing"]) or "complete", "+".join(said["effects"])
    size = f"{truth['size_after_fit']:6.1f} floors" if "size_after_fit" in truth else truth["group"]
    words = f"{said['verdict']:10.60s} {named:32s} p={said['probability']:.2f} {said['seconds']:.0f} s"
    return f"{number:4d} of {total}  {hidden:32s} {size}  {words}"


def work(chosen: argparse.Namespace, count: int) -> dict[str, tuple[Any, ...]]:
    """Give name -> what makes and diagnoses it, and with which arguments."""
    folder, seed = chosen.out / "campaigns", chosen.seed
    if chosen.dirty:
        names = {f"d{s:05d}": s for s in range(seed, seed + count)}
        return {n: (one_dirty, chosen.made or folder, n, s, bool(chosen.made)) for n, s in names.items()}
    if chosen.drawn:
        return {f"r{s:05d}": (one, folder, f"r{s:05d}", s, {"rig": DRAWN}) for s in range(seed, seed + count)}
    if chosen.bearings:
        return {n: (one_bearing, folder, n, *of) for n, of in bearing_plan(count, seed).items()}
    cases = {f"b{seed + i:05d}": (seed + i, case) for i, case in enumerate(plan(count, seed))}
    hidden = {n: (s, {"effects": c.effects, "size": c.size, "rich": c.rich}) for n, (s, c) in cases.items()}
    return {n: (one, folder, n, s, one_hides) for n, (s, one_hides) in hidden.items()}


def run(out: Path, cases: dict[str, tuple[Any, ...]], workers: int) -> list[dict[str, Any]]:
    """Run the campaigns that have no result yet; gives in order all results that there are, fewer if it is stopped."""
    out.mkdir(parents=True, exist_ok=True)
    done = {r["name"]: r for r in read_results(out / "results.jsonl")}
    left = {name: job for name, job in cases.items() if name not in done}
    try:
        done |= {r["name"]: r for r in run_jobs(out / "results.jsonl", left, workers, _line, _begin)}
    finally:
        shutil.rmtree(out / "campaigns", ignore_errors=True)
    return [done[name] for name in cases if name in done]


def show(out: Path, results: list[dict[str, Any]], planned: int) -> None:
    """Score results; print the rates, write the numbers, the pictures and the page."""
    from slipwise.record import write_json, write_text
    from slipwise.view.figures.canvas import save_figure
    from slipwise.view.figures.style import styled

    scored = rates(results)
    for name, (good, total) in scored["exactly right"].items():
        print(f"exactly right, {name:32s} {good:4d} of {total}")
    held = sizes(results)
    scored["size inside its 95 % interval"] = [sum(row["inside"] for row in held), len(held)]
    for name, (count, total) in ((n, v) for n, v in scored.items() if n != "exactly right"):
        print(f"{name:55s} {count:4d} of {total}")
    table = {hidden: dict(said) for hidden, said in confusion(results).items()}
    content = {**scored, "confusion": table, "calibration": calibration(results), "sizes": held}
    write_json(out / "bench.json", content)
    with styled():
        drawn = pictures(results)
        write_text(out / "bench.html", bench_page(results, planned, drawn))
    for name, figure in drawn.items():
        save_figure(figure, out / f"{name}.png")
    print(f"wrote {out / 'bench.html'}")


def show_dirty(out: Path, results: list[dict[str, Any]]) -> None:
    """Score results of dirty campaigns; print the rates and what was wrong, write the numbers."""
    from slipwise.record import write_json

    counted, bad, loss = score.rates(results), score.wrong(results), score.log_loss(results)
    for name, (good, total) in counted.items():
        print(f"{name:55s} {good:4d} of {total}")
    print(f"{'log loss of the probability':55s} {loss:7.2f}")
    for row in score.calibrated(results):
        tenth = f"probability {row['low']:.1f} to {row['high']:.1f}: {row['said']:.2f} on average"
        print(f"{tenth}, {row['right']:.2f} right of {row['count']:g}")
    for row in bad:
        print(f"{row['campaign']}  {row['verdict']}: lacks {row['lacking']}, accuses {row['accused']}")
    content = {**counted, "log loss": loss, "calibration": score.calibrated(results), "wrong": bad}
    write_json(out / "dirty.json", {**content, "importance": score.importances(results)})
    print(f"wrote {out / 'dirty.json'}")


def show_bearings(out: Path, results: list[dict[str, Any]]) -> None:
    """Print for each kind of bearing how many verdicts are right, and every wrong one; write the numbers."""
    from slipwise.record import write_json

    pairs = [(r["name"], r["truth"], r["said"]) for r in results]
    for kind in dict.fromkeys(truth["kind"] for _, truth, _ in pairs):
        right = [is_right(truth, said) for _, truth, said in pairs if truth["kind"] == kind]
        print(f"{kind:55s} {sum(right):4d} of {len(right)}")
    errors = [abs(e) for e in (radius_error(truth, said) for _, truth, said in pairs) if e == e]
    if errors:
        print(f"{'radius of the pendulums, largest error':55s} {100.0 * max(errors):7.2f} %")
    seconds = sorted(said["seconds"] for _, _, said in pairs)
    print(f"{'seconds of a verdict, median and longest':55s} {seconds[len(seconds) // 2]:7.0f} {seconds[-1]:5.0f}")
    for name, truth, said in pairs:
        if not is_right(truth, said):
            print(f"{name}  {said['verdict']}: {'+'.join(said['effects'])} ({said['probability']:.2f})")
    rows = [
        {"name": n, "right": is_right(t, s), "radius error": None if (off := radius_error(t, s)) != off else off}
        | {key: s[key] for key in ("verdict", "effects", "probability", "seconds")}
        for n, t, s in pairs
    ]
    write_json(out / "bearings.json", {"campaigns": rows})
    print(f"wrote {out / 'bearings.json'}")


def main() -> None:
    """Run, score, print, draw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument(
        "--seed", type=int, default=20000, help="of the first campaign; thresholds were frozen on others"
    )
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--dirty", action="store_true", help="many small imperfections at once in every campaign")
    parser.add_argument("--drawn", action="store_true", help="rigs of any size; each seed decides everything")
    parser.add_argument("--bearings", action="store_true", help="tests of single bearings under a load that is held")
    parser.add_argument("--made", type=Path, help="folder of dirty campaigns that are made already, or made there")
    parser.add_argument("--quick", action="store_true", help="one campaign only, of a single bearing: it takes seconds")
    chosen = parser.parse_args()
    chosen.bearings |= chosen.quick
    count = 1 if chosen.quick else chosen.count
    cases = work(chosen, count)
    if chosen.quick:
        cases = dict(list(cases.items())[:1])
    results = run(chosen.out, cases, chosen.workers)
    if len(results) < len(cases):
        print(f"stopped with {len(results)} of {len(cases)} campaigns done; the same command goes on from there")
    if results and chosen.dirty:
        show_dirty(chosen.out, results)
    elif results and chosen.bearings:
        show_bearings(chosen.out, results)
    elif results:
        show(chosen.out, results, count)


if __name__ == "__main__":
    main()
