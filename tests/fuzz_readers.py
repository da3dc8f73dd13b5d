"""Damage files of every format at random: each is read, or refused in words; anything else is printed and counted.

Motions, data files, campaign.toml, model.toml with an effect file beside it that must not run, and MJCF files of rigs.
A child process does the reading with bounded memory, so that a file that asks for gigabytes is counted as well. What
fails is kept as fuzz_N_NAME in the folder from which this is called.

python tests/fuzz_readers.py --seconds 60 --seed 1
python tests/fuzz_readers.py --count 100000
"""

import argparse
import logging
import multiprocessing
import resource
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path

import numpy as np

from fuzzing import targets
from slipwise.errors import SlipwiseError

_PIECES = [
    b"", b"-", b".", b"9", b"0", b" ", b"\n", b"\r", b",", b";", b"\t", b"E", b"nan", b"\x00", b"\xff", b"(", b"]",
    b"g", b"gal", b"1e999", b"99999999999", b"NPTS", b'"', b"\xe2\x88\x92", b"m**9**9", b"12:00:00",
]  # fmt: skip
#: Longer than this is too long for a small file [s]; more memory than this is too much [bytes].
_SLOW, _MEMORY = 10.0, 1 << 30
#: What a child may take before the system refuses: libraries and their threads reserve more than they use [bytes].
_ADDRESSES = 8 << 30


def damaged(data: bytes, rng: np.random.Generator) -> bytes:
    """Cut, repeat and overwrite a few places of a file."""
    for _ in range(int(rng.integers(1, 3))):
        # headers are short and matter most
        end = len(data) if rng.random() < 0.5 else min(len(data), 900)
        at, gone = int(rng.integers(0, end + 1)), int(rng.integers(0, 6))
        kind = int(rng.integers(0, 10))
        if kind == 0:
            data = data[: max(at, 1)]
        elif kind == 1:
            data = data[:at] + data[at : at + 200] + data[at:]
        else:
            put = _PIECES[int(rng.integers(len(_PIECES)))] if kind < 7 else rng.bytes(int(rng.integers(1, 5)))
            data = data[:at] + put + data[at + gone :]
    return data


def _peak() -> int:
    """Largest memory of this process so far [bytes]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def fuzz(seed: int, seconds: float, count: int, folder: Path, results: "multiprocessing.SimpleQueue") -> None:
    """Damage and read until the time or the count is over; in a child process of its own."""
    warnings.simplefilter("ignore")
    logging.disable()
    rng = np.random.default_rng(seed)
    found = targets(folder)
    kinds = sorted({t.path.name.partition("_")[0] for t in found})
    by_kind = {k: [t for t in found if t.path.name.partition("_")[0] == k] for k in kinds}
    for target in found:  # imports and caches are not the files' memory
        try:
            target.try_with(target.data)
        except SlipwiseError:
            pass
    resource.setrlimit(resource.RLIMIT_AS, (_ADDRESSES, _ADDRESSES))
    began_with, done, refused, slow = _peak(), 0, 0, 0.0
    failures: dict[str, str] = {}
    kept = 0
    end = time.perf_counter() + seconds
    while done < count and time.perf_counter() < end:
        # half of the files are motions, of which there are most formats
        kind = "motion" if done % 2 else kinds[int(rng.integers(len(kinds)))]
        target = by_kind[kind][int(rng.integers(len(by_kind[kind])))]
        data = damaged(target.data, rng)
        (folder / "last").write_bytes(data)
        began, before = time.process_time(), _peak()  # another program's time is not the reader's
        try:
            target.try_with(data)
        except SlipwiseError:
            refused += 1
        except (Exception, SystemExit) as error:
            place = traceback.extract_tb(error.__traceback__)[-1]
            failures.setdefault(f"{kind}: {type(error).__name__} at {place.filename}:{place.lineno}", str(error))
        spent, more = time.process_time() - began, _peak() - before
        slow = max(slow, spent)
        if spent > _SLOW:
            failures.setdefault(f"{kind}: slow", f"{spent:.1f} s")
        if more > _MEMORY:
            failures.setdefault(f"{kind}: memory", f"{more / 2**30:.2f} GB")
        if len(failures) > kept:
            kept = len(failures)
            Path(f"fuzz_{kept}_{target.path.name}").write_bytes(data)
        done += 1
    results.put((done, refused, slow, _peak() - began_with, failures))


def main() -> int:
    """Damage and read until the time or the count is over; 1 if anything but a refusal in words was met."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--count", type=int, default=0, help="so many files, however long it takes")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    seconds, count = (1e9, given.count) if given.count else (given.seconds, 10**9)
    results = multiprocessing.SimpleQueue()
    with tempfile.TemporaryDirectory() as name:
        child = multiprocessing.Process(target=fuzz, args=(given.seed, seconds, count, Path(name), results))
        child.start()
        child.join()
        if results.empty():
            kept = Path("fuzz_input")
            kept.write_bytes((Path(name) / "last").read_bytes())
            print(f"FAILED: the reading process died with {child.exitcode}; what it read last is in {kept}")
            return 1
    done, refused, slow, memory, failures = results.get()
    print(
        f"{done} damaged files, {refused} refused in words, the slowest took {slow:.2f} s, all together "
        f"{memory / 2**20:.0f} MB"
    )
    for where, words in failures.items():
        print(f"FAILED {where}: {words[:200]}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
