"""A data file as a table: headers and columns of numbers, whatever its format."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import NDArray

from slipwise.campaign.matlab_file import matlab_variables
from slipwise.campaign.text_file import inspect_text, read_text_columns
from slipwise.errors import InputError

Array = NDArray[np.float64]
TEXT_SUFFIXES: tuple[str, ...] = (".csv", ".tsv", ".txt", ".dat")
SUFFIXES: tuple[str, ...] = (*TEXT_SUFFIXES, ".mat", ".parquet")


@dataclass(frozen=True)
class Table:
    """A data file that has been looked at but not yet read.

    Attributes:
        path: the file.
        headers: of all columns, as the file has them; "name [unit]" where the file keeps the unit apart.
        columns: function of column numbers that reads these columns, each (n,).
    """

    path: Path
    headers: tuple[str, ...]
    columns: Callable[[Sequence[int]], list[Array]]


def open_table(path: Path) -> Table:
    """Look at a data file.

    Raises:
        InputError: no such file, an unknown format, or a file that its format does not allow.
    """
    if not path.is_file():
        near = sorted(p.name for p in path.parent.glob("*") if p.suffix.lower() in SUFFIXES)
        raise InputError(f"{path}: no such file; data files in that folder: {', '.join(near) or 'none'}")
    suffix = path.suffix.lower()
    if suffix in TEXT_SUFFIXES:
        layout = inspect_text(path)
        return Table(path, layout.headers, lambda wanted: read_text_columns(path, layout, wanted))
    if suffix == ".mat":
        variables = matlab_variables(path)
        names = tuple(variables)
        return Table(path, names, lambda wanted: [variables[names[i]] for i in wanted])
    if suffix == ".parquet":
        return _parquet(path)
    raise InputError(f"{path}: {suffix or 'no suffix'} is no format of a data file; possible: {', '.join(SUFFIXES)}")


def _parquet(path: Path) -> Table:
    try:
        schema = pq.read_schema(path)
    except (pa.ArrowInvalid, OSError) as error:
        raise InputError(f"{path}: not a readable parquet file ({error})") from None
    headers = []
    for entry in schema:
        unit = (entry.metadata or {}).get(b"unit")
        headers.append(f"{entry.name} [{unit.decode()}]" if unit is not None else entry.name)

    def columns(wanted: Sequence[int]) -> list[Array]:
        table = pq.read_table(path, columns=[schema.names[i] for i in wanted])
        read = []
        for i in wanted:
            column = table.column(schema.names[i])
            if not (pa.types.is_floating(column.type) or pa.types.is_integer(column.type)):
                raise InputError(f"{path.name}: column {schema.names[i]!r} holds {column.type}, not numbers")
            read.append(column.to_numpy().astype(float))
        return read

    return Table(path, tuple(headers), columns)
