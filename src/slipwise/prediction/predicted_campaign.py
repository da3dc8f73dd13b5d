"""The runs of a campaign as another program predicted them, read as a campaign of its own.

Their gauges are those of the measured campaign: what was driven is taken from the measurement, and the noise of every
gauge is added, so that a model is judged by its output no more finely than by the test.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Campaign
from slipwise.campaign.campaign import Logger
from slipwise.campaign.reader import MeasuredFile, assemble, read_file
from slipwise.campaign.settings import RunSettings, Settings, Source, read_settings
from slipwise.data_files.table import SUFFIXES
from slipwise.errors import InputError
from slipwise.noise.gauges import Gauge
from slipwise.record import Record
from slipwise.signals.second_derivative import second_derivative

#: What drives a calculation, and need not stand in its output.
_DRIVEN = ("table_ax", "table_ay", "table_az")
#: Of the noise that is added; the same for everybody.
_SEED = 1


@dataclass(frozen=True)
class Predicted:
    """Runs that were predicted.

    Attributes:
        exact: as the program wrote them, with the table's motion of the measurement.
        recorded: as the gauges of the campaign would have recorded them.
        notes: what was taken from elsewhere, and which runs are missing, a sentence each.
    """

    exact: Campaign
    recorded: Campaign
    notes: tuple[str, ...]


def load_predicted(folder: Path | str, measured: Campaign) -> Predicted:
    """Read the predicted runs of a campaign.

    Args:
        folder: with a file for each run, named as the measured one but for its suffix, and, where columns are not
            headed by channels with units, a campaign.toml of its own.
        measured: the campaign.

    Raises:
        InputError: no such folder, no run of the campaign in it, or a file that cannot be used.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder; --predicted names one with a file for each run of {measured.name}")
    settings, notes = _settings(folder, measured)
    files: dict[Source, MeasuredFile] = {}
    for run in settings.runs:
        file = read_file(folder / run.file, settings, measured.specimen, settings.columns_of(run))
        files[run.source], words = _completed(file, run.file, _run_of(run.file, measured))
        notes += words
    exact = assemble(folder, settings, measured.specimen, files)
    exact = replace(
        exact, name=f"{measured.name} as predicted", known={}, folder=folder, rig=measured.rig,
        logger=Logger(None, known=True), materiality=measured.materiality,
    )  # fmt: skip
    rng = np.random.default_rng(_SEED)
    records = {run.name: _with_noise(run.record, measured.gauges, rng) for run in exact.runs}
    runs = tuple(replace(run, record=records[run.name]) for run in exact.runs)
    return Predicted(exact, replace(exact, runs=runs), tuple(dict.fromkeys(notes)))


def _settings(folder: Path, measured: Campaign) -> tuple[Settings, list[str]]:
    """Return what is to be read, and which runs are missing; repeats of a motion are predicted once."""
    own = folder / "campaign.toml"
    settings = read_settings(own if own.is_file() else measured.folder / "campaign.toml", runs_needed=False)
    there = {p.stem: p.name for p in sorted(folder.iterdir()) if p.is_dir() or p.suffix.lower() in SUFFIXES}
    named = {Path(run.file).stem: run for run in settings.runs} if own.is_file() else {}
    files = {**there, **{stem: run.file for stem, run in named.items()}}
    wanted = {Path(run.file).stem: run for run in measured.runs}
    missing = [stem for stem, run in wanted.items() if stem not in files and run.role != "repeat"]
    runs = []
    for stem, run in wanted.items():
        if stem in files and run.role != "repeat":
            columns = named[stem].columns if stem in named else ()
            runs.append(RunSettings(files[stem], run.role, run.window, run.rest_before, columns))
    if not any(run.role == "fit" for run in runs):
        found = ", ".join(sorted(files.values())) or "no data file"
        raise InputError(
            f"{folder}: none of the runs that are fitted is predicted there; it has {found}, and needs files named "
            f"{', '.join(s for s, run in wanted.items() if run.role == 'fit')} with a suffix of {', '.join(SUFFIXES)}"
        )
    columns = settings.columns if own.is_file() else ()
    kept = settings if own.is_file() else replace(settings, constants={}, derived={})
    notes = [f"the run {stem} is not predicted" for stem in missing]
    return replace(kept, columns=columns, runs=tuple(runs)), notes


def _run_of(file: str, measured: Campaign) -> Record:
    return next(run.record for run in measured.runs if Path(run.file).stem == Path(file).stem)


def _completed(file: MeasuredFile, name: str, measured: Record) -> tuple[MeasuredFile, list[str]]:
    """Return a file with the table's motion, and with the girder's acceleration where only its slip stands there."""
    channels, notes = dict(file.channels), []
    inside = (file.time >= measured.time[0] - 1e-9) & (file.time <= measured.time[-1] + 1e-9)
    if not inside.any():
        raise InputError(
            f"{name}: it runs from {file.time[0]:g} s to {file.time[-1]:g} s, the measured run from "
            f"{measured.time[0]:g} s to {measured.time[-1]:g} s; give both the same time"
        )
    time = file.time[inside]
    channels = {key: values[inside] for key, values in channels.items()}
    for key in _DRIVEN:
        if key in measured and key not in channels:
            channels[key] = np.interp(time, measured.time, measured[key])
            notes.append(f"{key} is not in the prediction: that of the measured run is taken, which drove it")
    if "girder_ax" not in channels and {"slip_x", "table_ax"} <= channels.keys():
        channels["girder_ax"] = channels["table_ax"] + second_derivative(channels["slip_x"], _step(time))[0]
        notes.append("girder_ax is not in the prediction: it is slip_x differentiated twice, plus table_ax")
    return replace(file, time=time, channels=channels, wild=()), notes


def _step(time: Array) -> float:
    return float(np.median(np.diff(time)))


def _with_noise(record: Record, gauges: Mapping[str, Gauge], rng: np.random.Generator) -> Record:
    """Return a record as gauges would have read it; what is driven was read by one already."""
    channels = {
        key: values
        if key in _DRIVEN or key not in gauges or not np.isfinite(gauges[key].level)
        else values + gauges[key].level * rng.standard_normal(len(values))
        for key, values in record.channels.items()
    }
    return replace(record, channels=channels)
