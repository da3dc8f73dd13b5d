"""Three components of a table from the components of one or several files."""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from slipwise.errors import InputError, SlipwiseWarning, UnknownNameError, unknown_name
from slipwise.motion.baseline import without_baseline
from slipwise.motion.detect import read_file
from slipwise.motion.joining import check_one_record, common_starts
from slipwise.motion.orientation import orientation, plain
from slipwise.motion.plausibility import check_gravity, warn_of_peak
from slipwise.motion.stated import Given
from slipwise.motion.stated_peak import check_stated_peak
from slipwise.motion.table_motion import AXES, TableMotion
from slipwise.motion.trace import Baseline, Trace

#: What a user writes to leave an axis at rest.
AT_REST = "none"


def join_files(
    files: Sequence[Path], choices: Mapping[str, str], given: Given, baseline: Baseline | None, join_anyway: bool
) -> TableMotion:
    """Read files of any of the formats and join their components; arguments and errors as in `load_motion`.

    Args:
        files: may be empty if the choices name files.
        choices: axis -> what shakes in it, where a user says so.
        given: what a user says of step, unit and count.
        baseline: how it is treated; None for what the format asks for.
        join_anyway: join components of different records with a warning.
    """
    if "" in choices.values():
        raise InputError(f"a component has no name; give --x, --y and --z a name, a file, or {AT_REST!r}")
    read = {file: read_file(file, given) for file in dict.fromkeys(files)}
    for choice in choices.values():
        traces = [trace for group in read.values() for trace in group]
        file = _file_of(_sign_and_name(choice, read, traces)[1], read)
        if file is not None and file not in read:
            read[file] = read_file(file, given)
    read = _letters_judged(read)
    traces = [trace for group in read.values() for trace in group]
    if not traces:
        raise InputError("no motion is given; name a file or a synthetic motion such as sine:2Hz,0.3g")
    chosen: dict[str, tuple[Trace, int] | None] = {}
    for axis, choice in choices.items():
        chosen[axis] = None if choice.lower() == AT_REST else _pick(axis, choice, traces, read)
    taken = [pair[0] for pair in chosen.values() if pair]
    if files:
        _fill_by_name(chosen, [trace for trace in traces if not any(trace is other for other in taken)])
    pairs = {axis: chosen.get(axis) for axis in AXES}
    for trace in traces:
        check_stated_peak(trace, given.unit, used=any(pair is not None and pair[0] is trace for pair in pairs.values()))
    return _assemble(pairs, baseline, join_anyway)


def _letters_judged(read: dict[Path, list[Trace]]) -> dict[Path, list[Trace]]:
    """Take the last letter of a file's name for a component only where another component is there."""
    traces = [trace for group in read.values() for trace in group]
    if len({trace.name for trace in traces}) > 1 or not any(trace.letter_of_file for trace in traces):
        return read
    return {
        file: [replace(t, name=t.source.stem, aliases=(*t.aliases, t.name)) if t.letter_of_file else t for t in group]
        for file, group in read.items()
    }


def _file_of(text: str, read: dict[Path, list[Trace]]) -> Path | None:
    """Return the file of this name or path, None if there is none."""
    named = [file for file in read if file.name == text or file.resolve() == Path(text).resolve()]
    if len(named) == 1:
        return named[0]
    return Path(text) if Path(text).is_file() else None


def _sign_and_name(choice: str, read: dict[Path, list[Trace]], traces: list[Trace]) -> tuple[int | None, str]:
    """Split "-EW" into -1 and "EW"; the sign is None where none is written, or where it begins a name, as in "+V"."""
    if choice[0] not in "+-" or _file_of(choice, read) or any(trace.name == choice for trace in traces):
        return None, choice
    return (-1 if choice[0] == "-" else 1), choice[1:]


def _pick(axis: str, choice: str, traces: list[Trace], read: dict[Path, list[Trace]]) -> tuple[Trace, int]:
    """Return the component that a user chose for an axis, and its sign."""
    sign, name = _sign_and_name(choice, read, traces)
    file = _file_of(name, read)
    candidates = read[file] if file else _called(name, traces)
    where = "name the component instead" if file else "give its file instead"
    if not candidates:
        error = unknown_name("component or file", name, {trace.name for trace in traces})
        raise UnknownNameError(f"{axis}: {error}")
    if len(candidates) > 1:
        raise InputError(
            f"{axis} = {choice!r} may be {' or '.join(f'{t.name} of {t.source.name}' for t in candidates)}; {where}"
        )
    if sign is None:
        sign = -1 if axis == "z" and orientation(candidates[0].name) == "down" else 1
    return candidates[0], sign


def _called(name: str, traces: list[Trace]) -> list[Trace]:
    """Return the components of this name or, where none has it, of this number: "Long", "Chan 3", "3"."""
    named = [trace for trace in traces if trace.name == name]
    named = named or [trace for trace in traces if plain(trace.name) == plain(name)]
    return named or [trace for trace in traces if plain(name) in {plain(alias) for alias in trace.aliases}]


def _fill_by_name(chosen: dict[str, tuple[Trace, int] | None], left: list[Trace]) -> None:
    """Return the axes that the user left open what the components' names say."""
    where = {id(trace): orientation(trace.name) for trace in left}
    open_axes = [axis for axis in AXES if axis not in chosen]
    vertical = [trace for trace in left if where[id(trace)] in ("up", "down", "table z")]
    unknown = [trace for trace in left if where[id(trace)] == "unknown"]
    level = [trace for trace in left if trace not in vertical and trace not in unknown]
    level.sort(key=lambda t: {"table x": 0, "east-west": 1, "horizontal": 2, "table y": 3}[where[id(t)]])
    if unknown and len(left) == 1 and "x" in open_axes:
        level, unknown = unknown, []
    # A horizontal axis that is set to rest may leave its component over; one too many is ambiguous.
    level_places = 2 - sum(chosen.get(axis) is not None for axis in ("x", "y"))
    if (
        (unknown and open_axes)
        or (len(vertical) > 1 and "z" in open_axes)
        or (len(level) > level_places and ("x" in open_axes or "y" in open_axes))
    ):
        names = ", ".join(_described(trace) for trace in left)
        raise InputError(
            f"which component is which cannot be told from these names: {names}; say it with --x, --y and --z, "
            f"each a component's name or number, a file, or {AT_REST!r}"
        )
    if "z" in open_axes and vertical:
        chosen["z"] = (vertical[0], -1 if where[id(vertical[0])] == "down" else 1)
    # table_ay alone stays on y.
    if "y" in open_axes and level and where[id(level[-1])] == "table y":
        chosen["y"] = (level.pop(), 1)
    for axis in ("x", "y"):
        if axis in open_axes and axis not in chosen and level:
            chosen[axis] = (level.pop(0), 1)


def _described(trace: Trace) -> str:
    numbered = f"{trace.aliases[-1]}: " if trace.aliases else ""
    return f"{numbered}{trace.name}{f' at {trace.origin.place}' if trace.origin.place else ''} ({trace.source.name})"


def _assemble(chosen: dict[str, tuple[Trace, int] | None], baseline: Baseline | None, join_anyway: bool) -> TableMotion:
    """Join the chosen components; unequal ends are cut, unequal steps and records are refused."""
    pairs = [pair for pair in chosen.values() if pair is not None]
    if not pairs:
        raise InputError("no component is left to shake the table; give --x, --y or --z another value than 'none'")
    first = pairs[0][0]
    check_one_record([trace for trace, _ in pairs], join_anyway)
    for trace, _ in pairs:
        # Together over the whole record, to a tenth of a sample.
        if abs(trace.dt - first.dt) * len(first.acceleration) > 0.1 * first.dt:
            raise InputError(
                f"the components have different steps: {first.name} ({first.source.name}) {first.dt:g} s, "
                f"{trace.name} ({trace.source.name}) {trace.dt:g} s; resample one of the files"
            )
    skipped = {id(t): n for (t, _), n in zip(pairs, common_starts([t for t, _ in pairs]), strict=True)}
    lengths = {axis: len(pair[0].acceleration) - skipped[id(pair[0])] for axis, pair in chosen.items() if pair}
    length = min(lengths.values())
    acceleration = np.zeros((length, 3))
    treatment: list[str] = []
    if any(skipped.values()):
        cut = ", ".join(f"{trace.name} {skipped[id(trace)] * trace.dt:g} s" for trace, _ in pairs)
        treatment.append(f"cut to the time that all components share; before it lay {cut}")
    names, peaks = [], []
    for column, axis in enumerate(AXES):
        pair = chosen[axis]
        if pair is None:
            names.append("")
            peaks.append(None)
            continue
        trace, sign = pair
        check_gravity(trace, axis, baseline)
        values, words = without_baseline(trace.acceleration, baseline or trace.baseline)
        start = skipped[id(trace)]
        acceleration[:, column] = sign * values[start : start + length]
        name = f"-{trace.name}" if sign < 0 else trace.name
        names.append(name)
        peaks.append(trace.header_peak)
        treatment += [f"{axis}: {words}" for words in (*trace.treatment, words, f"{name} drives the table in {axis}")]
    # Channels that begin late end late; one that ends sooner than that is cut off.
    if max(lengths.values()) - length > max(skipped.values()):
        counts = ", ".join(f"{axis} {count}" for axis, count in lengths.items())
        words = f"components of unequal length ({counts} samples): the first {length} of each are used"
        warnings.warn(f"{first.title}: {words}", SlipwiseWarning, stacklevel=4)
        treatment.append(words)
    if chosen["x"] is None and chosen["y"] is None:
        warnings.warn(
            f"{first.title}: there is no horizontal component; the table moves only up and down",
            SlipwiseWarning,
            stacklevel=4,
        )
    sources = dict.fromkeys((trace.source.name, trace.source.sha256) for trace, _ in pairs)
    motion = TableMotion(
        dt=first.dt,
        acceleration=acceleration,
        title=" ".join(first.title.split()),
        components=(names[0], names[1], names[2]),
        treatment=tuple(treatment),
        sources=tuple(sources),
        header_peaks=(peaks[0], peaks[1], peaks[2]),
    )
    warn_of_peak(motion)
    return motion
