"""Kill commands at random moments (kill -9): what is there is whole, no process stays, the same command ends alike.

    python scripts/13_kill.py [--quick] [--kills 100] [--seed 1] [--out out/kill]

Each command is killed again and again in one folder, as a user would start it again, and runs to its end at last. Then
its results must be those of one that nobody disturbed, but for times. After every kill each file of the folder is read;
a hidden file that was being written may stay, which no program can prevent, and is counted.
"""

import argparse
import csv
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import pyarrow.parquet as parquet

from slipwise.model.file import load_model

DEMO = Path(__file__).resolve().parents[1] / "src" / "slipwise" / "demo_data"
QUAKES = ("quake:seed=1,peak=0.5g,strong=2s", "quake:seed=2,peak=0.5g,strong=2s")
#: What a kill leaves to be done: processes end within this time [s].
_GRACE = 10.0
#: Numbers that no two runs have in common, and names that hold them.
_TIMES = re.compile(r"seconds|_s$|took|date|version|host|workers")


@dataclass(frozen=True)
class Command:
    """One command.

    Attributes:
        name: of the command.
        words: arguments; DIR stands for its folder, in which campaigns lie.
        share: of all kills.
    """

    name: str
    words: tuple[str, ...]
    share: float


COMMANDS = (
    Command("replay", ("replay", QUAKES[0], "--out", "DIR/out"), 0.25),
    Command("diagnose", ("diagnose", "DIR/a", "DIR/b", "--out", "DIR/out", "--workers", "2"), 0.15),
    Command("add", ("add", "run_in", "--campaign", "DIR/a"), 0.15),
    Command("ladder", ("ladder", "DIR/a", "--add", "run_in", "--out", "DIR/out"), 0.1),
    Command("paper", ("paper", "--quick", "--out", "DIR/out"), 0.1),
    Command(
        "ensemble", ("ensemble", *QUAKES, "--vary", "rig.mass=9..11t", "--members", "16", "--out", "DIR/out"), 0.25
    ),
)


def prepared(folder: Path) -> Path:
    """Make the folder of a command with two small campaigns in it."""
    for name in ("a", "b"):
        (folder / name).mkdir(parents=True)
        head = (DEMO / "campaign.toml").read_text().partition("[[run]]")[0].replace('"demo"', f'"{name}"')
        runs = {"quake_h": "fit", "quake_hv": "holdout"} if name == "a" else {"quake_hv": "fit", "quake_h": "holdout"}
        tables = [f'[[run]]\nfile = "{run}.parquet"\nrole = "{role}"\n' for run, role in runs.items()]
        (folder / name / "campaign.toml").write_text(head + "\n".join(tables))
        for run in runs:
            shutil.copy(DEMO / f"{run}.parquet", folder / name)
    return folder


def begun(command: Command, folder: Path) -> "subprocess.Popen[bytes]":
    """Start a command in a group of processes of its own."""
    words = [word.replace("DIR", str(folder)) for word in command.words]
    quiet = subprocess.DEVNULL
    return subprocess.Popen(
        [sys.executable, "-m", "slipwise", *words], stdout=quiet, stderr=quiet, start_new_session=True
    )


def left_running(group: int) -> int:
    """Give how many processes of a group run after the grace, and end them."""
    end = time.monotonic() + _GRACE
    while True:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return 0
        if time.monotonic() > end:
            os.killpg(group, signal.SIGKILL)
            return 1
        time.sleep(0.1)


def broken(folder: Path) -> list[str]:
    """Name the files that cannot be read whole; hidden ones are no results."""
    out = []
    for path in (p for p in folder.rglob("*") if p.is_file() and not p.name.startswith(".")):
        try:
            whole(path)
        except Exception as error:
            out.append(f"{path}: {error}")
    return out


def whole(path: Path) -> None:
    """Read a file of a result to its end.

    Raises:
        Exception: it is torn.
    """
    data = path.read_bytes()
    if path.suffix == ".json":
        json.loads(data)
    elif path.suffix == ".jsonl":  # one line for each finished job; the last may be torn, and is cut off
        for line in data.splitlines(keepends=True):
            if line.endswith(b"\n"):
                json.loads(line)
    elif path.suffix == ".parquet":
        parquet.read_table(path)
    elif path.name == "model.toml":
        load_model(path)
    elif path.suffix == ".html" and not data.rstrip().endswith(b"</html>"):
        raise ValueError("the page has no end")
    elif path.suffix == ".png" and b"IEND" not in data[-16:]:
        raise ValueError("the picture has no end")
    elif not data:
        raise ValueError("empty")


def results(folder: Path) -> dict[str, object]:
    """Give what a command has found, without times: numbers of its files, and the names of the others."""
    out: dict[str, object] = {}
    for path in sorted(p for p in folder.rglob("*") if p.is_file() and not p.name.startswith(".")):
        name = str(path.relative_to(folder))
        if path.suffix == ".json":
            out[name] = timeless(json.loads(path.read_bytes()), folder)
        elif path.suffix == ".csv":
            with path.open(newline="") as stream:
                out[name] = [[(k, v) for k, v in row.items() if not _TIMES.search(k)] for row in csv.DictReader(stream)]
        elif path.suffix in (".toml", ".parquet"):
            out[name] = path.read_bytes()
        else:
            out[name] = path.suffix
    return out


def timeless(content: object, folder: Path) -> object:
    """Give the content of a JSON file without times and without the folder's name."""
    if isinstance(content, dict):
        return {k: timeless(v, folder) for k, v in content.items() if not _TIMES.search(k)}
    if isinstance(content, list):
        return [timeless(v, folder) for v in content]
    return content.replace(str(folder), "") if isinstance(content, str) else content


def tried(command: Command, kills: int, out: Path, rng: random.Random) -> list[str]:
    """Kill a command so often; give everything that is wrong."""
    undisturbed = prepared(out / command.name / "undisturbed")
    began = time.monotonic()
    if begun(command, undisturbed).wait() != 0:
        return [f"{command.name} does not run"]
    lasts, wrong, hits = time.monotonic() - began, list[str](), 0
    folder = prepared(out / command.name / "killed")
    while hits < kills:
        process = begun(command, folder)
        try:
            process.wait(rng.uniform(0.0, lasts))
            shutil.rmtree(folder)  # it was done before: once more from the beginning
            prepared(folder)
            continue
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            hits += 1
        wrong += [f"kill {hits}: {words}" for words in broken(folder)]
        wrong += [f"kill {hits}: a process ran on"] * left_running(process.pid)
    hidden = sum(p.name.startswith(".") for p in folder.rglob("*"))
    before, after = results(undisturbed), results(folder)
    if before != after:  # the last kill may have come when all was written
        if (code := begun(command, folder).wait()) != 0:
            wrong.append(f"the last run ended with {code}")
        after = results(folder)
    wrong += [f"{name} differs" for name in sorted({*before, *after}) if before.get(name) != after.get(name)]
    print(f"{command.name:9s} {lasts:5.1f} s, {hits} kills, {hidden} hidden files, {len(wrong)} wrong", flush=True)
    return [f"{command.name}: {words}" for words in wrong]


def main() -> int:
    """Kill every command; 1 if anything was lost."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="two kills of a replay only")
    parser.add_argument("--kills", type=int, default=100, help="of all commands together")
    parser.add_argument("--seed", type=int, default=1, help="of the moments")
    parser.add_argument("--only", help="one command")
    parser.add_argument("--out", type=Path, default=Path("out/kill"))
    given = parser.parse_args()
    shutil.rmtree(given.out, ignore_errors=True)
    rng, wrong = random.Random(given.seed), list[str]()
    chosen = COMMANDS[:1] if given.quick else [c for c in COMMANDS if given.only in (None, c.name)]
    for command in chosen:
        wrong += tried(command, 2 if given.quick else round(given.kills * command.share), given.out.resolve(), rng)
    print("\n".join(wrong) or "nothing was lost")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
