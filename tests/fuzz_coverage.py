"""Damage files led by the lines of code that they reach (atheris, libFuzzer), one kind of file after another.

    pip install atheris
    python tests/fuzz_coverage.py --seconds 60
    python tests/fuzz_coverage.py --only campaign.toml --seconds 3600

Each file is read, or refused in words; anything else ends the run of its kind, and libFuzzer writes the file to
OUT/NAME/. What is found interesting is kept there too, so that a later run goes on from it.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import warnings
from importlib import import_module
from pathlib import Path
from typing import Any


def fuzz(name: str, kept: Path, seconds: int) -> None:
    """Damage one kind of file in this process, which ends with it."""
    atheris: Any = import_module("atheris")
    with atheris.instrument_imports(include=["slipwise"]):
        from fuzzing import targets
    from slipwise.errors import SlipwiseError

    warnings.simplefilter("ignore")
    target = next(t for t in targets(Path(tempfile.mkdtemp())) if t.path.name == name)
    (kept / "whole").write_bytes(target.data)

    def one(data: bytes) -> None:
        try:
            target.try_with(data)
        except SlipwiseError:
            pass

    limits = [f"-max_total_time={seconds}", "-timeout=10", "-rss_limit_mb=3000", f"-max_len={4 * len(target.data)}"]
    atheris.Setup([sys.argv[0], str(kept), f"-artifact_prefix={kept}{os.sep}", *limits], one)
    atheris.Fuzz()


def main() -> int:
    """Damage every kind of file, each in a process of its own; 1 if one met anything but a refusal in words."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/fuzz"))
    parser.add_argument("--seconds", type=int, default=60, help="for each kind of file")
    parser.add_argument("--only", help="name of one kind, e.g. campaign.toml")
    parser.add_argument("--this", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.this:
        fuzz(given.only, given.out / given.only, given.seconds)
    from fuzzing import targets

    with tempfile.TemporaryDirectory() as folder:
        names = [t.path.name for t in targets(Path(folder))]
    failed = []
    for name in [given.only] if given.only else names:
        (given.out / name).mkdir(parents=True, exist_ok=True)
        command = [sys.executable, __file__, "--this", "--only", name, "--out", str(given.out)]
        ended = subprocess.run([*command, "--seconds", str(given.seconds)], capture_output=True, text=True)
        runs = next((line for line in reversed(ended.stderr.splitlines()) if line.startswith("Done ")), "")
        print(f"{name:20s} {runs or ended.stderr[-600:]}")
        failed += [name] if ended.returncode else []
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
