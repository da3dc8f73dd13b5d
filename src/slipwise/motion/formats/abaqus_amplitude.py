"""Abaqus amplitudes: "*AMPLITUDE, NAME=EQ-X", then pairs of time and value, four to a line; each is a component.

Equally spaced ones hold values alone, and their interval. Lines that begin with ** are comments; what they state binds.
Source: Abaqus Analysis User's Guide, "Amplitude curves".
"""

import re
from collections import Counter
from dataclasses import replace
from itertools import pairwise

import numpy as np

from slipwise.data_files.statements import read_statements
from slipwise.errors import InputError
from slipwise.motion.column_traces import ColumnTable, column_traces
from slipwise.motion.number_rows import numbers_of
from slipwise.motion.source_file import SourceFile, number
from slipwise.motion.stated import Given
from slipwise.motion.time_column import last_digit
from slipwise.motion.trace import Trace

_KEYWORD = re.compile(r"\*\s*AMPLITUDE\b", re.IGNORECASE)


def recognise(head: bytes) -> bool:
    """Return whether a line of the head begins an amplitude."""
    return any(_KEYWORD.match(line) for line in head.decode("utf-8", "replace").splitlines())


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read every tabular or equally spaced amplitude of a file.

    Raises:
        InputError: another kind of amplitude, an odd count of numbers, values that are missing, a field that is no
            number, or no values.
        UnitError: nothing states the unit, or it is none of acceleration.
    """
    starts = [i for i, line in enumerate(source.lines) if _KEYWORD.match(line)]
    comments = [line.strip("* ") for line in source.lines if line.startswith("**")]
    stated = read_statements(comments, source.name)
    traces = []
    for start in starts:
        options = _options(source.lines[start])
        kind = options.get("definition", "tabular").lower()
        if kind not in ("tabular", "equally spaced"):
            raise InputError(
                f"{source.at(start)}: an amplitude of the kind {kind} holds no values of a record; tabular and equally "
                "spaced ones are read"
            )
        end = next(
            (i for i in range(start + 1, len(source.lines)) if re.match(r"\s*\*(?!\*)", source.lines[i])),
            len(source.lines),
        )
        rows = [i for i in range(start + 1, end) if source.lines[i].strip() and not source.lines[i].startswith("**")]
        fields = [(i, field) for i in rows for field in numbers_of(source.lines[i]) or source.lines[i].split(",")]
        values = np.array([number(field, source.at(i)) for i, field in fields])
        name = options.get("name", source.stem)
        if kind == "tabular":
            if values.size < 4 or values.size % 2:
                raise InputError(
                    f"{source.at(start)}: the amplitude {name} holds {values.size} numbers; pairs of time and value "
                    "are needed, at least two: the file is cut off or damaged"
                )
            names, units, columns = ("time", name), ("s", ""), values.reshape(-1, 2)
        else:
            _refuse_short_line(source, [i for i, _ in fields])
            step = options.get("fixed interval", "")
            stated = read_statements([*comments, f"time step = {step}"], source.name)
            names, units, columns = (name,), ("",), values[:, None]
        table = ColumnTable(
            names,
            units,
            columns,
            stated,
            at=lambda row, fields=fields, each=columns.shape[1]: source.at(fields[each * row][0]),
            rounding=lambda k, fields=fields: max(last_digit(field) for _, field in fields[k::2][:20]),
            title=comments[0] if comments else "",
            read_as="Abaqus amplitude",
        )
        traces += [replace(trace, name=name, letter_of_file=False) for trace in column_traces(table, source, given)]
    return traces


def _refuse_short_line(source: SourceFile, places: list[int]) -> None:
    """Refuse values that are missing within a series; only its last line may be shorter than the others.

    Raises:
        InputError: a line with fewer values than the one before it; the message names it.
    """
    counts = Counter(places)
    *lines, _ = counts
    for before, line in pairwise(lines):
        if counts[line] < counts[before]:
            raise InputError(
                f"{source.at(line)}: {counts[line]} values stand where {counts[before]} were expected; "
                "the amplitude is damaged, write it again"
            )


def _options(line: str) -> dict[str, str]:
    """Return the options of a keyword line: "*Amplitude, name=EQ, time=TOTAL TIME"."""
    pairs = (part.partition("=") for part in line.split(",")[1:])
    return {key.strip().lower(): value.strip() for key, _, value in pairs}
