"""Make campaigns with hidden effects, blind, with the second simulator of `tests/bench`.

    python scripts/make_bench.py out_bench --count 300 --seed 1000
    python scripts/make_bench.py out_bench --effects run_in key_friction --size medium

Campaigns go to OUT/campaigns/NAME, answers to OUT/truth/NAME.json, where a diagnosis of the campaigns cannot read
them. Campaigns that have their answer already are kept, so an interrupted run goes on where it stopped.
"""

import argparse
import sys
import time
from pathlib import Path


def main(arguments: list[str] | None = None) -> int:
    """Read the command line and write the campaigns."""
    sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
    from bench import SIZES, Case, make_campaign, plan, write_truth  # pyright: ignore[reportMissingImports]

    parser = argparse.ArgumentParser(description="Make campaigns with hidden effects.")
    parser.add_argument("out", type=Path, help="folder for campaigns/ and truth/")
    parser.add_argument("--count", type=int, default=36, help="campaigns of the even plan (a third complete)")
    parser.add_argument("--seed", type=int, default=1000, help="seed of the plan and of the first campaign")
    parser.add_argument("--effects", nargs="*", help="hide these in every campaign instead; none given: nothing")
    parser.add_argument("--size", choices=list(SIZES), help="of those effects")
    parser.add_argument("--rig", choices=["bridge1", "bridge2"], help="always this rig")
    parser.add_argument("--rich", action="store_true", help="motion across and more gauges in every campaign")
    parser.add_argument("--quick", action="store_true", help="three campaigns only")
    chosen = parser.parse_args(arguments)

    count = 3 if chosen.quick else chosen.count
    cases = plan(count, chosen.seed)
    if chosen.effects is not None:
        cases = [Case(tuple(chosen.effects), chosen.size or "medium", chosen.rich)] * count
    start = time.perf_counter()
    for number, case in enumerate(cases):
        name = f"b{chosen.seed + number:05d}"
        answer = chosen.out / "truth" / f"{name}.json"
        if answer.exists():
            continue
        truth = make_campaign(
            chosen.out / "campaigns" / name,
            chosen.seed + number,
            effects=case.effects,
            size=chosen.size or case.size,
            rig=chosen.rig,
            rich=chosen.rich or case.rich,
        )
        write_truth(answer, truth.as_dict())
        said = ", ".join(truth.missing) or "complete"
        print(f"{name}  {truth.rig}  {said}  {truth.size}  {truth.size_in_floors:.1f} floors", flush=True)
    print(f"{len(cases)} campaigns in {chosen.out}, {time.perf_counter() - start:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
