"""Dewesoft files (.dxd, .d7d), read by DWDataReader, whose library runs on Windows and Linux."""

from pathlib import Path

import numpy as np

from slipwise.campaign.named_columns import Gauge, NamedColumns, of_gauges
from slipwise.errors import InputError


def read_dewesoft(path: Path) -> NamedColumns:
    """Read every channel of numbers with its unit and times.

    Raises:
        InputError: DWDataReader is not installed or does not run here, or the file is damaged.
    """
    try:
        import dwdatareader  # type: ignore[import-not-found]
    except ModuleNotFoundError:
        raise InputError(
            f"{path}: Dewesoft files are read by DWDataReader; install it with `pip install 'slipwise[dewesoft]'`, or "
            "export the file as text or .mat"
        ) from None
    except OSError as error:  # the library is there for some systems only
        raise InputError(
            f"{path}: the library of DWDataReader does not run here ({error}); export the file as text or .mat"
        ) from None
    gauges, left = [], []
    try:
        with dwdatareader.DWFile(str(path)) as file:
            for channel in file.values():
                if channel.number_of_samples < 2 or getattr(channel, "array_size", 1) != 1:
                    continue
                try:
                    time, values = channel.scaled()
                except dwdatareader.DWError as error:
                    left.append(f"{channel.name} ({error.message})")
                    continue
                if np.asarray(values).dtype.kind in "fiu":
                    gauges.append(Gauge(str(channel.name), str(channel.unit), np.asarray(values, float), time))
    except dwdatareader.DWError as error:
        raise InputError(f"{path}: not a readable Dewesoft file ({error.message}); export it again") from None
    read = of_gauges(path, gauges, "Dewesoft")
    said = (f"{path.name}: left out, for DWDataReader cannot read them: {', '.join(left[:6])}",) if left else ()
    return NamedColumns(read.columns, read.step, (*read.notes, *said))
