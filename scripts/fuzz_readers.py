"""Damage files of every format at random: each is read, or refused in words; anything else is printed and counted.

python scripts/fuzz_readers.py --seconds 60 --seed 1
"""

import argparse
import logging
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from slipwise.campaign.table import open_table  # noqa: E402
from slipwise.errors import SlipwiseError  # noqa: E402
from slipwise.motion.detect import detect  # noqa: E402
from slipwise.motion.source_file import source_of  # noqa: E402
from slipwise.motion.stated import Given  # noqa: E402
from unit.motion import agency_samples, samples  # noqa: E402  # pyright: ignore[reportMissingImports]

_PIECES = [
    b"", b"-", b".", b"9", b"0", b" ", b"\n", b"\r", b",", b";", b"\t", b"E", b"nan", b"\x00", b"\xff", b"(", b"]",
    b"g", b"gal", b"1e999", b"99999999999", b"NPTS", b'"', b"\xe2\x88\x92", b"m**9**9", b"12:00:00",
]  # fmt: skip
#: Longer than this is too long for a small file [s].
_SLOW = 10.0


def damaged(data: bytes, rng: np.random.Generator) -> bytes:
    """Cut, repeat and overwrite a few places of a file."""
    for _ in range(int(rng.integers(1, 5))):
        at, gone = int(rng.integers(0, len(data) + 1)), int(rng.integers(0, 12))
        kind = int(rng.integers(0, 4))
        if kind == 0:
            data = data[: max(at, 1)]
        elif kind == 1:
            data = data[:at] + data[at : at + 200] + data[at:]
        else:
            put = _PIECES[int(rng.integers(len(_PIECES)))] if kind == 2 else rng.bytes(int(rng.integers(1, 5)))
            data = data[:at] + put + data[at + gone :]
    return data


def read_motion(data: bytes) -> None:
    """Read a motion as `replay` does."""
    source = source_of("fuzz.txt", "fuzz", data)
    detect(source).read(source, Given(dt=0.01, unit="gal") if len(data) % 2 else Given())


def read_table(path: Path, data: bytes) -> None:
    """Read a data file as a campaign does."""
    path.write_bytes(data)
    table = open_table(path)
    table.columns(range(min(len(table.headers), 6)))


def tables(folder: Path) -> dict[str, bytes]:
    """One small data file of each kind that the installed extras can write."""
    from scipy.io import savemat

    from slipwise.record import Record, write_record

    step = np.arange(60, dtype=np.float64) * 0.01
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


def main() -> int:
    """Damage and read until the time is over; 1 if anything but a refusal in words was met."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    rng = np.random.default_rng(given.seed)
    warnings.simplefilter("ignore")
    logging.disable()
    motions = list((samples.every_format() | agency_samples.every_agency()).values())
    count, refused, slow = 0, 0, 0.0
    failures: dict[str, str] = {}
    with tempfile.TemporaryDirectory() as name:
        files = list(tables(Path(name)).items())
        end = time.perf_counter() + given.seconds
        while time.perf_counter() < end:
            began = time.perf_counter()
            kind = "motion"
            try:
                if count % 4:
                    read_motion(damaged(motions[int(rng.integers(len(motions)))], rng))
                else:
                    kind, data = files[int(rng.integers(len(files)))]
                    read_table(Path(name) / f"fuzz_{kind}", damaged(data, rng))
            except SlipwiseError:
                refused += 1
            except Exception as error:
                place = traceback.extract_tb(error.__traceback__)[-1]
                failures.setdefault(f"{kind}: {type(error).__name__} at {place.filename}:{place.lineno}", str(error))
            slow = max(slow, time.perf_counter() - began)
            count += 1
    print(f"{count} damaged files, {refused} refused in words, the slowest took {slow:.2f} s")
    for where, words in failures.items():
        print(f"FAILED {where}: {words[:200]}")
    return 1 if failures or slow > _SLOW else 0


if __name__ == "__main__":
    sys.exit(main())
