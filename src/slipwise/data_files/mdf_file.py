"""MDF files (.mf4, .mdf) of ASAM, which most data acquisition of vehicles and machines writes; read by asammdf."""

import mmap
import struct
from pathlib import Path

import numpy as np

from slipwise.data_files.named_columns import NamedColumns, NamedGauge, of_gauges, unreadable
from slipwise.errors import InputError, missing_library

#: What a file begins with: one that was closed, and one that was not.
_MARKS = (b"MDF     ", b"UnFinMF ")
#: Where the first block of version 4 stands, and bytes before a block's links: mark, length, number of links.
_FIRST_BLOCK, _BLOCK_HEAD = 64, 24


def read_mdf(path: Path) -> NamedColumns:
    """Read every channel of numbers with its unit; times come from each group's master.

    Raises:
        InputError: asammdf is not installed, the file is damaged, or it holds no numbers.
    """
    try:
        from asammdf import MDF  # type: ignore[import-not-found]
    except ModuleNotFoundError:
        raise missing_library(path, "MDF files", "asammdf", "mdf", "export the file as CSV") from None
    _check_whole(path)
    gauges = []
    try:
        with MDF(str(path), raise_on_multiple_occurrences=False) as file:
            for signal in file.iter_channels(skip_master=True):
                values = np.asarray(signal.samples)
                if values.ndim == 1 and values.dtype.kind in "fiu":
                    time = np.asarray(signal.timestamps, dtype=np.float64)
                    gauges.append(NamedGauge(str(signal.name), str(signal.unit or ""), values.astype(float), time))
    except Exception as error:  # asammdf lets struct, index, zlib and its own errors of damaged files through
        raise unreadable(path, "MDF file", error) from None
    return of_gauges(path, gauges, "MDF")


def _check_whole(path: Path) -> None:
    """Refuse a file whose blocks reach beyond its end; asammdf would follow what is left of it without end.

    Raises:
        InputError: it was cut, or is no MDF file.
    """
    with path.open("rb") as stream:
        mark = stream.read(9)
        if mark[:8] not in _MARKS:
            raise InputError(f"{path}: not a readable MDF file: it does not begin with MDF; export it again")
        data = mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ)
    # a file that its logger did not close is finished by asammdf; blocks before version 4 do not state their length
    if mark[:8] != _MARKS[0] or not mark[8:].isdigit() or int(mark[8:]) < 4:
        return
    waiting, seen = [_FIRST_BLOCK], set()
    while waiting:
        at = waiting.pop()
        if at in seen:
            continue
        seen.add(at)
        head = data[at : at + _BLOCK_HEAD]
        length, links = struct.unpack_from("<QQ", head, 8) if len(head) == _BLOCK_HEAD else (0, 0)
        if not head.startswith(b"##") or at + length > len(data) or 8 * links > length:
            raise InputError(
                f"{path}: the file ends before the blocks that it refers to: it was cut while it was copied or "
                "written; copy or export it again"
            )
        waiting += [link for link in struct.unpack_from(f"<{links}Q", data, at + _BLOCK_HEAD) if link]
