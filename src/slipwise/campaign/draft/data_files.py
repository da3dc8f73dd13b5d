"""The data files of a folder, opened for a draft: their columns of numbers, and why others are not looked at."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.draft.column import Column, column_of
from slipwise.channels import channel, is_channel
from slipwise.data_files.table import COMPANIONS, SUFFIXES, Table, open_table
from slipwise.errors import InputError, SlipwiseError
from slipwise.units import affine

_OURS = re.compile(r"^(?P<name>[A-Za-z]\w*)\s*\[(?P<unit>[^\]]*)\]$")


@dataclass(frozen=True)
class DataFile:
    """A data file of the folder.

    Attributes:
        path: of it.
        headers: of its columns.
        known: channels that it names as we do, each (n,) SI.
        columns: the others that hold numbers in every row.
        unread: header -> why a column cannot be used.
        gaps: header -> what is missing in a column, which only its name can tell.
        step: that it states beside its columns [s], None if it states none.
        notes: what a user should know of it.
    """

    path: Path
    headers: tuple[str, ...]
    known: Mapping[str, Array]
    columns: tuple[Column, ...]
    unread: Mapping[str, str]
    gaps: Mapping[str, str]
    step: float | None
    notes: tuple[str, ...]


def is_ours(header: str) -> bool:
    """Return whether a header names a channel as we do, with its unit."""
    match = _OURS.match(header)
    return bool(match and is_channel(match["name"]))


def open_data_files(folder: Path) -> tuple[list[DataFile], list[str]]:
    """Open what can be a data file; say what is passed over and why."""
    files, passed = [], []
    for path in sorted(p for p in folder.iterdir() if p.is_file() and not p.name.startswith(".")):
        if path.suffix.lower() in COMPANIONS:
            continue
        if path.suffix.lower() not in SUFFIXES:
            passed.append(f"{path.name} (no data file)")
            continue
        try:
            files.append(_opened(path))
        except InputError as error:
            words = str(error).removeprefix(f"{path}: ").removeprefix(f"{path.name}: ").removeprefix(f"{path.name}, ")
            passed.append(f"{path.name} ({one_line(words)})")
    return files, passed


def one_line(text: str) -> str:
    """Return a text that fits in a comment."""
    return " ".join(text.split())[:160]


def _opened(path: Path) -> DataFile:
    """Read all columns of a file that hold numbers.

    Raises:
        InputError: no column can be read.
    """
    table = open_table(path)
    known: dict[str, Array] = {}
    columns: list[Column] = []
    unread: dict[str, str] = {}
    gaps: dict[str, str] = {}
    for header, values in zip(table.headers, _read(table), strict=True):
        if header and table.headers.count(header) > 1:
            unread[header] = f"{table.headers.count(header)} columns have this name; give each its own"
            continue
        if values is None or not np.isfinite(values).any():
            unread[header] = "it holds no numbers"
            continue
        if not np.isfinite(values).all():
            gaps[header] = f"{int(np.sum(~np.isfinite(values)))} of its {len(values)} values are missing"
            continue
        match = _OURS.match(header)
        if match and is_channel(match["name"]):
            try:
                factor, offset = affine(match["unit"], channel(match["name"]).unit, header)
            except SlipwiseError:
                continue
            known[match["name"]] = factor * values + offset
        else:
            columns.append(column_of(header, values))
    return DataFile(path, table.headers, known, tuple(columns), unread, gaps, table.step, table.notes)


def _read(table: Table) -> list[Array | None]:
    """Read all columns of a table (n,) each, None for those that are words.

    Raises:
        InputError: no column can be read.
    """
    every = range(len(table.headers))
    try:
        return list(table.columns(every).values)
    except InputError:
        columns = [_alone(table, i) for i in every]
        if all(column is None for column in columns):
            raise
        return columns


def _alone(table: Table, i: int) -> Array | None:
    try:
        return table.columns([i]).values[0]
    except InputError:
        return None
