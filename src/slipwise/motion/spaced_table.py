"""Tables of numbers with spaces between them, a fixed number to a line."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from slipwise.errors import InputError
from slipwise.motion.number_rows import rows_of_numbers
from slipwise.motion.source_file import SourceFile


def spaced_table(source: SourceFile, places: Iterable[int], columns: int) -> NDArray[np.float64]:
    """Read a table, (n, columns).

    Args:
        source: the file.
        places: of its lines that may hold rows; empty ones are passed over.
        columns: numbers in every row.

    Raises:
        InputError: a line with more or fewer of them, or with something else than a number.
    """
    filled = [i for i in places if source.lines[i].strip()]
    values = rows_of_numbers(source, filled, columns, single=False) if filled else ()
    for i, row in zip(filled, values, strict=True) if not isinstance(values, np.ndarray) else ():
        if len(row) != columns:
            raise InputError(
                f"{source.at(i)}: {columns} values were expected, the line has {len(row)}; "
                "the record is truncated or damaged, fetch the file again"
            )
    return np.reshape(values, (-1, columns))
