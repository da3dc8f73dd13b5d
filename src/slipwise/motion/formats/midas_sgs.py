"""Time functions of MIDAS (.sgs, .thd): keyword lines that name both axes, then time and value, one pair a line.

"*X-AXIS, Time(sec)" and "*Y-AXIS, Ground Accel. (g)" name the columns and their units; "*UNIT&TYPE, GRAV, ACCEL" says
that values are shares of gravity. Source: the files' own headers.
"""

import re

from slipwise.data_files.statements import read_statements
from slipwise.errors import InputError, UnitError
from slipwise.motion.column_traces import ColumnTable, column_traces
from slipwise.motion.number_rows import numbers_of, table_of_numbers
from slipwise.motion.source_file import SourceFile
from slipwise.motion.stated import Given, agreed_unit
from slipwise.motion.time_column import last_digit
from slipwise.motion.trace import Trace

_AXIS = re.compile(r"\s*(?P<name>[^(\[]*?)\s*(?:[(\[](?P<unit>[^)\]]*)[)\]])?\s*$")


def recognise(head: bytes) -> bool:
    """Return whether the first lines hold MIDAS' keywords."""
    return bool(re.match(rb"(?:[^\n]*\n){0,3}\s*\*SGSw", head, re.IGNORECASE)) or (
        b"*X-AXIS" in head.upper() and b"*Y-AXIS" in head.upper()
    )


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read the function of a file.

    Raises:
        InputError: no values, several functions, or times that do not rise evenly.
        UnitError: the function is none of acceleration, or its unit is missing or contradicted.
    """
    facts: dict[str, list[str]] = {}
    for line in source.lines:
        if line.strip().startswith("*"):
            key, _, value = line.strip().lstrip("*").partition(",")
            facts.setdefault(key.strip().upper(), []).append(value.strip())
    starts = [i + 1 for i, line in enumerate(source.lines) if line.strip().upper() == "*DATA"]
    if not starts:
        raise InputError(f"{source.name}: a time function of MIDAS holds its values below *DATA, which is not there")
    if len(starts) > 1:
        raise InputError(f"{source.name}: {len(starts)} time functions are in this file; give each a file of its own")
    start = starts[0]
    end = next((i for i in range(start, len(source.lines)) if source.lines[i].strip().startswith("*")), None)
    places = [i for i in range(start, end or len(source.lines)) if source.lines[i].strip()]
    if not places:
        raise InputError(f"{source.name}: no values stand below *DATA; the file is cut off")
    kind = [part.strip().upper() for part in facts.get("UNIT&TYPE", [""])[0].split(",")]
    if len(kind) > 1 and kind[1] != "ACCEL":
        raise UnitError(f"{source.name}: the function is of the type {kind[1]}; a table needs ACCEL")
    axes = [_AXIS.match(facts.get(f"{axis}-AXIS", [""])[0]) for axis in "XY"]
    names = [(axis["name"] or "") if axis else "" for axis in axes]
    units = [(axis["unit"] or "") if axis else "" for axis in axes]
    of_values = agreed_unit(units[1] or None, "g" if kind[0] == "GRAV" else None, source)
    table = ColumnTable(
        (names[0] or "time", names[1] or source.stem),
        (units[0] or "s", of_values or ""),
        table_of_numbers(source, places, 2),
        read_statements([], source.name),
        at=lambda row: source.at(places[row]),
        rounding=lambda k: last_digit(numbers_of(source.lines[places[-1]])[k]),
        title=" ".join(title for title in facts.get("TITLE", []) if title),
        read_as="MIDAS time function",
    )
    return column_traces(table, source, given)
