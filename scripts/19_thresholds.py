"""Move every number by which a diagnosis decides by 30 %, and count the verdicts that turn.

    python scripts/16_families.py --out out/families --count 3
    python scripts/19_thresholds.py --campaigns out/families/campaigns
    python scripts/19_thresholds.py --campaigns out/families/campaigns --only selection. evidence. --on clean dirty
    python scripts/19_thresholds.py --campaigns out/families/campaigns --store "families, 3 of each"
    python scripts/19_thresholds.py --update
    python scripts/19_thresholds.py --quick

`scripts/thresholds.py` says what is such a number, and how far it is moved. Each is made 1.3 and 0.7 times as large in
a copy of the library, by which a process of its own diagnoses the campaigns: what is computed from the number moves
with it. A verdict turns where its kind or its names are others, or where there is none any more. A number that nothing
reads while a campaign is diagnosed is not moved there, for it turns nothing.

Every verdict is one line of OUT/turned.jsonl, and the same command goes on where it stopped; when the code has changed,
another OUT begins anew. `--store` writes what was counted so far into tests/thresholds.json, beside the words that name
the bench; `scripts/make_docs.py` makes docs/thresholds.md of it. `--update` brings that table in line with the code: a
number that is new there waits for its unit, how it scales, and what it stands on.
"""

import argparse
import ast
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Collection, Iterator
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

from slipwise_benchmarks.families import FAMILIES
from slipwise_benchmarks.family_store import make, orders
from thresholds import (
    ROOT,
    find_statements,
    in_line_with_code,
    moved,
    read_table,
    with_value,
    write_table,
)

#: What `--quick` moves once, on one campaign of a single slider.
QUICK = ("evidence.decision.EVEN_ODDS", "preparation.dead_cells._UNSEEN_WARP")
#: Where a module compiles functions, what they read is not seen.
COMPILES = "machine_code import kept"
Row = dict[str, Any]
#: Verdicts by name of the number ("" where none is moved), factor and campaign.
Rows = dict[tuple[str, float, str], Row]
#: Where a user would see an error.
FAILED: Row = {"kind": "failed", "names": [], "mentioned": []}


def print_verdicts(folders: list[Path], mention: bool) -> None:
    """Diagnose campaigns, and print a line for each: kind, names, probability.

    Args:
        folders: of the campaigns.
        mention: print what the library's functions that were called mention too, as module and name.
    """
    from slipwise.diagnosis.diagnose import diagnose
    from slipwise.errors import SlipwiseError

    called: set[tuple[str, CodeType]] = set()

    def note(frame: FrameType, event: str, argument: object) -> None:
        module = frame.f_globals.get("__name__") or ""
        if module.startswith("slipwise.") and frame.f_code.co_name != "<module>":
            called.add((module, frame.f_code))

    for folder in folders:
        called.clear()
        if mention:
            threading.settrace(note)
            sys.settrace(note)
        try:
            said = diagnose(folder).verdict
            row = {"kind": said.kind, "names": sorted(said.effects), "probability": round(said.probability, 3)}
        except SlipwiseError as error:
            row = {**FAILED, "words": str(error)}
        sys.settrace(None)
        mentioned = sorted({f"{module}.{name}" for module, code in called for name in code.co_names})
        print(json.dumps({"campaign": folder.name, **row, "mentioned": mentioned}), flush=True)


def verdicts(library: Path, folders: list[Path], *options: str) -> Iterator[Row]:
    """Yield what a library in some folder says of each campaign; "failed" of those at which its process ends."""
    order = [sys.executable, __file__, *options, "--diagnose", *map(str, folders)]
    environment = {**os.environ, "PYTHONPATH": str(library)}
    done = subprocess.run(order, env=environment, capture_output=True, text=True, check=False)
    rows = {row["campaign"]: row for row in map(json.loads, done.stdout.splitlines())}
    words = (done.stderr.strip().splitlines() or ["ended without a word"])[-1]
    for folder in folders:
        yield rows.get(folder.name) or {"campaign": folder.name, **FAILED, "words": words}


def read_unseen(library: Path) -> dict[str, set[str]]:
    """Return module -> names that it reads without a call: when it is loaded, or in functions that are compiled."""
    found: dict[str, set[str]] = {}
    for file in library.rglob("*.py"):
        text = file.read_text(encoding="utf-8")
        left: list[ast.AST] = [ast.parse(text)]
        names: set[str] = set()
        while left:
            node = left.pop()
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
                names.add(node.id)
            if isinstance(node, ast.FunctionDef) and COMPILES not in text:
                left += [node.args, *node.decorator_list]
            else:
                left += ast.iter_child_nodes(node)
        found[".".join(file.relative_to(library).with_suffix("").parts)] = names
    return found


def is_read(name: str, mentioned: Collection[str], unseen: dict[str, set[str]]) -> bool:
    """Say whether a number may have been read while a campaign was diagnosed.

    Args:
        name: of a `thresholds.Statement`.
        mentioned: of `print_verdicts`.
        unseen: of `read_unseen`.
    """
    module, _, last = f"slipwise.{name}".rpartition(".")
    if module not in unseen:  # a field of a dataclass
        return True
    modules = [module] if last.startswith("_") else unseen
    return any(f"{one}.{last}" in mentioned or last in unseen[one] for one in modules)


def turned(statements: list[Any], factors: list[float], folders: list[Path], rows: Rows) -> Iterator[Row]:
    """Yield verdicts that are not there yet: as the library is, and with one number moved.

    Args:
        statements: `thresholds.Statement` of each number that is moved.
        factors: by which.
        folders: of the campaigns.
        rows: verdicts that are there.
    """
    scales = {name: row["scales"] for name, row in read_table().items()}
    with tempfile.TemporaryDirectory() as place:
        library = Path(place) / "src"
        for folder in ("src", "models"):
            shutil.copytree(ROOT / folder, library.parent / folder, ignore=shutil.ignore_patterns("__pycache__"))
        unseen = read_unseen(library)
        new = [folder for folder in folders if ("", 1.0, folder.name) not in rows]
        for row in verdicts(library, new, "--mention") if new else ():
            if not (mentioned := set(row.pop("mentioned"))):
                raise SystemExit(f"{row['campaign']}: {row['words']}")
            reads = [name for name in scales if is_read(name, mentioned, unseen)]
            yield {"threshold": "", "factor": 1.0, **row, "reads": reads}
        for one in statements:
            reading = [folder for folder in folders if one.name in rows["", 1.0, folder.name]["reads"]]
            for factor in factors:
                missing = [folder for folder in reading if (one.name, factor, folder.name) not in rows]
                if not missing:
                    continue
                file = library / one.file
                text = file.read_text(encoding="utf-8")
                value = moved(one.value, factor, scales[one.name])
                file.write_text(with_value(text, one, value), encoding="utf-8")
                for row in verdicts(library, missing):
                    del row["mentioned"]
                    yield {"threshold": one.name, "factor": factor, "value": value, **row}
                file.write_text(text, encoding="utf-8")


def counts(statements: list[Any], factors: list[float], folders: list[Path], rows: Rows) -> dict[str, Row]:
    """Return for every number that was moved at all campaigns: how many of how many verdicts turned, and read it."""
    as_is = [rows["", 1.0, folder.name] for folder in folders]
    out: dict[str, Row] = {}
    for one in statements:
        pairs = [(was, (one.name, factor)) for was in as_is if one.name in was["reads"] for factor in factors]
        if all((*key, was["campaign"]) in rows for was, key in pairs):
            now = [(was, rows[(*key, was["campaign"])]) for was, key in pairs]
            differ = sum((was["kind"], was["names"]) != (new["kind"], new["names"]) for was, new in now)
            out[one.name] = {"turned": differ, "read": len(now), "of": len(folders) * len(factors)}
    return out


def main() -> None:
    """Move what is not moved yet, and say what turns."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--campaigns", type=Path, help="a folder of campaigns")
    parser.add_argument("--on", nargs="*", default=[""], help="campaigns whose names begin so")
    parser.add_argument("--only", nargs="*", default=[""], help="numbers whose names begin so, in this order")
    parser.add_argument("--factors", type=float, nargs="*", default=[1.3, 0.7])
    parser.add_argument("--out", type=Path, default=Path("out/thresholds"))
    parser.add_argument("--store", metavar="BENCH", help="write what was counted into the table, and move nothing")
    parser.add_argument("--update", action="store_true", help="list the numbers of the code in the table, and end")
    parser.add_argument("--quick", action="store_true", help="make one campaign, and move two numbers once")
    parser.add_argument("--diagnose", type=Path, nargs="+", help="print the verdicts of these campaigns, and end")
    parser.add_argument("--mention", action="store_true", help="with --diagnose: print what was read for them too")
    chosen = parser.parse_args()
    if chosen.diagnose:
        print_verdicts(chosen.diagnose, chosen.mention)
        return

    if chosen.update:
        write_table(in_line_with_code(read_table()))
        return
    if chosen.quick:
        chosen.campaigns, chosen.only, chosen.factors = chosen.out / "campaigns", QUICK, [1.3]
        for order in orders(chosen.out, [FAMILIES["tribometers"]], ["ode"], 1):
            make(order)
    if not chosen.campaigns:
        parser.error("--campaigns is missing: a folder of campaigns, which scripts/16_families.py makes")
    table = read_table()
    known = [one for one in find_statements() if table[one.name]["scales"] != "definition"]
    statements = list(dict.fromkeys(one for only in chosen.only for one in known if one.name.startswith(only)))
    found = sorted(file.parent for file in chosen.campaigns.glob("*/campaign.toml"))
    folders = [folder for folder in found if folder.name.startswith(tuple(chosen.on))]
    chosen.out.mkdir(parents=True, exist_ok=True)
    path = chosen.out / "turned.jsonl"
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    rows = {(row["threshold"], row["factor"], row["campaign"]): row for row in map(json.loads, lines)}
    if chosen.store and any(("", 1.0, folder.name) not in rows for folder in folders):
        parser.error(f"{path} has no verdicts of all these campaigns; measure first, without --store")
    if not chosen.store:
        with path.open("a", encoding="utf-8") as stream:
            for row in turned(statements, chosen.factors, folders, rows):
                rows[row["threshold"], row["factor"], row["campaign"]] = row
                print(json.dumps(row), file=stream, flush=True)
    counted = counts(statements, chosen.factors, folders, rows)
    for name, count in sorted(counted.items(), key=lambda pair: -pair[1]["turned"]):
        print(f"{name:44s} {count['turned']:4d} of {count['of']} verdicts turn, {count['read']} read it")
    if chosen.store:
        write_table({name: {**row, **_stored(counted.get(name), chosen.store)} for name, row in table.items()})


def _stored(count: Row | None, bench: str) -> Row:
    return {**count, "bench": bench} if count else {}


if __name__ == "__main__":
    main()
