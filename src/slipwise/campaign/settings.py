"""campaign.toml, read and checked, before any data file is opened."""

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from slipwise.campaign.campaign import ROLES, Logger
from slipwise.campaign.materiality import Materiality
from slipwise.channels import CHANNELS, channel, is_channel
from slipwise.errors import InputError, SettingError, unknown_name
from slipwise.input_file import read_input
from slipwise.rig.known import SPECIMEN_UNITS, SPECIMEN_WORDS
from slipwise.signals.filters import LowPass
from slipwise.units import quantity

_TOP = (
    *("name", "rig", "description", "sample_rate", "specimen", "columns", "constants", "derived", "logger"),
    *("materiality", "run"),
)
_RUN = ("file", "role", "window", "rest_before", "description", "columns")
_COLUMN = ("channel", "unit", "sign")
_LOWPASS = ("lowpass", "order", "phase")


@dataclass(frozen=True)
class ColumnMap:
    """One line of [columns]: where a channel is found in the files.

    Attributes:
        header: of the file's column.
        channel: name.
        unit: as written.
        sign: +1 or -1.
    """

    header: str
    channel: str
    unit: str
    sign: int


#: A file, and what its columns are beside what [columns] says.
Source = tuple[str, tuple[ColumnMap, ...]]


@dataclass(frozen=True)
class RunSettings:
    """One [[run]]; times in [s]; columns are those that mean something else in its file than [columns] says."""

    file: str
    role: str
    window: tuple[float, float] | None
    rest_before: float | None
    columns: tuple[ColumnMap, ...] = ()

    @property
    def source(self) -> Source:
        """What a file that was read belongs to: two runs may be cut from one file."""
        return self.file, self.columns


@dataclass(frozen=True)
class Settings:
    """What campaign.toml says; quantities in SI. The rate of samples is for files without a column of times."""

    name: str
    rig: str
    specimen: Mapping[str, float | str]
    columns: tuple[ColumnMap, ...]
    constants: Mapping[str, float]
    derived: Mapping[str, str]
    logger: Logger
    materiality: Materiality
    runs: tuple[RunSettings, ...]
    sample_rate: float | None = None

    def columns_of(self, run: RunSettings) -> tuple[ColumnMap, ...]:
        """Return what the columns of a run's file are: its own lines take the place of those of [columns].

        A line of [columns] with the same header or the same channel as one of the run's own does not count for it.
        """
        headers = {" ".join(own.header.split()) for own in run.columns}
        channels = {own.channel for own in run.columns}
        others = [c for c in self.columns if " ".join(c.header.split()) not in headers and c.channel not in channels]
        return (*others, *run.columns)


def read_settings(path: Path, *, runs_needed: bool = True) -> Settings:
    """Read and check campaign.toml.

    Args:
        path: of it.
        runs_needed: refuse one that names no run yet.

    Raises:
        InputError: no file, no TOML, or something that is needed is missing.
        UnknownNameError: a key, role or channel that does not exist, with the nearest ones.
        UnitError: a quantity without a unit or of the wrong dimension.
    """
    if not path.is_file():
        raise InputError(f"{path.parent} has no campaign.toml; `slipwise init {path.parent}` drafts one from its files")
    try:
        content = tomllib.loads(read_input(path).decode("utf-8-sig"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InputError(
            f"{path}: not valid TOML: {error}; texts stand in quotes, and every key has a line of its own"
        ) from None
    _keys(content, _TOP, f"{path.name}")
    for needed, example in (("rig", '"bridge1"'), ("run", '[[run]] with file = "..." and role = "fit"')):
        if needed not in content and (needed != "run" or runs_needed):
            raise InputError(f"{path}: {needed!r} is missing; write for example {example}")
    tables = ("specimen", "columns", "constants", "derived", "logger", "materiality")
    part = {key: _table(content.get(key, {}), f"[{key}] of {path.name}") for key in tables}
    runs = content.get("run", [])
    if not isinstance(runs, list) or (not runs and "run" in content):
        raise InputError(f"{path}: runs are written as [[run]] with double brackets, one for each run")
    return Settings(
        name=_text(content.get("name", path.resolve().parent.name), "name", path.name),
        rig=_text(content["rig"], "rig", path.name),
        specimen=_specimen(part["specimen"], f"[specimen] of {path.name}"),
        columns=tuple(_column(h, c, f"[columns] of {path.name}") for h, c in part["columns"].items()),
        constants={
            name: quantity(value, channel(name).unit, f"[constants] of {path.name}, {name!r}")
            for name, value in part["constants"].items()
        },
        derived={name: _derived(name, text, path.name) for name, text in part["derived"].items()},
        logger=_logger(part["logger"], f"[logger] of {path.name}") if "logger" in content else Logger(),
        materiality=_materiality(part["materiality"], f"[materiality] of {path.name}"),
        runs=tuple(_run(run, f"[[run]] number {i + 1} of {path.name}") for i, run in enumerate(runs)),
        sample_rate=_sample_rate(content["sample_rate"], path.name) if "sample_rate" in content else None,
    )


def _keys(given: Iterable[str], known: Iterable[str], where: str) -> None:
    for key in given:
        if key not in known:
            raise unknown_name(f"key in {where}", key, known)


def _table(value: Any, where: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise InputError(f"{where} must be a table of name = value, not {value!r}")
    return value


def _text(value: Any, key: str, where: str) -> str:
    if not isinstance(value, str) or not value.strip():
        raise InputError(f"{where}: {key} must be a text in quotes, not {value!r}")
    return value


def _specimen(part: Mapping[str, Any], where: str) -> dict[str, float | str]:
    _keys(part, (*SPECIMEN_UNITS, *SPECIMEN_WORDS), where)
    return {
        key: _text(value, key, where)
        if key in SPECIMEN_WORDS
        else quantity(value, SPECIMEN_UNITS[key], f"{where}, {key!r}")
        for key, value in part.items()
    }


def _column(header: str, content: Any, where: str) -> ColumnMap:
    here = f"{where}, column {header!r}"
    part = _table(content, here)
    _keys(part, _COLUMN, here)
    if "channel" not in part:
        raise InputError(f'{here}: \'channel\' is missing; write for example {{ channel = "slip_x", unit = "mm" }}')
    name = _text(part["channel"], "channel", here)
    known = channel(name)
    if "unit" not in part:
        raise InputError(f"{here}: 'unit' is missing; {name} is a channel in a unit like '{known.shown_in}'")
    sign = part.get("sign", 1)
    if sign not in (1, -1):
        raise SettingError(f"{here}: sign = {sign!r} cannot be; possible: 1, -1")
    return ColumnMap(header, name, str(part["unit"]), int(sign))


def _derived(name: str, text: Any, where: str) -> str:
    channel(name)
    return _text(text, name, f"[derived] of {where}")


def _sample_rate(value: Any, where: str) -> float:
    rate = quantity(value, "Hz", f"{where}, 'sample_rate'")
    if not 0.0 < rate < 1e6:
        raise SettingError(f'{where}: sample_rate = {value!r} cannot be; write for example "500 Hz"')
    return rate


def _logger(part: Mapping[str, Any], where: str) -> Logger:
    own = {key: value for key, value in part.items() if isinstance(value, dict)}
    for pattern in own:
        if "*" not in pattern and not is_channel(pattern):
            raise unknown_name(f"channel in {where}", pattern, (*CHANNELS, *_LOWPASS))
        if "*" in pattern and not is_channel(pattern.replace("*", "1")):
            raise unknown_name(f"pattern of channels in {where}", pattern, ("pad_*_N", "pad_*_Fx", "buffer_*_Fx"))
    _keys([key for key in part if key not in own], _LOWPASS, where)
    every = _lowpass({key: value for key, value in part.items() if key not in own}, where)
    return Logger(every, {key: _lowpass(value, f"{where}, {key!r}") for key, value in own.items()}, known=True)


def _lowpass(part: Mapping[str, Any], where: str) -> LowPass | None:
    _keys(part, _LOWPASS, where)
    if "lowpass" not in part:
        if part:
            raise InputError(f"{where}: 'lowpass' is missing beside {', '.join(part)}; write for example \"100 Hz\"")
        return None
    if part["lowpass"] == "none":
        return None
    order = part.get("order", LowPass.order)
    if not isinstance(order, int):
        raise SettingError(f"{where}: order = {order!r} must be a whole number")
    frequency = quantity(part["lowpass"], "Hz", f"{where}, 'lowpass'")
    phase = part.get("phase", LowPass.phase)
    if phase not in ("zero", "causal"):
        raise unknown_name(f"phase in {where}", str(phase), ("zero", "causal"))
    return LowPass(frequency, order, phase)


def _materiality(part: Mapping[str, Any], where: str) -> Materiality:
    _keys(part, [f.name for f in fields(Materiality)], where)
    shares = {name: quantity(value, "1", f"{where}, {name!r}") for name, value in part.items()}
    for name, share in shares.items():
        if not 0.0 < share < 1.0:
            raise SettingError(f'{where}: {name} = {share:g} must lie between 0 and 1; write for example "2 %"')
    return Materiality(**shares)


def _run(content: Any, where: str) -> RunSettings:
    part = _table(content, where)
    _keys(part, _RUN, where)
    for needed, example in (("file", '"quake_hv.csv"'), ("role", '"fit"')):
        if needed not in part:
            raise InputError(f"{where}: {needed!r} is missing; write for example {needed} = {example}")
    role = _text(part["role"], "role", where)
    if role not in ROLES:
        raise unknown_name(f"role of a run ({where})", role, ROLES)
    window = None
    if "window" in part:
        ends = part["window"]
        if not isinstance(ends, list) or len(ends) != 2:
            raise InputError(f'{where}: a window is two times, for example window = ["2 s", "30 s"], not {ends!r}')
        start, end = (quantity(time, "s", f"{where}, 'window'") for time in ends)
        if not start < end:
            raise SettingError(f"{where}: the window ends at {end:g} s, before its start at {start:g} s")
        window = (start, end)
    rest = quantity(part["rest_before"], "s", f"{where}, 'rest_before'") if "rest_before" in part else None
    if rest is not None and rest < 0.0:
        raise SettingError(f"{where}: rest_before = {rest:g} s cannot be below zero")
    own = _table(part.get("columns", {}), f"[run.columns] of {where}")
    columns = tuple(_column(h, c, f"[run.columns] of {where}") for h, c in own.items())
    return RunSettings(_text(part["file"], "file", where), role, window, rest, columns)
