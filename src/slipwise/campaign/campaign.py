"""What a campaign is: runs of one specimen, with what is known of the logger."""

import fnmatch
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign.materiality import Materiality
from slipwise.campaign.wild_samples import WildSamples
from slipwise.display import Drawn, Tabular
from slipwise.errors import SettingError
from slipwise.noise.gauges import Gauge, measure_gauge_noise
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.short_repr import short_repr
from slipwise.signals.filters import LowPass

ROLES: tuple[str, ...] = ("fit", "repeat", "holdout")


@short_repr
@dataclass(frozen=True)
class Thinning:
    """Samples of which only some were kept.

    Attributes:
        by: the filter that every channel went through before.
        step: between the samples as they were recorded [s].
    """

    by: LowPass
    step: float


@short_repr
@dataclass(frozen=True)
class Logger:
    """What the logger did to the channels before it stored them.

    Attributes:
        every: the low-pass filter of every channel; None where it is not known or there was none.
        own: channel name or pattern ("pad_*_N") -> its own filter, None for a channel that is not filtered.
        known: whether the campaign says anything of the logger; if not, the audit estimates it.
        thinning: of the samples, after the logger; None where all were kept.
    """

    every: LowPass | None = None
    own: Mapping[str, LowPass | None] = field(default_factory=dict)
    known: bool = False
    thinning: Thinning | None = None

    def of(self, channel: str) -> LowPass | None:
        """Return the filter of one channel: of the logger's own and that of thinning out the lower one."""
        found = self._of(channel)
        if not self.known or self.thinning is None:
            return found
        return self.thinning.by if found is None or found.frequency > self.thinning.by.frequency else found

    def unseen(self, channel: str) -> float:
        """Return the time within which a channel may have jumped at any instant before it was thinned out [s], or 0."""
        if not self.known or self.thinning is None or self._of(channel) is not None:
            return 0.0
        return self.thinning.step

    def _of(self, channel: str) -> LowPass | None:
        if channel in self.own:
            return self.own[channel]
        for pattern, lowpass in self.own.items():
            if fnmatch.fnmatchcase(channel, pattern):
                return lowpass
        return self.every


@short_repr
@dataclass(frozen=True)
class Run:
    """One run of a campaign.

    Attributes:
        name: of the file without its suffix; with the window where a file is used more than once.
        role: "fit", "repeat" (same motion again) or "holdout" (never fitted, never screened).
        record: the channels within the window, SI.
        rest_before: pause since the run before [s]; None where the campaign does not say.
        window: (start, end) in the file's time [s]; None for the whole file.
        file: as campaign.toml names it.
        sha256: of the file.
        wild: samples that no gauge can have read; they are bridged in the record.
        estimated: channel -> expected error of one sample of what stands there in place of a dead gauge [SI].
    """

    name: str
    role: str
    record: Record
    rest_before: float | None
    window: tuple[float, float] | None
    file: str
    sha256: str
    wild: tuple[WildSamples, ...] = ()
    estimated: Mapping[str, float] = field(default_factory=dict[str, float])

    @property
    def invalid(self) -> dict[str, NDArray[np.bool_]]:
        """Return the samples at which a channel is no measurement: channel -> (n,)."""
        return {one.channel: one.bad for one in self.wild}


@dataclass(frozen=True, repr=False)
class Campaign(Drawn, Tabular):
    """Runs of one specimen.

    Attributes:
        name: as campaign.toml says.
        rig: name of the rig, or path of its MJCF file as written.
        specimen: rated values of the rig, with what [specimen] knows better.
        logger: what the logger did.
        runs: in the order in which they were made.
        folder: where campaign.toml lies.
        known: values that [specimen] gives, name -> SI; all other values are only rated.
        notes: what a user should know of the reading, in words: columns not used, assumptions made.
        materiality: how much an effect must change to be named.
    """

    name: str
    rig: str
    specimen: Specimen
    logger: Logger
    runs: tuple[Run, ...]
    folder: Path
    known: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    materiality: Materiality = field(default_factory=Materiality)

    @cached_property
    def gauges(self) -> Mapping[str, Gauge]:
        """Noise of every channel, from the rests of the runs that are not held out, unless only those have it."""
        fitted = [run for run in self.runs if run.role != "holdout"]
        return {**_noise_in(self.runs), **_noise_in(fitted)}

    def with_role(self, *roles: str) -> tuple[Run, ...]:
        """Return the runs that have one of these roles.

        Args:
            *roles: of "fit", "repeat", "holdout" and others that campaign.toml knows.
        """
        return tuple(run for run in self.runs if run.role in roles)

    def run(self, name: str) -> Run:
        """Return a run by name.

        Args:
            name: of the run, as campaign.toml or its file has it.

        Raises:
            SettingError: no run has it.
        """
        for run in self.runs:
            if run.name == name:
                return run
        raise SettingError(f"campaign {self.name} has no run {name!r}; it has: {', '.join(r.name for r in self.runs)}")

    def with_records(self, records: Mapping[str, Record], note: str) -> "Campaign":
        """Return a campaign with other records for some runs, and say so in its notes.

        Args:
            records: name of a run -> its record.
            note: what was done, a sentence.
        """
        runs = tuple(replace(run, record=records.get(run.name, run.record)) for run in self.runs)
        return replace(self, runs=runs, notes=(*self.notes, note))

    def _headline(self) -> str:
        return f"{self.name}, {len(self.runs)} runs on {self.rig}"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {
                "run": run.name,
                "role": run.role,
                "seconds": float(run.record.time[-1] - run.record.time[0]),
                "step": run.record.dt,
                "channels": len(run.record.channels),
                "rest_before": run.rest_before,
                "file": run.file,
            }
            for run in self.runs
        ]


def _noise_in(runs: Sequence[Run]) -> dict[str, Gauge]:
    return measure_gauge_noise([run.record for run in runs], [run.invalid for run in runs])
