"""Read a campaign: campaign.toml and its data files, into runs in SI."""

import hashlib
import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from pathlib import Path

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.campaign import Campaign, Run
from slipwise.campaign.derived import evaluate
from slipwise.campaign.derived_kinematics import completed
from slipwise.campaign.friction_coefficient import forces_of, is_coefficient
from slipwise.campaign.held_out_check import check_untouched
from slipwise.campaign.same_specimen import check_same_specimen
from slipwise.campaign.settings import ColumnMap, RunSettings, Settings, Source, read_settings
from slipwise.campaign.time_axis import check_time, time_of_file
from slipwise.campaign.wild_samples import WildSamples, inherited, without_wild_samples
from slipwise.campaign.wild_samples_of_runs import marked, warned
from slipwise.channels import CHANNELS, channel, is_channel, part_of
from slipwise.data_files.table import Table, open_table
from slipwise.errors import InputError, SlipwiseWarning, UnitError, unknown_name
from slipwise.record import Record
from slipwise.rig import Specimen, load_specimen
from slipwise.rig.known import better_known
from slipwise.units import affine, parse_unit

#: Our own headers: "pad_A_N [kN]".
HEADER = re.compile(r"^(?P<name>[A-Za-z]\w*)\s*(?:\[(?P<unit>[^\]]*)\])?$")
#: Samples of a run: fewer show neither a velocity nor what is noise.
_FEWEST = 16
#: Temperatures of a sliding face: from liquid air to molten steel [K].
_TEMPERATURES = (70.0, 2000.0)


@dataclass(frozen=True)
class MeasuredFile:
    """A data file as channels in SI, before any window."""

    time: Array
    channels: Mapping[str, Array]
    sha256: str
    notes: tuple[str, ...]
    wild: tuple[WildSamples, ...]
    made: tuple[str, ...] = ()
    computed: tuple[str, ...] = ()


def load_campaign(folder: Path | str) -> Campaign:
    """Read a campaign.

    Args:
        folder: with campaign.toml and the data files.

    Raises:
        InputError: a file, column or window that is missing, or data that cannot be used.
        UnitError: a unit that is missing, unknown or of the wrong dimension; names file, column and the cure.
        UnknownNameError: a key, channel, role or rig that does not exist; names the nearest ones.
    """
    folder = Path(folder)
    if folder.is_file():
        raise InputError(f"{folder}: a file; a campaign is the folder in which it is, {folder.parent}")
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder; a campaign is a folder with campaign.toml and data files")
    settings = read_settings(folder / "campaign.toml")
    specimen = specimen_of(folder, settings)
    files: dict[Source, MeasuredFile] = {}
    for run in settings.runs:
        if run.source not in files:
            files[run.source] = read_file(folder / run.file, settings, specimen, settings.columns_of(run))
    return assemble(folder, settings, specimen, files)


def specimen_of(folder: Path, settings: Settings) -> Specimen:
    """Return the rig of a campaign, with what its [specimen] knows better."""
    return better_known(load_specimen(settings.rig, folder), settings.specimen, "campaign.toml")


def assemble(folder: Path, settings: Settings, specimen: Specimen, files: Mapping[Source, MeasuredFile]) -> Campaign:
    """Make a campaign of files that were read.

    Args:
        folder: with campaign.toml.
        settings: what that says; of the runs those that are wanted.
        specimen: as `specimen_of` gives it.
        files: `source` of every run -> its file.

    Raises:
        InputError: a window that is missing, runs of one name or of two rigs, or a run that is held out and fitted.
    """
    runs = [_run(run, files[run.source], settings) for run in settings.runs]
    _check_names(runs)
    used = [files[source] for source in dict.fromkeys(run.source for run in settings.runs)]
    notes = [*dict.fromkeys(note for file in used for note in file.notes), *check_untouched(runs)]
    notes += _outside(folder, settings)
    campaign = Campaign(
        name=settings.name,
        rig=settings.rig,
        specimen=specimen,
        logger=settings.logger,
        runs=tuple(runs),
        folder=folder,
        known={name: value for name, value in settings.specimen.items() if isinstance(value, float)},
        materiality=settings.materiality,
    )
    return replace(campaign, notes=(*notes, *warned(runs), *check_same_specimen(campaign)))


def _outside(folder: Path, settings: Settings) -> list[str]:
    """Name the files that campaign.toml takes from elsewhere than its folder."""
    home = folder.resolve()
    rig = [settings.rig] if settings.rig.endswith(".xml") else []
    given = dict.fromkeys([*rig, *(run.file for run in settings.runs)])
    away = [name for name in given if not (home / name).resolve().is_relative_to(home)]
    return [f"campaign.toml takes {name} from outside its folder" for name in away]


def as_campaign(given: Campaign | Path | str) -> Campaign:
    """Return the campaign that a user means: itself, or that of a folder, without wild samples.

    Raises:
        InputError: something else, or a folder that cannot be read.
    """
    if isinstance(given, Campaign):
        return marked(given)
    if not isinstance(given, Path | str):
        raise InputError(
            f"a campaign is a folder with campaign.toml or what load_campaign gives; got {type(given).__name__}"
        )
    return load_campaign(given)


def read_file(path: Path, settings: Settings, specimen: Specimen, columns: Sequence[ColumnMap]) -> MeasuredFile:
    """Read a data file as channels in SI.

    Args:
        path: of it.
        settings: of its campaign: constants and derived channels.
        specimen: whose pads and buffers the channels are of.
        columns: what its columns are, as `Settings.columns_of` gives them.

    Raises:
        InputError: the file, a column or its times cannot be used.
        UnitError: a unit that is missing, unknown or of the wrong dimension.
    """
    table = open_table(path)
    chosen, notes = _choose(table, columns, specimen)
    read = table.columns([i for i, _ in chosen])
    time: Array | None = None
    channels: dict[str, Array] = {}
    coefficients: dict[str, Array] = {}
    for i, mapped in chosen:
        values = read.values.pop(0)  # of a long file each column is worth letting go
        if is_coefficient(mapped.channel, mapped.unit):
            coefficients[mapped.channel] = parse_unit(mapped.unit, "1", mapped.header) * (mapped.sign * values)
            continue
        factor, offset = _to_si(path, table.headers[i], mapped)
        # The sign is that of the number as written: -20 degC turned round is 20 degC.
        converted = factor * (mapped.sign * values) + offset
        if mapped.channel == "time":
            time = converted
        else:
            channels[mapped.channel] = converted
    time, words = time_of_file(path.name, time, channels, table, read.tables, settings.sample_rate)
    check_time(path.name, time, read.tables)
    channels, wild = without_wild_samples(time, channels, specimen)
    for name, value in settings.constants.items():
        if name in channels:
            raise InputError(f"{path.name}: {name} is both a column and one of [constants]; remove one of them")
        channels[name] = np.full(len(time), value)
    for name, expression in settings.derived.items():
        if name in channels:
            raise InputError(f"{path.name}: {name} is both recorded and one of [derived]; remove one of them")
        channels[name] = evaluate(expression, {"time": time, **channels}, name, f"[derived] {name} ({path.name})")
        wild += inherited(wild, name, re.findall(r"\w+", expression))
    areas = dict(zip(specimen.pads, specimen.pad_areas, strict=True))
    forces, wild_forces = without_wild_samples(time, forces_of(coefficients, channels, areas, path.name), specimen)
    channels |= forces
    _check_temperatures(path.name, channels)
    measured = set(channels)
    channels, added = completed(time, channels)
    computed = tuple(name for name in channels if name not in measured)
    wild += wild_forces
    for axis in "xyz":
        for name, source in ((f"slip_{axis}", f"slip_v{axis}"), (f"table_a{axis}", f"table_d{axis}")):
            wild += inherited(wild, name, [source]) if any(word.startswith(f"{name} is") for word in added) else ()
    made = tuple(f"{path.name}: {word}" for word in added)
    return MeasuredFile(
        time, channels, _sha256(table.path), (*table.notes, *words, *made, *notes), wild, made, computed
    )


def _check_temperatures(name: str, channels: Mapping[str, Array]) -> None:
    """Refuse temperatures that no slide has: a unit or an offset is wrong."""
    for key, values in channels.items():
        finite = values[np.isfinite(values)]
        if channel(key.removesuffix("_raw")).unit != "K" or not len(finite):
            continue
        low, high = float(finite.min()), float(finite.max())
        if not _TEMPERATURES[0] <= low <= high <= _TEMPERATURES[1]:
            raise InputError(
                f"{name}: {key} runs from {low:.4g} K to {high:.4g} K; possible are {_TEMPERATURES[0]:g} K to "
                f"{_TEMPERATURES[1]:g} K: is its unit right (degC, K)?"
            )


def _choose(
    table: Table, mapped: Sequence[ColumnMap], specimen: Specimen
) -> tuple[list[tuple[int, ColumnMap]], list[str]]:
    """Decide which column is which channel, and say which ones are not used."""
    name = table.path.name
    chosen: list[tuple[int, ColumnMap]] = []
    notes: list[str] = []
    by_header = {_plain(entry.header): entry for entry in mapped}
    for i, header in enumerate(table.headers):
        entry = by_header.get(_plain(header))
        if entry is None:
            match = HEADER.match(_plain(header))
            if match is None or not _is_channel(match["name"]):
                notes.append(_not_used(header, match["name"] if match else header, name))
                continue
            if part_of(match["name"])[0] == "pad" and part_of(match["name"])[1] not in specimen.pads:
                notes.append(
                    f"column {header!r} is of no pad of {specimen.name}, which has {', '.join(specimen.pads)}, and is "
                    "not used"
                )
                continue
            unit = match["unit"]
            if unit is None:
                raise UnitError(
                    f"{name}: column {header!r} has no unit; write it in brackets, for example "
                    f"'{match['name']} [{channel(match['name']).shown_in}]'"
                )
            entry = ColumnMap(header, match["name"], unit, 1)
        elif part_of(entry.channel)[0] == "pad" and part_of(entry.channel)[1] not in specimen.pads:
            raise unknown_name(
                f"pad of {specimen.name}", part_of(entry.channel)[1], specimen.pads, f"[columns] {header!r} names it."
            )
        for k, other in chosen:
            if other.channel == entry.channel:
                raise InputError(
                    f"{name}: the channel {entry.channel} stands in two columns, {table.headers[k]!r} (number {k + 1}) "
                    f"and {header!r} (number {i + 1}); keep one of them"
                )
        chosen.append((i, entry))
    here = {_plain(header) for header in table.headers}
    for entry in mapped:
        if _plain(entry.header) not in here:
            near = get_close_matches(entry.header, table.headers, n=3, cutoff=0.4) or table.headers
            raise InputError(
                f"{name}: the column {entry.header!r} of [columns] is missing; the file has "
                f"{', '.join(map(repr, near))}; correct the name in [columns]"
            )
    return chosen, notes


def _plain(header: str) -> str:
    return " ".join(header.split())


def _is_channel(name: str) -> bool:
    return is_channel(name)


def _not_used(header: str, name: str, file: str) -> str:
    """Say that a column is not used; what looks like a channel that is misspelt is a warning too."""
    near = get_close_matches(name, CHANNELS, n=1, cutoff=0.8)
    hint = f"; did you mean {near[0]}?" if near else ""
    words = f"column {header!r} is no channel and is not used{hint}"
    if near:
        warnings.warn(f"{file}: {words}", SlipwiseWarning, stacklevel=2)
    return words


def _to_si(path: Path, header: str, mapped: ColumnMap) -> tuple[float, float]:
    known = channel(mapped.channel)
    if mapped.unit.strip() == "?":
        plain = ', or unit = "1" for a coefficient of friction' if mapped.channel.endswith(("_Fx", "_Fy")) else ""
        raise UnitError(
            f'{path.name}, column {header!r}: its unit is still "?" in [columns] of campaign.toml; write it there, for '
            f'example unit = "{known.shown_in}"{plain}'
        )
    return affine(mapped.unit, known.unit, f"{path.name}, column {header!r} ({mapped.channel})")


def _check_names(runs: Sequence[Run]) -> None:
    names = [run.name for run in runs]
    for run in runs:
        if names.count(run.name) > 1:
            raise InputError(f"campaign.toml lists the run {run.name!r} ({run.file}) twice; remove one of them")


def _run(run: RunSettings, file: MeasuredFile, settings: Settings) -> Run:
    files = {other.file for other in settings.runs}
    stem = Path(run.file).stem
    name = stem if sum(Path(f).stem == stem for f in files) == 1 else str(Path(run.file).with_suffix(""))
    if "#" in Path(run.file).suffix:
        name = f"{name} {Path(run.file).suffix.partition('#')[2]}"
    shared = sum(other.file == run.file for other in settings.runs) > 1
    time = file.time
    inside = slice(0, len(time))
    if run.window is not None:
        start, end = run.window
        slack = 1.5 * float(np.median(np.diff(time)))
        if start < time[0] - slack or end > time[-1] + slack:
            raise InputError(
                f"{run.file}: the window from {start:g} s to {end:g} s lies outside the data, which run from "
                f"{time[0]:g} s to {time[-1]:g} s"
            )
        inside = slice(int(np.searchsorted(time, start)), int(np.searchsorted(time, end, side="right")))
        name = f"{name} {start:g}-{end:g} s" if shared else name
    if len(time[inside]) < _FEWEST:
        raise InputError(
            f"{run.file}: {'it' if run.window is None else 'the window'} holds {len(time[inside])} samples, at least "
            f"{_FEWEST} are needed; the step is {np.median(np.diff(time)):.4g} s"
        )
    channels = {key: values[inside] for key, values in file.channels.items()}
    for key, values in channels.items():
        bad = np.flatnonzero(~np.isfinite(values))
        if len(bad):
            raise InputError(
                f"{run.file}: {key} is missing or infinite in {len(bad)} samples, first at {time[inside][bad[0]]:g} s; "
                "cut them off with a window, or fill them where that is honest"
            )
    made = {"made": list(file.made), "computed": list(file.computed)} if file.made else {}
    record = Record(time[inside], channels, {"file": run.file, "sha256": file.sha256, **made})
    wild = tuple(one.within(inside, record.time) for one in file.wild if one.bad[inside].any())
    return Run(name, run.role, record, run.rest_before, run.window, run.file, file.sha256, wild)


def _sha256(path: Path) -> str:
    if path.is_dir():  # of a run that lies in several files
        every = "".join(_sha256(file) for file in sorted(path.iterdir()) if file.is_file())
        return hashlib.sha256(every.encode()).hexdigest()
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
