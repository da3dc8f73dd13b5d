"""Bare numbers above the values: the count, the step, or both ("4000 0.005"), told from what follows them."""

from dataclasses import dataclass

import numpy as np

from slipwise.errors import InputError
from slipwise.motion.number_rows import Rows
from slipwise.motion.source_file import SourceFile

#: Steps of samples that agencies use [s].
_STEP_RANGE = (1e-4, 0.1)
#: A first value this many times as far from the second as all others are from their neighbours is no sample.
_OUT_OF_LINE = 20.0


@dataclass(frozen=True)
class FirstLines:
    """What the first lines of numbers state.

    Attributes:
        rows: the rows below them.
        count: number of values that they state, None if they state none.
        step: the step that they state [s], None if they state none.
    """

    rows: Rows
    count: int | None = None
    step: float | None = None


def read_first_lines(rows: Rows, given_step: float | None, source: SourceFile) -> FirstLines:
    """Take count and step off the top of the rows.

    Args:
        rows: all lines of numbers.
        given_step: what the user says of the step [s].
        source: the file.

    Raises:
        InputError: the first number is out of line with all others, but is neither their count nor the step.
    """
    values = rows.values
    for lines, numbers in ((2, values[:2]), (1, values[:1])):
        top = [float(v) for row in numbers for v in row]
        if len(values) < lines + 1 or len(top) not in (1, 2):
            continue
        below = rows.below(lines).series().size
        if below < 2:
            continue
        counts = {below, len(values) - lines}
        rest = rows.below(lines)
        for count, step in (top, top[::-1]) if len(top) == 2 else ((top[0], None),):
            if count in counts and (step is None or _STEP_RANGE[0] <= step <= _STEP_RANGE[1]):
                return FirstLines(rest, int(count), step)
    if len(values) < 4 or any(len(row) != 1 for row in values[:4]):
        return FirstLines(rows)
    series = rows.series()
    jumps = np.abs(np.diff(series))
    usual = float(jumps[1:].max())
    written = source.lines[rows.places[0]].strip()
    is_given_step = given_step is not None and _same(series[0], given_step)
    if jumps[0] <= _OUT_OF_LINE * usual and (not is_given_step or _decimals(written) == _decimals_below(rows, source)):
        return FirstLines(rows)
    rest = rows.below(1)
    if is_given_step:
        return FirstLines(rest, None, given_step)
    like = "the step" if _STEP_RANGE[0] <= series[0] <= _STEP_RANGE[1] else "the number of values"
    cure = f"give --motion-dt '{written} s' if it is" if like == "the step" else "correct or delete that line"
    raise InputError(
        f"{source.at(rows.places[0])}: the first number, {written}, is out of line with the {len(series) - 1} below "
        f"it; it looks like {like}: {cure}"
    )


def _same(one: float, other: float) -> bool:
    return abs(one - other) <= 1e-9 * abs(other)


def _decimals(text: str) -> int:
    return len(text.replace(",", ".").partition(".")[2])


def _decimals_below(rows: Rows, source: SourceFile) -> int:
    return max(_decimals(source.lines[i].strip()) for i in rows.places[1:20])
