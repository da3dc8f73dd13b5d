"""Plain columns: acceleration alone, time and acceleration, or more with a header that names each with its unit.

What the file does not state, step or unit, must be given. A headless time column has no unit either, so it only
confirms the step that was given.
"""

from slipwise.errors import InputError, UnitError
from slipwise.motion.orientation import name_from_stem
from slipwise.motion.rows import find_first_row, read_rows
from slipwise.motion.source_file import SourceFile
from slipwise.motion.stated import Given, acceleration_factor, settle_step, settle_unit
from slipwise.motion.time_column import column_step
from slipwise.motion.trace import Trace

#: What a headless column of times may be in.
_SECONDS_PER = {"s": 1.0, "ms": 1e-3}


def recognise(head: bytes) -> bool:
    """Tell whether some line of the head holds nothing but numbers."""
    # The head may cut its last line anywhere.
    lines = head.decode("latin-1").splitlines()
    return find_first_row(lines if len(lines) < 2 else lines[:-1]) is not None


def read(source: SourceFile, given: Given) -> list[Trace]:
    """Read every column of acceleration.

    Raises:
        InputError: no step, rows that are damaged, times that do not rise evenly, columns that nothing names.
        UnitError: no unit, or one that is none of acceleration.
    """
    rows = read_rows(source)
    columns = rows.values.shape[1]
    has_time = _is_time(rows.units[0]) if rows.units else columns > 1
    if columns > 2 and not rows.units:
        raise InputError(
            f"{source.name}: {columns} columns without a header that names them; write one as the last line above "
            "the numbers, for example 'time [s],EW [cm/s^2],NS [cm/s^2],UD [cm/s^2]'"
        )
    stated_step = column_step(rows, source) if has_time else None
    if has_time and not rows.units:
        # A headless column of times has no unit: the step must be given all the same.
        settle_step(None, given, source)
        stated_step = _headless_step(stated_step or 0.0, given, source)
    dt, dt_words = settle_step(stated_step, given, source)
    names = rows.names[1 if has_time else 0 :] or ("",)
    stated_units = rows.units[1 if has_time else 0 :]
    traces = []
    for k, name in enumerate(names):
        factor, unit_words = settle_unit(stated_units[k] if stated_units else None, given, source)
        called = name if len(names) > 1 else name_from_stem(source.stem) or source.stem
        traces.append(
            Trace(
                source=source,
                name=called,
                title=rows.title or source.stem,
                dt=dt,
                acceleration=rows.values[:, k + has_time] * factor,
                baseline="none",
                treatment=(f"read as text columns: {source.name}, component {called}", f"{unit_words}; {dt_words}"),
            )
        )
    return traces


def _headless_step(step: float, given: Given, source: SourceFile) -> float:
    """Hold a headless time column against the step that was given."""
    for seconds in _SECONDS_PER.values():
        if given.dt is not None and abs(step * seconds - given.dt) <= 1e-4 * given.dt:
            return step * seconds
    given_words = f"{given.dt:g} s" if given.dt is not None else "nothing"
    raise InputError(
        f"{source.name}: the first column advances by {step:g} a row, {given_words} was given as the step; neither in "
        f"{' nor in '.join(_SECONDS_PER)} do they agree"
    )


def _is_time(unit: str) -> bool:
    """Tell whether the first column's unit is one of time, or at least none of acceleration."""
    try:
        acceleration_factor(unit, "")
    except UnitError:
        return True
    return False
