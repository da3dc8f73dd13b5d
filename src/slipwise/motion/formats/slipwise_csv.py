"""Our own CSV: "time [s],table_ax [m/s^2],..."; of a measured run, the table's channels are the motion."""

import re
from difflib import get_close_matches

from slipwise.channels import CHANNELS
from slipwise.errors import InputError
from slipwise.motion.displacement import acceleration_of
from slipwise.motion.named_table import text_table
from slipwise.motion.source_file import SourceFile
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.time_column import even_step
from slipwise.motion.trace import Trace
from slipwise.units import parse_unit

_TABLE = ("table_ax", "table_ay", "table_az")
#: Taken where a file has no acceleration of the table: the command of most tables is a displacement.
_PLACES = {"table_dx": "table_ax", "table_dy": "table_ay", "table_dz": "table_az"}


def recognise(head: bytes) -> bool:
    """Tell whether the first line begins with our time and names one of our channels."""
    lines = head.decode("latin-1").lstrip().splitlines()
    names = re.findall(r"([A-Za-z_0-9]+) *\[", lines[0]) if lines else []
    return len(names) > 1 and names[0] == "time" and any(name in CHANNELS for name in names[1:])


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the table's channels of a record or a motion.

    Raises:
        InputError: none of the table's channels is there, the rows are damaged, or the times do not rise evenly.
        UnitError: a unit is missing, unknown or of the wrong dimension.
    """
    table = text_table(source)
    if table is None or not all(table.units):
        raise InputError(f"{source.at(0)}: each column must be named with its unit, as in 'table_ax [m/s^2]'")
    for name in table.names:
        near = get_close_matches(name, _TABLE, n=1, cutoff=0.8)
        if near and name not in CHANNELS:
            raise InputError(f"{source.name}: no channel is called {name!r}; did you mean {near[0]}?")
    present = [name for name in _TABLE if name in table.names] or [name for name in _PLACES if name in table.names]
    if not present:
        raise InputError(
            f"{source.name}: this record holds none of {', '.join((*_TABLE, *_PLACES))}; it has "
            f"{', '.join(table.names)}"
        )
    doubled = [name for name in present if table.names.count(name) > 1]
    if doubled:
        raise InputError(f"{source.name}: {', '.join(doubled)} stands there more than once; leave one of them")
    factor = parse_unit(table.units[0], "s", f"column {table.names[0]!r} of {source.name}")
    step, wavers = even_step(table.values[:, 0], table.rounding(0), table.at)
    if wavers:
        raise InputError(f"{source.name}: the samples are not evenly spaced; the record must be resampled first")
    dt, dt_words = settle_step(step * factor, given, source)
    traces = []
    for name in present:
        k = table.names.index(name)
        if name in _PLACES:
            metres = table.values[:, k] * parse_unit(table.units[k], "m", f"column {name!r} of {source.name}")
            acceleration, made = acceleration_of(metres, dt, source, name)
            unit_words = f"unit m/s^2, as it is made: {made}"
        else:
            factor, unit_words = settle_unit(table.units[k], given, source)
            acceleration = table.values[:, k] * factor
        traces.append(
            Trace(
                source=source,
                name=_PLACES.get(name, name),
                title=source.stem,
                dt=dt,
                acceleration=acceleration,
                baseline="none",
                treatment=(f"read as Slipwise CSV: {source.name}, {name}", f"{unit_words}; {dt_words}"),
            )
        )
    return traces
