"""A data file as a table: headers and columns of numbers, whatever its format."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq

from slipwise.arrays import Array
from slipwise.data_files.catman_file import read_catman
from slipwise.data_files.dewesoft_file import read_dewesoft
from slipwise.data_files.diadem_file import read_tdm
from slipwise.data_files.labview_file import read_tdms
from slipwise.data_files.matlab_file import read_matlab
from slipwise.data_files.mdf_file import read_mdf
from slipwise.data_files.named_columns import NamedColumns, unreadable
from slipwise.data_files.recorder_file import is_recorder, read_recorder
from slipwise.data_files.sap2000_file import is_sap2000, read_sap2000
from slipwise.data_files.spreadsheet import inspect_sheet, read_sheet
from slipwise.data_files.statements import read_statements
from slipwise.data_files.table_rows import RowBlock
from slipwise.data_files.text_file import inspect_text, read_text_columns
from slipwise.data_files.uff_file import read_uff
from slipwise.errors import InputError
from slipwise.input_file import check_input

#: Columns that take more memory than this are no record of a rig [bytes].
_LARGEST = 800_000_000
TEXT_SUFFIXES: tuple[str, ...] = (".csv", ".tsv", ".txt", ".dat", ".asc", ".lvm", ".out", ".s2k")
#: Files that are read whole, channel by channel.
_CHANNEL_FILES: dict[str, Callable[[Path], NamedColumns]] = {
    ".mat": read_matlab, ".tdms": read_tdms, ".mf4": read_mdf, ".mdf": read_mdf, ".uff": read_uff, ".unv": read_uff,
    ".tdm": read_tdm, ".bin": read_catman, ".dxd": read_dewesoft, ".d7d": read_dewesoft,
}  # fmt: skip
SUFFIXES: tuple[str, ...] = (*TEXT_SUFFIXES, ".parquet", ".xlsx", *_CHANNEL_FILES)
#: Files that belong to one of another suffix: the numbers of a .tdm.
COMPANIONS: tuple[str, ...] = (".tdx", ".tdms_index")


@dataclass(frozen=True)
class Columns:
    """Columns that were read, each (n,), and the tables of the file where it holds more than one."""

    values: list[Array]
    tables: tuple[RowBlock, ...] = ()


@dataclass(frozen=True)
class Table:
    """A data file that has been looked at but not yet read.

    Attributes:
        path: the file.
        headers: of all columns, as the file has them; "name [unit]" where the file keeps the unit apart.
        columns: function of column numbers that reads these columns.
        step: what the file states beside its columns [s], None if it states none.
        notes: what a user should know of the file.
        above: the lines above the names of the columns.
    """

    path: Path
    headers: tuple[str, ...]
    columns: Callable[[Sequence[int]], Columns]
    step: float | None = None
    notes: tuple[str, ...] = ()
    above: tuple[str, ...] = ()


def open_table(path: Path) -> Table:
    """Look at a data file.

    Args:
        path: the file; "run.dat#2" is the second table of run.dat, "run.xlsx#Sheet2" a sheet; a folder is one table of
            all data files in it, whose columns are named "FILE: HEADER".

    Raises:
        InputError: no such file, an unknown format, or a file that its format does not allow.
    """
    part = None
    if not path.is_file() and "#" in path.name:
        path, part = path.with_name(path.name.rpartition("#")[0]), path.name.rpartition("#")[2]
    if not path.exists():
        near = sorted(p.name for p in path.parent.glob("*") if p.suffix.lower() in SUFFIXES)
        raise InputError(f"{path}: no such file; data files in that folder: {', '.join(near) or 'none'}")
    if path.is_dir():
        return _of_folder(path)
    suffix = check_input(path).suffix.lower()
    if part is not None and (suffix not in (*TEXT_SUFFIXES, ".xlsx") or (suffix != ".xlsx" and not part.isdigit())):
        raise InputError(f"{path}#{part}: only text files (by number) and workbooks (by sheet) hold several tables")
    if suffix == ".out" and is_recorder(path):
        return _of_columns(path, read_recorder(path))
    if suffix in TEXT_SUFFIXES and is_sap2000(path):
        return _of_columns(path, read_sap2000(path))
    if suffix in TEXT_SUFFIXES:
        layout = inspect_text(path)
        table = None if part is None else int(part)
        return Table(
            path,
            layout.headers,
            lambda wanted: Columns(*read_text_columns(path, layout, wanted, table)),
            read_statements(layout.above, path.name, ("step",)).step,
            layout.notes,
            layout.above,
        )
    if suffix in _CHANNEL_FILES:
        return _of_columns(path, _CHANNEL_FILES[suffix](path))
    if suffix == ".xlsx":
        sheet = inspect_sheet(path, part)
        return Table(
            path,
            sheet.headers,
            lambda wanted: Columns(read_sheet(path.name, sheet, wanted)),
            read_statements(sheet.above, path.name, ("step",)).step,
            sheet.notes,
            sheet.above,
        )
    if suffix == ".parquet":
        return _parquet(path)
    raise InputError(f"{path}: {suffix or 'no suffix'} is no format of a data file; possible: {', '.join(SUFFIXES)}")


def _of_folder(path: Path) -> Table:
    """Look at the files of one run: recorders of a calculation, or cards of a logger, that write a file each.

    Raises:
        InputError: no data file is in it.
    """
    files = sorted(p for p in path.iterdir() if p.is_file() and p.suffix.lower() in SUFFIXES)
    if not files:
        raise InputError(f"{path}: no data file is in this folder; possible: {', '.join(SUFFIXES)}")
    parts = [open_table(file) for file in files]
    places = [(part, i) for part in parts for i in range(len(part.headers))]
    headers = tuple(f"{part.path.stem}: {part.headers[i]}" for part, i in places)

    def columns(wanted: Sequence[int]) -> Columns:
        values = [places[k][0].columns([places[k][1]]).values[0] for k in wanted]
        lengths = {headers[k]: len(column) for k, column in zip(wanted, values, strict=True)}
        if len(set(lengths.values())) > 1:
            counted = ", ".join(f"{name} {count}" for name, count in lengths.items())
            raise InputError(f"{path}: the files of one run must have the same steps; rows of the columns: {counted}")
        return Columns(values)

    step = next((part.step for part in parts if part.step is not None), None)
    return Table(path, headers, columns, step, tuple(note for part in parts for note in part.notes))


def _of_columns(path: Path, read: NamedColumns) -> Table:
    columns = read.columns
    names = tuple(columns)

    def chosen(wanted: Sequence[int]) -> Columns:
        values = [columns[names[i]] for i in wanted]
        lengths = {names[i]: len(column) for i, column in zip(wanted, values, strict=True)}
        if len(set(lengths.values())) > 1:
            counted = ", ".join(f"{name} {count}" for name, count in lengths.items())
            raise InputError(f"{path.name}: the columns that are used differ in length: {counted}; cut the longer ones")
        return Columns(values)

    return Table(path, names, chosen, read.step, read.notes)


def _parquet(path: Path) -> Table:
    headers = []
    try:
        metadata, schema = pq.read_metadata(path), pq.read_schema(path)
        for entry in schema:
            unit = (entry.metadata or {}).get(b"unit")
            headers.append(f"{entry.name} [{unit.decode('utf-8', 'replace')}]" if unit is not None else entry.name)
    except Exception as error:  # Arrow lets errors of Thrift, of memory and of text through
        raise unreadable(path, "parquet file", error, "write it again") from None

    def columns(wanted: Sequence[int]) -> Columns:
        if 8 * metadata.num_rows * len(wanted) > _LARGEST:
            raise InputError(
                f"{path}: {len(wanted)} columns of {metadata.num_rows} rows are more than {_LARGEST / 1e6:g} MB; save "
                "one run in a file"
            )
        twice = [schema.names[i] for i in wanted if schema.names.count(schema.names[i]) > 1]
        if twice:
            raise InputError(f"{path}: the column {twice[0]!r} stands there twice; give one of them another name")
        try:
            table = pq.read_table(path, columns=[schema.names[i] for i in wanted])
        except Exception as error:  # as above
            names = ", ".join(schema.names[i] for i in wanted)
            first = (str(error).splitlines() or [type(error).__name__])[0]
            raise InputError(
                f"{path}: the columns {names} of {metadata.num_rows} rows cannot be read ({first}); write it again"
            ) from None
        read = []
        for i in wanted:
            column = table.column(schema.names[i])
            if not (pa.types.is_floating(column.type) or pa.types.is_integer(column.type)):
                raise InputError(
                    f"{path.name}: the column {schema.names[i]!r} holds {column.type}, not numbers; write it as "
                    "numbers, or leave it out"
                )
            read.append(column.to_numpy().astype(float))
        return Columns(read)

    return Table(path, tuple(headers), columns)
