"""Damage files of every format at random: each is read, or refused in words; anything else is printed and counted.

A child process does the reading with bounded memory, so that a file that asks for gigabytes is counted as well, and one
that brings the process down is written to the folder of the results.

python scripts/fuzz_readers.py --seconds 60 --seed 1
python scripts/fuzz_readers.py --count 100000
"""

import argparse
import io
import logging
import multiprocessing
import resource
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from slipwise.campaign.draft import draft_campaign  # noqa: E402
from slipwise.campaign.table import open_table  # noqa: E402
from slipwise.errors import SlipwiseError  # noqa: E402
from slipwise.motion.load import load_motion  # noqa: E402
from unit.motion import agency_samples, samples  # noqa: E402  # pyright: ignore[reportMissingImports]

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


def read_motion(path: Path, data: bytes) -> None:
    """Read a motion as `replay` does, with the step and unit that a refusal asks for."""
    path.write_bytes(data)
    try:
        load_motion(path)
    except SlipwiseError as error:
        asked: dict[str, Any] = {"--motion-dt": {"dt": 0.01}, "--unit": {"unit": "gal"}}
        given = {key: value for flag, pair in asked.items() if flag in str(error) for key, value in pair.items()}
        if not given:
            raise
        load_motion(path, **{"dt": 0.01, "unit": "gal"} if len(given) == 1 and "dt" in given else given)


def read_table(path: Path, data: bytes) -> None:
    """Read a data file as a campaign does, and draft a campaign from it."""
    path.write_bytes(data)
    table = open_table(path)
    table.columns(range(min(len(table.headers), 6)))
    draft_campaign(path.parent)


def tables(folder: Path) -> dict[str, bytes]:
    """One small data file of each kind that the installed extras can write."""
    from scipy.io import savemat

    from slipwise.record import Record, write_record

    step = np.arange(300, dtype=np.float64) * 0.01
    rows = "".join(f"{t:.2f}\t{np.sin(t):.4f}\t{np.cos(t):.4f}\n" for t in step)
    stamps = "".join(f"2031-02-03 10:15:{t:05.2f},{np.sin(t):.4f},{np.cos(t):.4f}\n" for t in step)
    found = {
        "a.txt": f"Sample rate\t100 Hz\n\nTime\tSlip\tForce\ns\tmm\tkN\n{rows}".encode(),
        "b.csv": f'"TOA5","R"\n"TIMESTAMP","Slip","Load"\n"TS","mm","kN"\n{stamps}'.encode(),
        "c.dat": f"MTS793\n\nTime\tSlip\tForce\n{rows}\nTime\tSlip\tForce\n{rows}".encode(),
        "d.lvm": f"LabVIEW Measurement\t\nX_Value\tA\tB\tComment\n{rows}".encode(),
        "e.csv": f"Zeit;Weg;Kraft\n{rows.replace('.', ',').replace(chr(9), ';')}".encode("utf-16"),
    }
    savemat(folder / "f.mat", {"t": step, "s": {"x": np.stack([step, step])}}, do_compression=True)
    write_record(Record(step, {"slip_x": np.sin(step)}), folder / "g.parquet")
    try:
        from openpyxl import Workbook

        book = Workbook()
        for row in [["Time [s]", "Slip [mm]"], *[[float(t), float(np.sin(t))] for t in step]]:
            book.active.append(row)  # type: ignore[union-attr]
        book.save(folder / "h.xlsx")
    except ModuleNotFoundError:
        print("openpyxl is not installed: no workbook is damaged")
    try:
        from nptdms import ChannelObject, TdmsWriter  # type: ignore[import-not-found]

        with TdmsWriter(str(folder / "i.tdms")) as writer:
            writer.write_segment([ChannelObject("Rig", "Slip", np.sin(step), {"wf_increment": 0.01})])
    except ModuleNotFoundError:
        print("npTDMS is not installed: no .tdms file is damaged")
    written = [p for p in folder.iterdir() if p.suffix in (".mat", ".parquet", ".xlsx", ".tdms")]
    return found | {path.name: path.read_bytes() for path in written}


def seismograms() -> list[bytes]:
    """SAC and miniSEED, where obspy is installed."""
    try:
        import obspy  # type: ignore[import-untyped]
    except ModuleNotFoundError:
        print("obspy is not installed: no SAC and no miniSEED file is damaged")
        return []
    out = []
    for kind in ("SAC", "MSEED"):
        values = np.sin(0.1 * np.arange(300.0)).astype(np.float32)
        trace = obspy.Trace(values, {"delta": 0.01, "channel": "HNE", "station": "TST"})
        file = io.BytesIO()
        trace.write(file, format=kind)
        out.append(file.getvalue())
    return out


def _peak() -> int:
    """Largest memory of this process so far [bytes]."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def fuzz(seed: int, seconds: float, count: int, folder: Path, results: "multiprocessing.SimpleQueue") -> None:
    """Damage and read until the time or the count is over; in a child process of its own."""
    warnings.simplefilter("ignore")
    logging.disable()
    rng = np.random.default_rng(seed)
    motions = list((samples.every_format() | agency_samples.every_agency()).values()) + seismograms()
    files = list(tables(folder).items())
    alone = folder / "alone"
    alone.mkdir()
    for data in motions:  # imports and caches are not the files' memory
        try:
            read_motion(folder / "motion.txt", data)
        except SlipwiseError:
            pass
    resource.setrlimit(resource.RLIMIT_AS, (_ADDRESSES, _ADDRESSES))
    began_with, done, refused, slow = _peak(), 0, 0, 0.0
    failures: dict[str, str] = {}
    end = time.perf_counter() + seconds
    while done < count and time.perf_counter() < end:
        began, before = time.perf_counter(), _peak()
        if done % 4:
            number = int(rng.integers(len(motions)))
            kind, data = f"motion {number}", damaged(motions[number], rng)
        else:
            kind, data = files[int(rng.integers(len(files)))]
            data = damaged(data, rng)
        last = folder / "motion.txt" if done % 4 else alone / kind
        (folder / "last").write_text(str(last))
        try:
            read_motion(last, data) if done % 4 else read_table(last, data)
        except SlipwiseError:
            refused += 1
        except Exception as error:
            place = traceback.extract_tb(error.__traceback__)[-1]
            failures.setdefault(f"{kind}: {type(error).__name__} at {place.filename}:{place.lineno}", str(error))
        spent = time.perf_counter() - began
        slow = max(slow, spent)
        if spent > _SLOW:
            failures.setdefault(f"{kind}: slow", f"{spent:.1f} s")
        if _peak() - before > _MEMORY:
            failures.setdefault(f"{kind}: memory", f"{(_peak() - before) / 2**30:.2f} GB")
        if not done % 4:
            last.unlink()
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
            kept.write_bytes(Path((Path(name) / "last").read_text()).read_bytes())
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
