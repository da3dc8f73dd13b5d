"""Make campaigns of every family and both makers, and keep them with their answer keys.

    python scripts/16_families.py --out out/families --count 12 --workers 2
    python scripts/16_families.py --out out/families --families gains temperature --makers replay --count 50
    python scripts/16_families.py --out out/families --first 11 --count 3
    python scripts/16_families.py --quick

`slipwise_benchmarks.families` says what the families are. Campaigns go to OUT/campaigns, answer keys to OUT/answers.
What is there and was made by the code as it is now is kept: the same command goes on where it stopped. Each campaign is
read once by the library. The table, OUT/families.csv, has a line for each family and maker: campaigns, seconds of
processor time for one, how many have something that should be named, and whether the family is held out of training.
"""

import argparse
import csv
import sys
import time
from collections import defaultdict
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from slipwise_benchmarks.families import FAMILIES, MAKERS
from slipwise_benchmarks.family_store import is_made, make, orders, read_answers

MOST_WORKERS = 2
#: Families whose campaigns are made within some seconds.
QUICKEST = ("clean", "tribometers")


def make_and_read(order: Any) -> tuple[bool, str]:
    """Make one campaign and let the library read it; gives whether that was possible, and a line about it."""
    from slipwise.campaign import load_campaign
    from slipwise.errors import SlipwiseError

    try:
        answer = make(order)
        runs = len(load_campaign(order.folder).runs)
    except SlipwiseError as error:
        return False, f"{order.name}: {error}"
    said = ", ".join(answer["missing"]) or "nothing to name"
    return True, f"{answer['seconds']:6.1f} s  {runs} runs  {order.name:36s} {said}"


def table(answers: dict[str, dict[str, Any]]) -> list[dict[str, Any]]:
    """Give a row for each family and maker."""
    groups: dict[tuple[str, str], list[dict[str, Any]]] = defaultdict(list)
    for answer in answers.values():
        groups[answer["family"], answer["maker"]].append(answer)
    return [
        {
            "family": family,
            "maker": maker,
            "campaigns": len(here),
            "seconds": round(sum(answer["seconds"] for answer in here) / len(here), 1),
            "something to name": sum(bool(answer["missing"]) for answer in here),
            "held out": here[0]["held_out_family"],
        }
        for (family, maker), here in groups.items()
    ]


def main() -> int:
    """Make what is missing, and write the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/families"))
    parser.add_argument("--families", nargs="*", choices=list(FAMILIES), default=list(FAMILIES))
    parser.add_argument("--makers", nargs="*", choices=MAKERS, default=list(MAKERS))
    parser.add_argument("--count", type=int, default=12, help="campaigns of each family and maker")
    parser.add_argument("--first", type=int, default=0, help="place of the first seed: those before were used already")
    parser.add_argument("--workers", type=int, choices=range(1, MOST_WORKERS + 1), default=1, help="processes")
    parser.add_argument("--quick", action="store_true", help="one campaign of the quickest families by each maker")
    chosen = parser.parse_args()

    began = time.perf_counter()
    chosen_families = [FAMILIES[name] for name in (QUICKEST if chosen.quick else chosen.families)]
    wanted = orders(chosen.out, chosen_families, chosen.makers, 1 if chosen.quick else chosen.count, chosen.first)
    left = [order for order in wanted if not is_made(order)]
    print(f"{len(wanted) - len(left)} of {len(wanted)} campaigns are there", flush=True)
    with ProcessPoolExecutor(chosen.workers, get_context("spawn")) as pool:
        jobs = [pool.submit(make_and_read, order) for order in left]
        failed: list[str] = []
        try:
            for number, job in enumerate(as_completed(jobs), start=1):
                good, line = job.result()
                print(f"{number:4d} of {len(left)}  {line}", flush=True)
                failed += [] if good else [line]
        except (KeyboardInterrupt, BrokenProcessPool):
            pool.shutdown(wait=False, cancel_futures=True)
            print("stopped; the same command goes on from here", flush=True)
            return 1
    rows = table(read_answers(chosen.out))
    path = chosen.out / "families.csv"
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    for row in rows:
        print(f"{row['family']:24s} {row['maker']:7s} {row['campaigns']:4d} campaigns of {row['seconds']:5.1f} s")
    print(f"wrote {path}, {time.perf_counter() - began:.0f} s")
    print("\n".join(["could not be made or read:", *failed]) if failed else "all were made and read")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
