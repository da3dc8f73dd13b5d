"""[columns] of a drafted campaign.toml: a line for each column, mapped or not, and why."""

import re
from collections.abc import Mapping, Sequence
from itertools import starmap

import numpy as np

from slipwise.campaign.draft.column import Column, Mapped, column_of
from slipwise.campaign.draft.data_files import DataFile, is_ours, one_line
from slipwise.channels import channel
from slipwise.data_files.column_names import kind_of
from slipwise.errors import SlipwiseError
from slipwise.units import parse_unit

#: Meaning of a column's name -> channel that it may be, where its numbers were too few to tell.
_BY_NAME: tuple[tuple[str, str], ...] = (
    ("time", "time"),
    ("length", "slip_x"),
    ("speed", "slip_vx"),
    ("load", "pad_A_N"),
    ("pressure", "pad_A_P"),
    ("friction", "pad_A_Fx"),
    ("loading", "pad_A_N"),
    ("force", "pad_A_Fx"),
    ("coefficient", "pad_A_Fx"),
    ("temperature", "pad_A_T"),
    ("table", "table_ax"),
    ("girder", "girder_ax"),
    ("acceleration", "girder_ax"),
)


_ACROSS = "a displacement across the sliding plane"


def column_lines(
    files: Sequence[DataFile], ours: Sequence[str], mapped: Mapping[str, Mapped], left: Mapping[str, str]
) -> list[str]:
    """Return [columns]: lines for what was recognised, or whose words and unit fit a channel, comments for the rest.

    Args:
        files: of the folder.
        ours: channels that files name as we do.
        mapped: header -> channel.
        left: header -> why the numbers of a column show that it is no channel.
    """
    headers = list(dict.fromkeys(h for file in files for h in file.headers if not is_ours(h) and h))
    if not headers:
        return []
    looked = {column.header: column for file in reversed(files) for column in file.columns}
    unread = {**left, **{header: why for file in reversed(files) for header, why in file.unread.items()}}
    gaps = {header: why for file in reversed(files) for header, why in file.gaps.items()}
    lines, taken = ["[columns]"], {name: name for name in ours} | {m.channel: h for h, m in mapped.items()}
    level = any(c.kind == "length" and not c.no_channel and "up" not in c.meanings for c in looked.values())
    for header in headers:
        if header in mapped:
            lines.append(_line(header, mapped[header]))
            continue
        column = looked.get(header) or column_of(header, np.zeros(0))
        guess, unit = _guess(column), "1" if column.kind == "coefficient" else column.unit
        across = level and column.kind == "length" and "up" in column.meanings
        if guess and guess not in taken and header not in unread and not across:
            taken[guess] = header
            entry = f"{{ channel = {quoted(guess)}, unit = {quoted(unit)} }}"
            missing = f"; {gaps[header]}" if header in gaps else ""
            lines.append(
                f"{quoted(header)} = {entry}   # decide: guess by its name: channel, sign (sign = -1 turns it){missing}"
            )
        else:
            why = (
                unread.get(header)
                or column.no_channel
                or (_ACROSS if across else "")
                or gaps.get(header)
                or _why_not(column, guess, taken)
            )
            entry = f'{{ channel = "...", unit = {quoted("..." if unit == "?" else unit)} }}'
            lines.append(f"# {quoted(header)} = {entry}   # decide: not used: {one_line(why)}")
    return [*lines, ""]


def own_column_lines(mapped: Mapping[str, Mapped]) -> list[str]:
    """Return [run.columns]: the columns of a run whose file holds them in another order than the others."""
    if not mapped:
        return []
    return ["[run.columns]   # decide: in this file the levels stand in another order", *starmap(_line, mapped.items())]


def _line(header: str, mapped: Mapped) -> str:
    sign = ", sign = -1" if mapped.sign < 0 else ""
    entry = f"{{ channel = {quoted(mapped.channel)}, unit = {quoted(mapped.unit)}{sign} }}"
    return f"{quoted(header)} = {entry}   # decide: {mapped.sure}: {one_line(mapped.why)}"


def _guess(column: Column) -> str:
    """Return the channel that a header's words and unit both fit; "" where none does."""
    if column.no_channel or column.meanings & {"across", "path"}:
        return ""
    for meaning, wanted in _BY_NAME:
        if meaning not in column.meanings and meaning != column.kind:
            continue
        unit = "1" if meaning == "coefficient" else channel(wanted).unit
        fits = column.kind == kind_of(unit) if column.unit == "?" else _fits(column.unit, unit)
        if fits:
            return wanted
    return ""


def _fits(unit: str, dimension_of: str) -> bool:
    try:
        parse_unit(unit, dimension_of, "")
    except SlipwiseError:
        return False
    return True


def _why_not(column: Column, guess: str, taken: Mapping[str, str]) -> str:
    if guess:
        return f"{guess} is taken from {taken[guess]!r}" if taken[guess] != guess else f"{guess} is there already"
    if not column.kind and column.unit == "?":
        return "neither its name nor a unit says what it is"
    if not column.kind:
        return f"no channel has the unit {column.unit!r}"
    return f"nothing tells which {column.kind} of the rig it is"


def quoted(text: str) -> str:
    """Return a text of TOML."""
    plain = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + re.sub(r"[\x00-\x1f\x7f]", " ", plain) + '"'
