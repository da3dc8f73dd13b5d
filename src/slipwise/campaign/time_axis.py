"""The times of a data file: its column, or its number of samples and the rate that file or campaign state."""

from collections.abc import Mapping

import numpy as np

from slipwise.arrays import Array
from slipwise.data_files.table import Table
from slipwise.data_files.table_rows import RowBlock
from slipwise.errors import InputError

#: A stated rate may be off by this much, as clocks of loggers are [1].
_CLOCK = 0.01
#: Steps beyond these are slips of a unit [s].
_STEP_RANGE = (1e-6, 10.0)


def time_of_file(
    name: str,
    column: Array | None,
    channels: Mapping[str, Array],
    table: Table,
    tables: tuple[RowBlock, ...],
    rate: float | None,
) -> tuple[Array, tuple[str, ...]]:
    """Return the times of a file.

    Args:
        name: of the file, for messages.
        column: its column of times (n,) [s], None if no column holds them.
        channels: what else was read, each (n,).
        table: the file.
        tables: of the file, where it holds more than one.
        rate: what campaign.toml says of it [Hz], None if it says nothing.

    Returns:
        The times (n,) [s], and what should be known of them.

    Raises:
        InputError: nothing tells the times, or two places contradict each other.
    """
    stated = table.step
    if column is not None:
        return column, _checked(name, column, stated, rate)
    if tables:
        raise InputError(
            f"{name}: it holds {len(tables)} tables, from lines {', '.join(str(block.line) for block in tables)} on, "
            "and no column of times tells whether they are one record; give each a run of its own: "
            f'file = "{name}#1", file = "{name}#2"'
        )
    if rate is not None and stated is not None and abs(rate * stated - 1.0) > _CLOCK:
        raise InputError(
            f"{name}: the file states a sample rate of {1.0 / stated:g} Hz, campaign.toml {rate:g} Hz; correct one of "
            "them"
        )
    step = 1.0 / rate if rate is not None else stated
    if step is None or not channels:
        raise InputError(
            f"{name}: no column holds the time; its columns are {', '.join(map(repr, table.headers))}; name a "
            'column "time [s]", map one in [columns] with channel = "time", or write sample_rate = "500 Hz" '
            "in campaign.toml"
        )
    by = "campaign.toml" if rate is not None else "the file"
    count = len(next(iter(channels.values())))
    times = np.arange(count, dtype=np.float64) * step
    return times, (f"{name}: times from the sample rate of {1.0 / step:g} Hz that {by} states",)


def _checked(name: str, column: Array, stated: float | None, rate: float | None) -> tuple[str, ...]:
    """Hold a column of times against the rates that campaign.toml and the file state; give what should be known.

    Raises:
        InputError: they contradict each other.
    """
    usual = float(np.median(np.diff(column))) if len(column) > 1 and np.isfinite(column).all() else 0.0
    if usual <= 0.0:
        return ()  # the times themselves are wrong, and are refused with their row
    if rate is not None and abs(usual * rate - 1.0) > _CLOCK:
        raise InputError(
            f"{name}: its times advance by {usual:g} s, sample_rate = {rate:g} Hz says {1.0 / rate:g} s; correct one "
            "of them"
        )
    if stated is None or abs(usual / stated - 1.0) <= _CLOCK:
        return ()
    words = f"{name}: its times advance by {usual:g} s, the lines above them state {1.0 / stated:g} Hz"
    if rate is None:
        raise InputError(
            f'{words}; correct one of them, or write sample_rate = "{1.0 / usual:g} Hz" in campaign.toml where the '
            "times are right"
        )
    return (f"{words}; the times agree with campaign.toml and are taken",)


def check_time(name: str, time: Array, tables: tuple[RowBlock, ...]) -> None:
    """Refuse times that no record has.

    Args:
        name: of the file.
        time: (n,) [s].
        tables: of the file, where it holds more than one.

    Raises:
        InputError: too few, missing, running backwards, or in steps that no logger takes.
    """
    if len(time) < 2:
        raise InputError(f"{name}: it holds {len(time)} rows of data, and a record needs two and more; write it again")
    bad = np.flatnonzero(~np.isfinite(time))
    if len(bad):
        raise InputError(
            f"{name}: the time is missing in {len(bad)} rows, first in data row {bad[0] + 1}; every sample needs one: "
            "cut these rows off, or write the file again"
        )
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if len(back):
        k = int(back[0])
        starts = np.cumsum([block.rows for block in tables])
        if k + 1 in starts:
            number = int(np.flatnonzero(starts == k + 1)[0]) + 2
            raise InputError(
                f"{name}: it holds {len(tables)} tables, and the time starts anew in line {tables[number - 1].line}; "
                f'give each a run of its own: file = "{name}#1", file = "{name}#{number}"'
            )
        words = "repeats" if time[k + 1] == time[k] else "runs backwards"
        raise InputError(
            f"{name}: the time {words} {len(back)} times, first from {time[k]:.6g} s in data row {k + 1} to "
            f"{time[k + 1]:.6g} s; every sample needs a later time than the one before: "
            "export it again, or cut it where the time jumps"
        )
    step = float(np.median(np.diff(time)))
    if not _STEP_RANGE[0] <= step <= _STEP_RANGE[1]:
        raise InputError(f"{name}: its times advance by {step:.3g} s; is the unit of the time right?")
