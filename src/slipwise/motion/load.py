"""The one way in: a table motion from files or from a description."""

from collections.abc import Sequence
from pathlib import Path

from slipwise.errors import InputError, SettingError
from slipwise.motion.components import read_motion
from slipwise.motion.synthetic import looks_synthetic, parse_motion, synthetic_motions
from slipwise.motion.table_motion import TableMotion
from slipwise.motion.trace import Baseline
from slipwise.units import quantity


def load_motion(
    specs: str | Path | Sequence[str | Path],
    *,
    x: str | Path | None = None,
    y: str | Path | None = None,
    z: str | Path | None = None,
    dt: float | str | None = None,
    unit: str | None = None,
    baseline: Baseline | None = None,
    join_anyway: bool = False,
    count: str | None = None,
    allow_short: bool = False,
) -> TableMotion:
    """Return the table motion that a user names.

    Args:
        specs: one synthetic motion ("sine:2Hz,0.3g"), or the files of a recorded one.
        x: which component, or which file, shakes in x; "none" for rest. See `read_motion`.
        y: the same across.
        z: the same upwards.
        dt: step of files that do not state it: seconds, or text with a unit ("5 ms").
        unit: unit of acceleration of files that do not state it.
        baseline: "mean", "linear" or "none"; by default what the format asks for.
        join_anyway: join components of different records with a warning, instead of refusing them.
        count: acceleration of one count of a digitizer whose file holds counts, "2.4e-6 m/s^2".
        allow_short: take a record that is a few values shorter than its header promises, with a warning.

    Raises:
        InputError: files and descriptions mixed, settings that a synthetic motion cannot use, or a damaged file.
        UnitError: a unit is missing, unknown or of the wrong dimension.
        UnknownNameError: no such kind of motion, option, component or file.
    """
    given = [specs] if isinstance(specs, str | Path) else list(specs)
    described = [str(spec) for spec in given if is_description(spec)]
    if not described:
        step = quantity(dt, "s", "dt") if isinstance(dt, str) else dt
        return read_motion(
            given,
            x=x,
            y=y,
            z=z,
            dt=step,
            unit=unit,
            baseline=baseline,
            join_anyway=join_anyway,
            count=count,
            allow_short=allow_short,
        )
    if len(given) > 1:
        raise InputError(
            f"{described[0]} is a motion by itself; it cannot be joined with "
            f"{', '.join(str(spec) for spec in given if str(spec) != described[0]) or 'itself'}"
        )
    settings = {"x": x, "y": y, "z": z, "dt": dt, "unit": unit, "baseline": baseline, "count": count}
    unused = [f"--{name}" for name, value in settings.items() if value is not None]
    unused += [name for name, on in (("--join-anyway", join_anyway), ("--allow-short", allow_short)) if on]
    if unused:
        raise InputError(
            f"{described[0]}: {', '.join(unused)} belong to recorded motions; a synthetic one says everything itself "
            "(vertical=..., across=...)"
        )
    return parse_motion(described[0])


def as_motion(given: TableMotion | str | Path | Sequence[str | Path]) -> TableMotion:
    """Return the table motion that a user means: itself, a description ("sine:2Hz,0.3g"), or files.

    Raises:
        SettingError: something else.
        SlipwiseError: a description or file that cannot be read.
    """
    if isinstance(given, TableMotion):
        return given
    if not isinstance(given, str | Path | list | tuple):
        raise SettingError(
            "a motion is what load_motion gives, a description such as 'sine:2Hz,0.3g', or the path of a file; "
            f"got {type(given).__name__}"
        )
    return load_motion(given)


def is_description(spec: str | Path) -> bool:
    """Tell a synthetic motion from a file; what is there as a file is a file."""
    text = str(spec)
    try:
        if Path(text).exists():
            return False
    except (OSError, ValueError):
        return looks_synthetic(text)
    return looks_synthetic(text) or text.strip() in {kind.name for kind in synthetic_motions()}
