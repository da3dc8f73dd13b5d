"""Columns of fixed width, as Fortran wrote them: neighbours may touch, so splitting at blanks fails."""

from slipwise.errors import InputError
from slipwise.motion.source_file import SourceFile, number


def fixed_width(source: SourceFile, start: int, count: int, per_line: int, width: int) -> list[float]:
    """Read numbers that stand right-aligned in columns of one width.

    Args:
        source: the file.
        start: index of the first line.
        count: how many numbers.
        per_line: how many to a line; the last line may hold fewer.
        width: characters of a column.

    Returns:
        The numbers.

    Raises:
        InputError: the record ends too early, a line is shifted or too short, a field is no number.
    """
    check_format(per_line, width, source.at(start - 1))
    values: list[float] = []
    needed = -(-count // per_line)
    if start + needed > len(source.lines):
        raise InputError(
            f"{source.name}: the record is truncated: {count} values need {needed} lines from line {start + 1} on, "
            f"the file ends at line {len(source.lines)}; fetch it again"
        )
    for i in range(start, start + needed):
        line = source.lines[i].rstrip()
        expected = min(per_line, count - len(values))
        if len(line) != expected * width:
            # Right-aligned numbers end at a multiple of the width: anything else would cut numbers in two.
            raise InputError(
                f"{source.at(i)}: {expected} columns of {width} characters were expected, "
                f"the line has {len(line)} characters; the record is truncated or damaged, fetch the file again"
            )
        values.extend(number(line[k : k + width], source.at(i)) for k in range(0, len(line), width))
    return values


def check_format(per_line: int, width: int, place: str) -> None:
    """Refuse a Fortran format that no line of a record has.

    Raises:
        InputError: no columns, or more and wider ones than a line holds.
    """
    if not (0 < per_line <= 20 and 0 < width <= 30):
        raise InputError(f"{place}: the format of {per_line} columns of {width} characters is not possible")


def lines_of(count: int, per_line: int) -> int:
    """Return the number of lines that hold so many numbers."""
    return -(-count // per_line)
