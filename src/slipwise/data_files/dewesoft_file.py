"""Dewesoft files (.dxd, .d7d), read by DWDataReader, whose library runs on Windows and Linux."""

import importlib.util
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from slipwise.data_files.named_columns import NamedColumns, NamedGauge, of_gauges
from slipwise.errors import InputError, missing_library
from slipwise.jobs.child_processes import on_a_safe_path

#: Channels that cannot be read, of which a note gives the names.
_LISTED = 6


def read_dewesoft(path: Path) -> NamedColumns:
    """Read every channel of numbers with its unit and times.

    Raises:
        InputError: DWDataReader is not installed or does not run here, or the file is damaged.
    """
    if sys.modules.get("dwdatareader", sys) is None or importlib.util.find_spec("dwdatareader") is None:
        raise missing_library(path, "Dewesoft files", "DWDataReader", "dewesoft", "export the file as text or .mat")
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        command = [sys.executable, "-m", "slipwise.data_files.dewesoft_channels", str(path.resolve()), folder]
        with on_a_safe_path():
            ended = subprocess.run(command, capture_output=True, text=True)
        if ended.returncode > 0:
            last = (ended.stderr.strip().splitlines() or ["no reason given"])[-1][:160]
            raise InputError(
                f"{path}: the library of DWDataReader does not run here ({last}); export the file as text or .mat"
            )
        if ended.returncode < 0:
            raise InputError(
                f"{path}: not a readable Dewesoft file: its library broke off; the file was cut or is damaged, export "
                "it again"
            )
        return kept_columns(path, out)


def kept_columns(path: Path, folder: Path) -> NamedColumns:
    """Return the columns of the channels that `dewesoft_channels` kept in a folder.

    Raises:
        InputError: the file is damaged, or holds no numbers.
    """
    told = json.loads((folder / "told.json").read_text(encoding="utf-8"))
    if told["error"]:
        raise InputError(f"{path}: not a readable Dewesoft file ({told['error']}); export it again")
    gauges = []
    for k, (name, unit) in enumerate(told["channels"]):
        time, values = np.load(folder / f"{k}.npy")
        gauges.append(NamedGauge(name, unit, values, time))
    read, left = of_gauges(path, gauges, "Dewesoft"), told["left"]
    said = (f"{path.name}: left out, for DWDataReader cannot read them: {', '.join(left[:_LISTED])}",) if left else ()
    return NamedColumns(read.columns, read.step, (*read.notes, *said))
