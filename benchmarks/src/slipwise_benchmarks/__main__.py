"""Make campaigns with hidden effects, and score what a tool says of them.

python -m slipwise_benchmarks make clean 991000 10 --out out/blind
python -m slipwise_benchmarks score out/blind --verdicts out/blind/verdicts
"""

import argparse
import json
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from slipwise_benchmarks.families import FAMILIES, MAKERS
from slipwise_benchmarks.family_store import Order, is_made, make, read_answers
from slipwise_benchmarks.verdicts import UnusableVerdict, find_strays, score_folder, table


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one of the two commands; 2 where what was given cannot be used."""
    chosen = _parser().parse_args(arguments)
    try:
        return _make(chosen) if chosen.command == "make" else _score(chosen)
    except (UnusableVerdict, ModuleNotFoundError, OSError) as error:
        print(error, file=sys.stderr)
        return 2


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "slipwise-benchmarks", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(dest="command", required=True)
    words = "\n".join(f"  {family.name:24s} {family.words}" for family in FAMILIES.values())
    written = "FOLDER/campaigns/NAME is what a tool reads, FOLDER/answers/NAME.json its key."
    making = commands.add_parser(
        "make",
        help="write campaigns, and their answer keys apart",
        description=f"{written}\n\nfamilies:\n{words}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    making.add_argument("family", metavar="FAMILY", choices=list(FAMILIES))
    making.add_argument("seed", metavar="SEED", type=partial(_whole, least=0), help="of the first; 0 or more")
    making.add_argument("number", metavar="N", type=partial(_whole, least=1), help="campaigns; seeds follow each other")
    making.add_argument("--out", metavar="FOLDER", type=Path, required=True)
    making.add_argument("--maker", choices=MAKERS, default="ode", help="replay needs the package slipwise")
    scoring = commands.add_parser("score", help="score one JSON file for each campaign")
    scoring.add_argument("folder", metavar="FOLDER", type=Path, help="that `make` wrote to")
    scoring.add_argument("--verdicts", metavar="DIR", type=Path, help="of NAME.json; FOLDER/verdicts otherwise")
    scoring.add_argument("--list", action="store_true", help="print every campaign: what was absent or missed")
    scoring.add_argument("--json", action="store_true", help="print the scores of every campaign for a program")
    return parser


def _whole(text: str, least: int) -> int:
    if not text.isdecimal() or int(text) < least:
        raise argparse.ArgumentTypeError(f"it is {text!r}; write a whole number from {least} on")
    return int(text)


def _make(chosen: argparse.Namespace) -> int:
    family = FAMILIES[chosen.family]
    depends_on = family.depends_on(chosen.maker)
    for seed in range(chosen.seed, chosen.seed + chosen.number):
        order = Order(chosen.out, family.name, chosen.maker, seed, depends_on)
        if not is_made(order):
            make(order)
        print(order.folder, flush=True)
    print(f"answer keys: {chosen.out / 'answers'}; next: write {chosen.out / 'verdicts'}/NAME.json and score")
    return 0


def _score(chosen: argparse.Namespace) -> int:
    if not chosen.folder.is_dir():
        raise UnusableVerdict(f"there is no folder {chosen.folder}; `make` writes one")
    answers, verdicts = read_answers(chosen.folder), chosen.verdicts or chosen.folder / "verdicts"
    if not answers:
        raise UnusableVerdict(f"{chosen.folder}/answers has no answer key; make campaigns with --out {chosen.folder}")
    scored = score_folder(answers, verdicts)
    for name in find_strays(answers, verdicts):
        print(f"passed over {verdicts / name}: there is no campaign of that name", file=sys.stderr)
    if chosen.json:
        print(json.dumps({name: vars(one) for name, one in scored.items()}, indent=1))
        return 0
    for name, one in scored.items() if chosen.list else ():
        absent, missing = ", ".join(one.absent) or "-", ", ".join(one.missed) or "-"
        listed = f"  listed, not there: {', '.join(one.listed_absent)}" if one.listed_absent else ""
        print(f"{name:36s} {'right' if one.right else 'wrong'}  absent: {absent}  missed: {missing}{listed}")
    print("\n".join(table(list(scored.values()), len(answers))))
    return 0


if __name__ == "__main__":
    sys.exit(main())
