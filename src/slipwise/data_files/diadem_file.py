"""DIAdem files: .tdm describes the channels, .tdx beside it holds their numbers; read by tdm-loader."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from slipwise.data_files.named_columns import NamedColumns, NamedGauge, of_gauges, one_step, unreadable
from slipwise.errors import InputError, missing_library


def read_tdm(path: Path) -> NamedColumns:
    """Read every channel of numbers with its unit, and the step that its waveforms state.

    Raises:
        InputError: tdm-loader is not installed, the .tdx is missing or short, or the file is damaged.
    """
    try:
        import tdm_loader  # type: ignore[import-not-found]
    except ModuleNotFoundError:
        raise missing_library(path, "DIAdem files", "tdm-loader", "diadem", "export the file as .tdms or CSV") from None
    gauges = []
    try:
        steps = _steps(path)
        file = tdm_loader.OpenFile(str(path))
        for group in range(len(file)):
            for k in range(file.no_channels(group)):
                values = np.asarray(file.channel(group, k))
                unit = file.channel_unit(group, k) or ""
                if values.dtype.kind == "M":
                    values, unit = (values - values[0]) / np.timedelta64(1, "s"), "s"
                if values.dtype.kind in "fiu":
                    name = file.channel_name(group, k) or f"channel {k + 1}"
                    gauges.append(NamedGauge(name, unit, values.astype(float)))
    except FileNotFoundError as error:
        raise InputError(
            f"{path}: its numbers are in {Path(str(error.filename)).name}, which is missing; copy it beside the .tdm"
        ) from None
    except Exception as error:  # tdm-loader lets errors of XML, of memory maps and of missing keys through
        short = ValueError("the .tdx is shorter than the .tdm says") if str(error).startswith("mmap") else error
        raise unreadable(path, "DIAdem file", short, "export .tdm and .tdx again") from None
    step, read = one_step(path, steps), of_gauges(path, gauges, "DIAdem")
    return NamedColumns(read.columns, step, read.notes)


def _steps(path: Path) -> set[float]:
    """Return the steps that waveforms state in the attribute wf_increment [s]."""
    found = (e for e in ElementTree.parse(path).iter() if e.attrib.get("name") == "wf_increment")
    values = (float("".join(element.itertext()).strip()) for element in found)
    return {value for value in values if value > 0.0}
