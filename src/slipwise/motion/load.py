"""The one way in: a table motion from files or from a description."""

from collections.abc import Sequence
from pathlib import Path

from slipwise.errors import InputError, SettingError
from slipwise.motion.components import join_files
from slipwise.motion.stated import Given
from slipwise.motion.synthetic import looks_synthetic, parse_motion, synthetic_motions
from slipwise.motion.table_motion import AXES, TableMotion
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

    Without `x`, `y`, `z` the names of the components decide: x (shaking direction) is the east-west component, as in
    the paper (Fig. 6), or else the first horizontal one; y the other horizontal one; z the vertical one. DWN is minus
    UP: it is reversed. Components keep the sign that the agency gave them otherwise. Components start together; the
    longer ones lose their ends. They must be of one record: station, sensor, event and start are compared.

    Args:
        specs: one synthetic motion ("sine:2Hz,0.3g"), or the files of a recorded one, of any of the formats; none if
            `x`, `y` or `z` name files.
        x: what shakes in x: a component's name ("EW"), a file, or "none". A leading minus reverses the sign ("-N28W");
            with a leading sign a component is taken as it stands, so "-DWN" is up, as "DWN" alone is.
        y: the same across.
        z: the same upwards.
        dt: step of files that do not state it: seconds, or text with a unit ("5 ms").
        unit: unit of acceleration of files that do not state it.
        baseline: "mean", "linear" or "none"; by default what the format asks for (K-NET and KiK-net: mean).
        join_anyway: join components of different records with a warning, instead of refusing them.
        count: acceleration of one count of a digitizer whose file holds counts, "2.4e-6 m/s^2".
        allow_short: take a record that is a few values shorter than its header promises, with a warning.

    Raises:
        InputError: files and descriptions mixed, settings that a synthetic motion cannot use, a file that is missing or
            damaged, steps that differ, components that cannot be told apart or are of different records, or gravity in
            one of them.
        UnitError: a unit is missing, unknown or of the wrong dimension.
        UnknownNameError: no such kind of motion, option, component or file.
    """
    given = [specs] if isinstance(specs, str | Path) else list(specs)
    described = [str(spec) for spec in given if is_description(spec)]
    if not described:
        step = quantity(dt, "s", "dt") if isinstance(dt, str) else dt
        choices = {axis: str(choice) for axis, choice in zip(AXES, (x, y, z), strict=True) if choice is not None}
        stated = Given(step, unit, count, allow_short)
        return join_files([Path(file) for file in given], choices, stated, baseline, join_anyway)
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
