"""SAC and miniSEED, read by obspy: one component a trace; neither states the unit of an acceleration.

Whole numbers are counts of a digitizer: only the acceleration of one count makes a motion of them.

obspy is an extra (`seismology`), imported only here and only when such a file is read.
"""

import io
import re
import struct
import warnings
from datetime import datetime
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import InputError, UnitError, missing_library
from slipwise.motion.origin import MotionOrigin
from slipwise.motion.source_file import SourceFile
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.trace import Trace

_MINISEED = re.compile(rb"\d{6}[DRQM][ \x00]|MS\x03")
#: Records of miniSEED 2 are as long as a power of two, and no shorter than this [bytes].
_SHORTEST_RECORD = 128
_DAMAGED = "a record of the file is cut off or damaged; fetch it again"
#: The header of SAC: word 77 is its version, at this place; 6 and 7 are in use.
_SAC_VERSION_AT, _SAC_VERSIONS = 304, (6, 7)
#: SAC's idep: what the samples are.
_SAC_KINDS = {6: "displacement", 7: "velocity"}


def recognise(head: bytes) -> bool:
    """Return whether a file begins as miniSEED or SAC do."""
    if _MINISEED.match(head):
        return True
    if len(head) < 632:
        return False
    return any(
        struct.unpack_from(f"{order}i", head, _SAC_VERSION_AT)[0] in _SAC_VERSIONS for order in "<>"
    )  # fmt: skip


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read every trace of a file.

    Raises:
        InputError: obspy is not installed, the file is damaged, or a channel has gaps.
        UnitError: no unit is given, or the file says that it holds velocity or displacement.
    """
    stream = _stream(source)
    traces = []
    for found in stream:
        stats = found.stats
        kind = _SAC_KINDS.get(int(stats.sac.get("idep", 0))) if "sac" in stats else None
        if kind:
            raise UnitError(f"{source.name}: the header says that this is a {kind}; a table needs acceleration")
        dt, dt_words = settle_step(float(stats.delta), given, source)
        values = np.asarray(found.data, dtype=float)
        if not np.isfinite(values).all():
            raise InputError(f"{source.name}: channel {found.id} holds values that are no numbers; fetch it again")
        factor, unit_words = _unit(values, given, source, found.id)
        name = stats.channel or source.stem
        traces.append(
            Trace(
                source=source,
                name=name,
                title=f"{stats.network}.{stats.station} {stats.starttime}",
                dt=dt,
                acceleration=values * factor,
                treatment=(f"read by obspy: {source.name}, {found.id}", f"{unit_words}; {dt_words}"),
                origin=MotionOrigin(
                    station=f"{stats.network}.{stats.station}".strip("."),
                    sensor=stats.location,
                    start=_start(stats),
                    exact_start=True,
                ),
            )
        )
    if not traces:
        raise InputError(f"{source.name}: no trace is in this file; fetch it again")
    return traces


def _unit(values: Array, given: Given, source: SourceFile, channel: str) -> tuple[float, str]:
    """Return the factor to m/s^2 and the words for the record.

    Raises:
        UnitError: nobody says the unit, or a unit without a number is given where the values are counts.
    """
    given.factor(source)
    if given.unit is not None and not given.has_number and values.any() and (values == np.round(values)).all():
        raise UnitError(
            f"{source.name}: channel {channel} holds whole numbers, counts of a digitizer; give the acceleration of "
            f"one count, for example --count '2.4e-6 m/s^2' (--unit '1 {given.unit}' if the values are in {given.unit})"
        )
    return settle_unit(None, given, source)


def _stream(source: SourceFile) -> Any:
    """Read a file as obspy's stream, one trace for each channel.

    Raises:
        InputError: obspy is not installed, the file is damaged, or a channel has gaps.
    """
    try:
        from obspy import read as read_stream
        from obspy.io.mseed import InternalMSEEDWarning
    except ModuleNotFoundError:
        raise missing_library(
            source.name, "SAC and miniSEED", "obspy", "seismology", "export the motion as text"
        ) from None
    if source.data[:6].isdigit() and len(source.data) % _SHORTEST_RECORD:
        raise InputError(f"{source.name}: {_DAMAGED}")
    try:
        with warnings.catch_warnings():
            # obspy passes over what is cut off or damaged with a warning
            warnings.simplefilter("error", InternalMSEEDWarning)
            stream = read_stream(io.BytesIO(source.data), format="MSEED" if _MINISEED.match(source.data) else "SAC")
        # before they are joined: a gap of years would be filled with gigabytes
        broken = [gap[:4] for gap in stream.get_gaps(min_gap=0.0)]
        if not broken:
            stream.merge(method=0)
    except InternalMSEEDWarning:
        raise InputError(f"{source.name}: {_DAMAGED}") from None
    except Exception as error:  # obspy lets struct, value and its own errors of C code through
        raise InputError(f"{source.name}: not a readable SAC or miniSEED file ({error}); fetch it again") from None
    broken += [(*found.id.split("."),) for found in stream if np.ma.isMaskedArray(found.data)]
    if broken:
        raise InputError(
            f"{source.name}: channel {'.'.join(broken[0])} has gaps; fill or cut them, a table cannot follow them"
        )
    return stream


def _start(stats: Any) -> datetime | None:
    try:
        return stats.starttime.datetime
    except (ValueError, OverflowError):  # a year that no calendar has
        return None
