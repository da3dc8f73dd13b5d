"""Tables of numbers with spaces between them, a fixed number to a line."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import InputError
from slipwise.motion.source_file import SourceFile, number


def spaced_table(source: SourceFile, places: Iterable[int], columns: int) -> NDArray[np.float64]:
    """Read a table, (n, columns).

    Args:
        source: the file.
        places: of its lines that may hold rows; empty ones are passed over.
        columns: numbers in every row.

    Raises:
        InputError: a line with more or fewer of them, or with something else than a number.
    """
    rows = []
    for i in places:
        fields = source.lines[i].split()
        if not fields:
            continue
        if len(fields) != columns:
            raise InputError(
                f"{source.at(i)}: {columns} values were expected, the line has {len(fields)}; "
                "the record is truncated or damaged, fetch the file again"
            )
        rows.append([number(value, source.at(i)) for value in fields])
    return np.array(rows, dtype=float).reshape(-1, columns)
