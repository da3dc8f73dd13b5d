"""Our own CSV: "time [s],table_ax [m/s^2],..."; of a measured run, the table's channels are the motion."""

import re
from difflib import get_close_matches

from slipwise.channels import CHANNELS
from slipwise.errors import InputError
from slipwise.motion.displacement import acceleration_of
from slipwise.motion.number_rows import split_row
from slipwise.motion.rows import read_rows
from slipwise.motion.source_file import SourceFile
from slipwise.motion.stated import Given, settle_step, settle_unit
from slipwise.motion.time_column import even_step, last_digit
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
    rows = read_rows(source)
    if not all(rows.units) or not rows.units:
        raise InputError(f"{source.at(0)}: each column must be named with its unit, as in 'table_ax [m/s^2]'")
    for name in rows.names:
        near = get_close_matches(name, _TABLE, n=1, cutoff=0.8)
        if near and name not in CHANNELS:
            raise InputError(f"{source.name}: no channel is called {name!r}; did you mean {near[0]}?")
    present = [name for name in _TABLE if name in rows.names] or [name for name in _PLACES if name in rows.names]
    if not present:
        raise InputError(
            f"{source.name}: this record holds none of {', '.join((*_TABLE, *_PLACES))}; it has {', '.join(rows.names)}"
        )
    doubled = [name for name in present if rows.names.count(name) > 1]
    if doubled:
        raise InputError(f"{source.name}: {', '.join(doubled)} stands there more than once; leave one of them")
    values = rows.table(source)
    factor = parse_unit(rows.units[0], "s", f"column {rows.names[0]!r} of {source.name}")
    last = split_row(source.lines[rows.places[-1]])[0]
    step, wavers = even_step(values[:, 0], last_digit(last), lambda row: source.at(rows.places[row]))
    if wavers:
        raise InputError(f"{source.name}: the samples are not evenly spaced; the record must be resampled first")
    dt, dt_words = settle_step(step * factor, given, source)
    traces = []
    for name in present:
        k = rows.names.index(name)
        if name in _PLACES:
            metres = values[:, k] * parse_unit(rows.units[k], "m", f"column {name!r} of {source.name}")
            acceleration, made = acceleration_of(metres, dt, source, name)
            unit_words = f"unit m/s^2, as it is made: {made}"
        else:
            factor, unit_words = settle_unit(rows.units[k], given, source)
            acceleration = values[:, k] * factor
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
