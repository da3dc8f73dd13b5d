"""LabVIEW files: .lvm, text whose header names units and step, and .tdms, read by the optional npTDMS."""

import logging
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.data_files.named_columns import NamedColumns, one_step, unreadable
from slipwise.errors import InputError, missing_library

#: A segment of a .tdms file begins with its mark, a mask of flags, a version, and where the next segment begins.
_MARK, _LEAD, _BIG_ENDIAN = b"TDSm", 28, 1 << 6


def is_lvm(lines: Sequence[str]) -> bool:
    """Return whether the first lines of a text are those of a LabVIEW measurement file."""
    return bool(lines) and lines[0].lstrip("\ufeff").startswith("LabVIEW Measurement")


def lvm_headers(names: Sequence[str], preamble: Sequence[str]) -> tuple[str, ...]:
    """Return the columns of an .lvm file with their units, which its header holds by channel.

    Args:
        names: of the columns, "X_Value" first, once or once for each channel.
        preamble: the lines above them.
    """
    units = next((line.split("\t")[1:] for line in reversed(preamble) if line.startswith("Y_Unit_Label")), [])
    given = iter(units)
    out = []
    for name in names:
        if name.startswith("X_Value"):
            out.append(f"{name} [s]")
            continue
        unit = next(given, "").strip()
        out.append(f"{name} [{unit}]" if unit else name)
    return tuple(out)


def read_tdms(path: Path) -> NamedColumns:
    """Read every channel of numbers.

    Raises:
        InputError: npTDMS is not installed, the file is cut off or damaged, or its channels state different steps.
    """
    try:
        from nptdms import TdmsFile  # type: ignore[import-not-found]
        from nptdms.log import log_manager  # type: ignore[import-not-found]
    except ModuleNotFoundError:
        raise missing_library(path, ".tdms files", "npTDMS", "labview", "export the file as .lvm or text") from None
    _check_whole(path)
    log_manager.set_level(logging.ERROR)  # what it would warn of is refused
    columns: dict[str, Array] = {}
    steps: set[float] = set()
    try:
        _check_counts(path, TdmsFile.read_metadata(str(path)))
        file: Any = TdmsFile.read(str(path))
        groups = file.groups()
        for group in groups:
            for channel in group.channels():
                values = np.asarray(channel[:])
                if values.dtype.kind not in "fiuM" or values.size < 2:
                    continue
                if values.dtype.kind == "M":
                    values = (values - values[0]) / np.timedelta64(1, "s")
                name = channel.name if len(groups) == 1 else f"{group.name}/{channel.name}"
                unit = "s" if np.asarray(channel[:]).dtype.kind == "M" else _unit(channel.properties)
                columns[f"{name} [{unit}]" if unit else name] = values.astype(float)
                if channel.properties.get("wf_increment"):
                    steps.add(float(channel.properties["wf_increment"]))
    except InputError:
        raise
    except Exception as error:  # npTDMS lets struct, value and key errors of damaged files through
        raise unreadable(path, ".tdms file", error) from None
    if not columns:
        raise InputError(f"{path}: no channel of numbers is in this .tdms file")
    return NamedColumns(columns, one_step(path, steps))


def _check_whole(path: Path) -> None:
    """Refuse a file whose segments do not fill it; npTDMS would read what is there and only warn.

    Raises:
        InputError: the file ends within a segment, or is none of LabVIEW's.
    """
    size, at, segments = path.stat().st_size, 0, 0
    with path.open("rb") as stream:
        while at < size:
            stream.seek(at)
            lead = stream.read(_LEAD)
            if not lead.startswith(_MARK):
                raise InputError(f"{path}: not a readable .tdms file: no segment begins at byte {at}; export it again")
            end = size + 1
            if len(lead) == _LEAD:
                order = ">" if struct.unpack_from("<I", lead, 4)[0] & _BIG_ENDIAN else "<"
                end = at + _LEAD + struct.unpack_from(f"{order}Q", lead, 12)[0]
            if end > size:
                raise InputError(
                    f"{path}: the file ends before its segment number {segments + 1} does: it was cut off while it was "
                    "copied, or the logger stopped while it wrote; copy or export it again"
                )
            at, segments = end, segments + 1
    if not segments:
        raise InputError(f"{path}: the file is empty")


def _check_counts(path: Path, metadata: Any) -> None:
    """Refuse counts of values that the file has no room for, before memory is taken for them.

    Raises:
        InputError: it promises more values than it has bytes.
    """
    promised = sum(len(channel) for group in metadata.groups() for channel in group.channels())
    if promised > 8 * path.stat().st_size:  # a digital line may take one bit
        raise InputError(f"{path}: the file promises {promised} values and has no room for them; export it again")


def _unit(properties: Any) -> str:
    for key in ("unit_string", "NI_UnitDescription", "Unit", "unit"):
        if properties.get(key):
            return str(properties[key])
    return ""
