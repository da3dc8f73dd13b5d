"""LabVIEW files: .lvm, text whose header names units and step, and .tdms, read by the optional npTDMS."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import InputError

Array = NDArray[np.float64]


def is_lvm(lines: Sequence[str]) -> bool:
    """Tell whether the first lines of a text are those of a LabVIEW measurement file."""
    return bool(lines) and lines[0].lstrip("\ufeff").startswith("LabVIEW Measurement")


def lvm_headers(names: Sequence[str], preamble: Sequence[str]) -> tuple[str, ...]:
    """Give the columns of an .lvm file with their units, which its header holds by channel.

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


@dataclass(frozen=True)
class Tdms:
    """A .tdms file: columns by name, and the step that its channels state [s]."""

    columns: dict[str, Array]
    step: float | None


def read_tdms(path: Path) -> Tdms:
    """Read every channel of numbers.

    Raises:
        InputError: npTDMS is not installed, the file is damaged, or its channels state different steps.
    """
    try:
        from nptdms import TdmsFile  # type: ignore[import-not-found]
    except ModuleNotFoundError:
        raise InputError(
            f"{path}: .tdms files are read by npTDMS; install it with `pip install 'slipwise[labview]'`, or export the "
            "file as .lvm or text"
        ) from None
    columns: dict[str, Array] = {}
    steps: set[float] = set()
    try:
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
    except Exception as error:  # npTDMS lets struct, value and key errors of damaged files through
        raise InputError(f"{path}: not a readable .tdms file ({error}); export it again") from None
    if not columns:
        raise InputError(f"{path}: no channel of numbers is in this .tdms file")
    if steps and max(steps) > 1.000001 * min(steps):
        raise InputError(
            f"{path}: its channels are sampled at different steps, {', '.join(f'{s:g} s' for s in sorted(steps))}; "
            "export those of one step to a file of their own"
        )
    return Tdms(columns, next(iter(steps), None))


def _unit(properties: Any) -> str:
    for key in ("unit_string", "NI_UnitDescription", "Unit", "unit"):
        if properties.get(key):
            return str(properties[key])
    return ""
