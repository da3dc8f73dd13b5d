"""Make campaigns with hidden effects, blind, with the second simulator of `benchmarks`.

    python scripts/make_bench.py --out out/bench --count 300 --seed 1000
    python scripts/make_bench.py --out out/bench --effects run_in key_friction --size medium
    python scripts/make_bench.py --out out/dirty --dirty --count 40 --seed 81000 --workers 2
    python scripts/make_bench.py --out out/drawn --drawn --count 40 --seed 36000 --workers 2

Campaigns go to OUT/NAME, answers to OUT/truth/NAME.json, where a diagnosis of the campaigns does not read them.
Campaigns that have their answer already are kept, so an interrupted run goes on where it stopped. Dirty campaigns have
many small imperfections at once, and their answers say of each effect whether it is material. Drawn campaigns are
those of rigs of 1 to 100 t on three to eight pads, flat or curved, each with its specimen.toml.
"""

import argparse
import sys
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

from slipwise_benchmarks import DRAWN, SIZES, Case, make_campaign, make_dirty, plan, write_truth


@dataclass(frozen=True)
class Order:
    """One campaign to make: its folder, its answer's file, its seed, and what a clean one hides (None: it decides)."""

    folder: Path
    answer: Path
    seed: int
    dirty: bool
    effects: tuple[str, ...] | None = ()
    size: str | None = "medium"
    rig: str | None = None
    rich: bool = False


def make(order: Order) -> str:
    """Make one campaign; the answer is written last."""
    name, began = order.folder.name, time.perf_counter()
    if order.dirty:
        truth = make_dirty(order.folder, order.seed)
        first = ", ".join(one.kind for one in truth.first)
        said = (", ".join(truth.missing) or "nothing to name") + (f"; first {first}" if first else "")
    else:
        hidden = {"effects": order.effects, "size": order.size, "rig": order.rig, "rich": order.rich}
        truth = make_campaign(order.folder, order.seed, **hidden)
        said = f"{', '.join(truth.missing) or 'complete'}  {truth.size}  {truth.size_in_floors:.1f} floors"
    write_truth(order.answer, truth.as_dict())
    return f"{name}  {truth.rig}  {said}  {time.perf_counter() - began:.0f} s"


def orders(chosen: argparse.Namespace) -> list[Order]:
    """Give what has no answer yet."""
    count = 3 if chosen.quick else chosen.count
    cases = plan(count, chosen.seed)
    if chosen.effects is not None:
        cases = [Case(tuple(chosen.effects), chosen.size or "medium", chosen.rich)] * count
    wanted = []
    for seed, case in enumerate(cases, start=chosen.seed):
        name = f"{'d' if chosen.dirty else 'r' if chosen.drawn else 'b'}{seed:05d}"
        places = (chosen.out / name, chosen.out / "truth" / f"{name}.json")
        if chosen.drawn and chosen.effects is None:
            wanted.append(Order(*places, seed, False, None, chosen.size, DRAWN, chosen.rich))
            continue
        size, rich = chosen.size or case.size, chosen.rich or case.rich
        rig = DRAWN if chosen.drawn else chosen.rig
        wanted.append(Order(*places, seed, chosen.dirty, case.effects, size, rig, rich))
    return [order for order in wanted if not order.answer.exists()]


def main(arguments: list[str] | None = None) -> int:
    """Read the command line and write the campaigns."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/bench"), help="folder for campaigns and truth/")
    parser.add_argument("--count", type=int, default=36, help="campaigns of the even plan (a third complete)")
    parser.add_argument("--seed", type=int, default=1000, help="seed of the plan and of the first campaign")
    parser.add_argument("--dirty", action="store_true", help="dirty campaigns; each seed decides everything")
    parser.add_argument("--drawn", action="store_true", help="rigs of any size; each seed decides everything")
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--effects", nargs="*", help="hide these in every campaign instead; none given: nothing")
    parser.add_argument("--size", choices=list(SIZES), help="of those effects")
    parser.add_argument("--rig", choices=["bridge1", "bridge2"], help="always this rig")
    parser.add_argument("--rich", action="store_true", help="motion across and more gauges in every campaign")
    parser.add_argument("--quick", action="store_true", help="three campaigns only")
    chosen = parser.parse_args(arguments)

    start, left = time.perf_counter(), orders(chosen)
    with ProcessPoolExecutor(chosen.workers, mp_context=get_context("spawn")) as pool:
        for job in as_completed([pool.submit(make, order) for order in left]):
            print(job.result(), flush=True)
    print(f"{len(left)} campaigns in {chosen.out}, {time.perf_counter() - start:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
