"""Binary files of HBM's catman (.bin), read by apread."""

import contextlib
import io
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.data_files.named_columns import NamedColumns, NamedGauge, of_gauges, unreadable
from slipwise.errors import InputError, missing_library

#: What a catman file begins with, in its versions: a whole number of two bytes.
_MARKS = range(5009, 5100)


def read_catman(path: Path) -> NamedColumns:
    """Read every channel of numbers with its unit; catman keeps the time as a channel.

    Raises:
        InputError: apread is not installed, the file is none of catman's, was cut or is damaged.
    """
    try:
        from apread import APReader  # type: ignore[import-not-found]
    except ModuleNotFoundError:
        raise missing_library(path, "catman's .bin files", "apread", "catman", "export the file as text") from None
    with path.open("rb") as stream:
        if int.from_bytes(stream.read(2), "little") not in _MARKS:
            raise InputError(f"{path}: this .bin file is none of catman's; export the measurement as text or .tdms")

    class Reader(APReader):  # type: ignore[misc]
        def connect(self) -> None:
            """Leave channels as they are: apread would ask in the terminal which of them is the time."""

    try:
        # apread shows how far it is, and what it assumes
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            channels: list[Any] = Reader(str(path)).Channels
            short = [c for c in channels if len(c.data) != c.length]
            gauges = [NamedGauge(c.Name.strip(), c.unit.strip(), np.asarray(c.data, float)) for c in channels]
    except Exception as error:  # apread lets struct, key and memory errors of damaged files through
        raise unreadable(path, "catman file", error) from None
    if short:
        raise InputError(
            f"{path}: {short[0].Name!r} states {short[0].length} values and the file holds {len(short[0].data)}: it "
            "was cut; copy or export it again"
        )
    return of_gauges(path, gauges, "catman")
