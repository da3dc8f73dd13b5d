"""Columns of time stamps, read as seconds: "2031-02-03 10:15:00.01", "03.02.2031 10:15:00", "10:15:00", "15:00.0"."""

import re
from collections.abc import Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import InputError

_CLOCK = (
    r"(?:(?P<hour>\d{1,2}):(?P<minute>\d{2}):(?P<second>\d{2}(?:[.,:]\d+)?)\s*(?P<half>[AaPp][Mm])?|"
    # a spreadsheet shows minutes and seconds where seconds have fractions
    r"(?P<minutes>\d{1,2}):(?P<seconds>\d{2}[.,]\d+))"
)
_STAMP = re.compile(
    r"^\"?\s*(?:(?:(?P<year>\d{4})[-/.](?P<month>\d{1,2})[-/.](?P<day>\d{1,2})|"
    r"(?P<one>\d{1,2})(?P<sign>[-/.])(?P<two>\d{1,2})[-/.](?P<long>\d{4}))[T\s]+)?" + _CLOCK + r"\s*Z?\"?$"
)
_DAY, _HOUR = 86400.0, 3600.0


def is_time_stamp(text: str) -> bool:
    """Return whether a cell is a time stamp."""
    return ":" in text and bool(_STAMP.match(text.strip()))


def seconds_of_stamps(texts: Sequence[str], what: str) -> Array:
    """Return the seconds since the first stamp (n,).

    Args:
        texts: the cells.
        what: the column, for messages.

    Raises:
        InputError: a cell that is no time stamp, or days and months that cannot be told apart.
    """
    found = [_STAMP.match(text.strip()) for text in texts]
    for row, (match, text) in enumerate(zip(found, texts, strict=True), 1):
        if match is None:
            raise InputError(f"{what}, row {row}: {text[:40]!r} is no time stamp like those above it")
    stamps = [match for match in found if match is not None]
    if not stamps:
        return np.zeros(0)
    seconds = np.array([_clock(match) for match in stamps])
    days = _days(stamps, what)
    if days is None:
        # Without a date midnight, or a full hour, shows as a jump back by most of a day, or of an hour.
        turn = _DAY if stamps[0]["hour"] else _HOUR
        seconds = seconds + turn * np.cumsum(np.concatenate([[0.0], np.diff(seconds) < -0.5 * turn]))
    else:
        seconds = seconds + _DAY * (days - days[0])
    return seconds - seconds[0]


def _clock(match: re.Match[str]) -> float:
    if match["seconds"]:
        return 60.0 * int(match["minutes"]) + float(match["seconds"].replace(",", "."))
    hour = int(match["hour"])
    if match["half"]:
        hour = hour % 12 + (12 if match["half"].lower() == "pm" else 0)
    return 3600.0 * hour + 60.0 * int(match["minute"]) + float(re.sub("[,:]", ".", match["second"]))


def _days(stamps: Sequence[re.Match[str]], what: str) -> Array | None:
    """Return the day of each stamp, None where there are no dates.

    "03.02.2031" has the day first; "2/3/2031" is the day or the month first, and matters only if the date changes.
    """
    if all(match["year"] for match in stamps):
        dates = [f"{m['year']}-{int(m['month']):02d}-{int(m['day']):02d}" for m in stamps]
    elif all(match["long"] for match in stamps):
        changes = len({match[0].split()[0] for match in stamps}) > 1
        if changes and any(match["sign"] == "/" for match in stamps):
            raise InputError(
                f"{what}: the date changes, and in {stamps[0][0].split()[0]!r} day and month cannot be told apart; "
                "write the year first, or export the time in seconds"
            )
        dates = [f"{m['long']}-{int(m['two']):02d}-{int(m['one']):02d}" for m in stamps]
        if not changes:
            return np.zeros(len(stamps))
    else:
        return None
    try:
        return np.array(dates, dtype="datetime64[D]").astype(float)
    except ValueError as error:
        raise InputError(f"{what}: a date does not exist ({error}); export the time in seconds") from None
