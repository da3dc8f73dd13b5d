"""Recorders of OpenSees: numbers between blanks, a row each step, no line of names; the first column is often time.

    recorder Node -file slip.out -time -node 2 -dof 1 disp
    recorder Element -file pads.out -time -ele 1 2 3 4 localForce

Source: OpenSees documentation, recorder command; `-time` puts the pseudo-time into the first column.
"""

from pathlib import Path

import numpy as np

from slipwise.data_files.header_rows import looks_numeric
from slipwise.data_files.named_columns import NamedColumns
from slipwise.errors import InputError
from slipwise.input_file import read_input
from slipwise.text_encoding import decoded


def is_recorder(path: Path) -> bool:
    """Return whether the first line of a file that is not empty holds numbers and no names."""
    with path.open("rb") as stream:
        head = decoded(stream.read(1 << 16)).split("\n")
    first = next((line.split() for line in head if line.strip()), [])
    return bool(first) and looks_numeric(first)


def read_recorder(path: Path) -> NamedColumns:
    """Read a recorder's file; its columns are named by their numbers, "column 1" and so on.

    Raises:
        InputError: a row that is no numbers, or has another count of them; the message says which.
    """
    rows: list[list[float]] = []
    for number, line in enumerate(decoded(read_input(path)).splitlines(), 1):
        cells = line.split()
        if not cells:
            continue
        try:
            rows.append([float(cell) for cell in cells])
        except ValueError:
            raise InputError(f"{path}: line {number} holds {line[:60]!r}, which is no row of numbers") from None
        if len(rows[-1]) != len(rows[0]):
            raise InputError(
                f"{path}: line {number} has {len(rows[-1])} columns, the first one {len(rows[0])}: the analysis "
                "stopped while it wrote, or two recorders wrote to one file"
            )
    table = np.array(rows)
    return NamedColumns({f"column {i + 1}": table[:, i] for i in range(table.shape[1])})
