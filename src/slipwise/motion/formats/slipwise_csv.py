"""Our own CSV: "time [s],table_ax [m/s^2],..."; of a measured run, the table's channels are the motion."""

import re
from dataclasses import replace
from difflib import get_close_matches

from slipwise.channels import CHANNELS
from slipwise.errors import InputError
from slipwise.motion.column_kind import TABLE_ACCELERATIONS, TABLE_DISPLACEMENTS
from slipwise.motion.column_traces import column_traces
from slipwise.motion.named_table import text_table
from slipwise.motion.source_file import SourceFile
from slipwise.motion.stated import Given
from slipwise.motion.trace import Trace


def recognise(head: bytes) -> bool:
    """Return whether the first line begins with our time and names one of our channels."""
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
        near = get_close_matches(name, TABLE_ACCELERATIONS, n=1, cutoff=0.8)
        if near and name not in CHANNELS:
            raise InputError(f"{source.name}: no channel is called {name!r}; did you mean {near[0]}?")
    possible = (*TABLE_ACCELERATIONS, *TABLE_DISPLACEMENTS)
    present = [name for name in table.names if name in possible]
    if not present:
        raise InputError(
            f"{source.name}: this record holds none of {', '.join(possible)}; it has {', '.join(table.names)}"
        )
    doubled = sorted({name for name in present if present.count(name) > 1})
    if doubled:
        raise InputError(f"{source.name}: {', '.join(doubled)} stands there more than once; leave one of them")
    return column_traces(replace(table, read_as="Slipwise CSV"), source, given)
