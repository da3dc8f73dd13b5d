"""Text tables: comma, semicolon, tab or blanks; decimal point or comma; loggers' encodings; lines above and below."""

import csv
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.csv as pa_csv

from slipwise.arrays import Array
from slipwise.data_files.header_rows import MISSING, NUMBER, Header, find_header, looks_numeric
from slipwise.data_files.labview_file import is_lvm, lvm_headers
from slipwise.data_files.table_rows import RowBlock, find_end, read_blocks
from slipwise.data_files.time_stamps import seconds_of_stamps
from slipwise.errors import InputError
from slipwise.text_encoding import decoded, encoding_of

#: Bytes that are looked at to find out how a file is written, and again where a line is longer than that.
_HEAD, _LONG_HEAD = 1 << 16, 1 << 24
#: Bytes that pyarrow reads at once where lines are long: one must fit.
_WIDE_BLOCK = 1 << 25
#: Columns that stand between any number of blanks; these also stand within names, and are tried last.
BLANKS = " "
DELIMITERS = ("\t", ";", ",", BLANKS)
#: A rig has fewer channels than this.
_WIDEST = 4096


@dataclass(frozen=True)
class TextLayout:
    """How a text table is written.

    Attributes:
        header: where it begins.
        headers: of all columns; "name [unit]" where the units stand in a row of their own.
        above: the lines above the names.
        names: the line of column names as it stands there.
        delimiter: between columns.
        decimal: "." or ",".
        encoding: Python's name.
        end: bytes of the file up to the last row, None where nothing stands below it.
        notes: what stands below the last row, in words.
    """

    header: Header
    headers: tuple[str, ...]
    above: tuple[str, ...]
    names: str
    delimiter: str
    decimal: str
    encoding: str = "utf-8"
    end: int | None = None
    notes: tuple[str, ...] = ()

    @property
    def separator(self) -> str:
        """The character between columns once blanks have become tabs."""
        return "\t" if self.delimiter == BLANKS else self.delimiter

    def cells(self, line: str) -> list[str]:
        """Return the cells of a line."""
        return split_line(line, self.delimiter)


def inspect_text(path: Path) -> TextLayout:
    """Find out how a text table is written.

    Raises:
        InputError: an empty file, or no line of column names above rows of numbers.
    """
    head, lines = _first_lines(path)
    layout = layout_of(lines, str(path))
    if layout is not None:
        encoding = encoding_of(head)
        end, below = find_end(path, encoding, layout.cells, layout.header.is_row)
        return replace(layout, encoding=encoding, end=end, notes=below)
    if any(len(re.split(r"[\t;,]", line)) > _WIDEST for line in lines):
        raise InputError(
            f"{path}: a line has more than {_WIDEST} columns; a table has a column for each channel and a row for each "
            "sample: write it so"
        )
    if looks_numeric(re.split(r"[\s;,]+", lines[0].strip())):
        raise InputError(f"{path}: the first line holds numbers; a line of column names is needed above them")
    raise InputError(
        f"{path}: no line of column names above rows of numbers was found in its first lines; "
        "columns must be separated by comma, semicolon, tab or blanks"
    )


def layout_of(lines: Sequence[str], name: str) -> TextLayout | None:
    """Find out how a text table is written, from its first lines; None where no names stand above rows of numbers.

    Raises:
        InputError: a name and the row of units state different units.
    """
    found = [(header, delimiter) for delimiter in DELIMITERS[:-1] if (header := _header(lines, delimiter))]
    if not found and (header := _header(lines, BLANKS)):
        found = [(header, BLANKS)]
    if not found:
        return None
    # The separator that makes the most of the first table's rows.
    header, delimiter = max(found, key=lambda pair: (len(pair[0].names), -pair[0].first))
    decimal = "," if _decimal_comma(lines[header.first :], delimiter) else "."
    above = tuple(lines[: header.line])
    headers = lvm_headers(header.names, above) if is_lvm(lines) else header.columns(name)
    return TextLayout(header, headers, above, lines[header.line], delimiter, decimal)


def _first_lines(path: Path) -> tuple[bytes, list[str]]:
    """Return the head of a file and its lines.

    Raises:
        InputError: an empty file, or lines that are too long for a table of channels.
    """
    for size in (_HEAD, _LONG_HEAD):
        with path.open("rb") as stream:
            head = stream.read(size)
        if not head.strip(b"\x00\r\n\t ;,"):
            raise InputError(f"{path}: the file is empty; export it again, or leave out what uses it")
        lines = re.split(r"\r\n|\n|\r", decoded(head))
        if len(head) < size:
            return head, lines
        if len(lines) > 8:
            return head, lines[:-1]
    raise InputError(
        f"{path}: its lines are longer than {_LONG_HEAD // len(lines) >> 20} MB; is it a table of channels, "
        "one row a sample?"
    )


def _header(lines: Sequence[str], delimiter: str) -> Header | None:
    rows = [split_line(line, delimiter) for line in lines[:500]]
    if any(len(row) > _WIDEST for row in rows):
        return None
    header = find_header(rows)
    first = next((i for i, row in enumerate(rows) if len(row) > 1 and looks_numeric(row)), 0)
    above = next((i for i in reversed(range(first)) if lines[i].strip()), None)
    if header is None and above is not None:
        # Names with units may be separated in another way than the numbers.
        for other in DELIMITERS:
            cells = split_line(lines[above], other)
            if len(cells) == len(rows[first]) and all(re.search(r"[\[(].*[\])]", cell) for cell in cells):
                return find_header([*rows[:above], cells, *rows[above + 1 :]])
    return header


def read_text_columns(
    path: Path, layout: TextLayout, wanted: Sequence[int], table: int | None = None
) -> tuple[list[Array], tuple[RowBlock, ...]]:
    """Read columns by number; an empty or NaN cell becomes NaN, time stamps become seconds.

    Args:
        path: the file.
        layout: how it is written.
        wanted: numbers of the columns.
        table: which of several tables with the same header, from 1; None for all of them, one after the other.

    Returns:
        The columns, each (n,), and the file's tables where it holds more than one.

    Raises:
        InputError: a row with another number of columns, or a cell that is no number; the message says where.
    """
    as_it_stands = layout.end is None and layout.delimiter != BLANKS
    source = path if as_it_stands else decoded(path.read_bytes()[: layout.end])
    return columns_of_text(source, path.name, layout, wanted, table)


def columns_of_text(
    source: Path | str, name: str, layout: TextLayout, wanted: Sequence[int], table: int | None = None
) -> tuple[list[Array], tuple[RowBlock, ...]]:
    """Read columns of a text, or of a file, that ends with the last row; the rest as in `read_text_columns`."""
    if layout.delimiter == BLANKS and isinstance(source, str):
        source = "\n".join(map(_tabbed, re.split(r"\r\n|\n|\r", source))) + "\n"
    plain: InputError | None = None
    if table is None:
        try:
            return _parsed(source, layout, wanted, layout.header.first, name), ()
        except InputError as error:
            plain = error
    text = source if isinstance(source, str) else decoded(source.read_bytes())
    names = _tabbed(layout.names, names=True) if layout.delimiter == BLANKS else layout.names
    blocks = read_blocks(name, text, names, layout.separator, len(layout.headers), layout.header.first)
    if plain is not None and (not blocks or (len(blocks) == 1 and _unchanged(plain))):
        raise plain
    if table is not None and not 1 <= table <= len(blocks):
        raise InputError(f"{name}#{table}: the file holds {len(blocks)} tables; the first is {name}#1")
    chosen = blocks if table is None else [blocks[table - 1]]
    rows = "".join(block.text for block in chosen)
    return _parsed(rows, layout, wanted, 0, name), tuple(blocks) if len(chosen) > 1 else ()


def _unchanged(error: InputError) -> bool:
    """Return whether a cell, and not a line, is wrong: cutting the file into tables does not help."""
    return "column '" in str(error) and "\u2212" not in str(error)


def _parsed(source: Path | str, layout: TextLayout, wanted: Sequence[int], skip: int, file: str) -> list[Array]:
    # Columns are numbered: headers may be doubled among the columns that nobody asks for.
    names = [str(i) for i in range(len(layout.headers))]
    chosen = [names[i] for i in wanted]
    stamps = {names[i] for i in layout.header.stamps}
    # the parts of a second that a clock of whole seconds does not show stand in a column of their own
    part, unit = (names[found[0]], found[1]) if (found := layout.header.part) and stamps & set(chosen) else ("", 0.0)
    read = [*chosen, part] if part and part not in chosen else chosen
    try:
        table = pa_csv.read_csv(
            io.BytesIO(source.encode()) if isinstance(source, str) else source,
            read_options=pa_csv.ReadOptions(
                column_names=names,
                skip_rows=skip,
                encoding="utf-8" if isinstance(source, str) else layout.encoding,
                block_size=_WIDE_BLOCK if len(names) > 500 else None,
            ),
            parse_options=pa_csv.ParseOptions(delimiter=layout.separator),
            convert_options=pa_csv.ConvertOptions(
                column_types={name: pa.string() if name in stamps else pa.float64() for name in read},
                include_columns=read,
                null_values=list(MISSING),
                decimal_point=layout.decimal,
                strings_can_be_null=True,
            ),
        )
    except (pa.ArrowException, UnicodeDecodeError, LookupError, OSError) as error:
        raise InputError(f"{file}: {_cell_error(str(error), layout)}") from None
    out = []
    for name, number in zip(chosen, wanted, strict=True):
        if name not in stamps:
            out.append(np.asarray(table.column(name).to_numpy(), dtype=float))
            continue
        texts = [text or "" for text in table.column(name).to_pylist()]
        seconds = seconds_of_stamps(texts, f"{file}, column {layout.headers[number]}")
        if part:
            seconds = seconds + unit * np.asarray(table.column(part).to_numpy(), dtype=float)
        out.append(seconds)
    return out


def _cell_error(message: str, layout: TextLayout) -> str:
    """Say in which column pyarrow met something that is no number."""
    found = re.search(r"In CSV column #(\d+): (?:Row #(\d+): )?(.*)", message)
    if found is None:
        return message
    column, row, words = found.groups()
    where = f"column {layout.headers[int(column)]!r}" + (f", row {row}" if row else "")
    words = words.replace("CSV conversion error to double: ", "")
    return f"{where}: {words}; correct the cell, or leave it empty where no value was measured"


def split_line(line: str, delimiter: str) -> list[str]:
    """Return the cells of a line."""
    if delimiter == BLANKS:
        line, delimiter = _tabbed(line, names=not looks_numeric(line.split())), "\t"
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter), [])]
    except csv.Error:  # a cell longer than any name or number
        return [line]


def _tabbed(line: str, *, names: bool = False) -> str:
    """Put tabs between columns that stand between blanks; names with blanks in them stand two apart."""
    line = line.strip()
    if not names:
        return "\t".join(line.split())
    line = line.lstrip("#% ")
    wide = re.split(r"\s{2,}|\t", line)
    # a unit in brackets belongs to the word before it
    return "\t".join(wide if len(wide) > 1 else re.split(r"\s+(?![\[(])", line))


def _decimal_comma(lines: Sequence[str], delimiter: str) -> bool:
    cells = [cell for line in lines[:200] for cell in split_line(line, delimiter)]
    commas = sum("," in cell and bool(NUMBER.match(cell)) for cell in cells)
    points = sum("." in cell and bool(NUMBER.match(cell)) for cell in cells)
    return commas > points
