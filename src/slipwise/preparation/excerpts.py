"""A stretch of each run where a campaign is too long to be fitted whole: time and memory grow with every sample.

A stretch begins a little before anything slides, so that wear, heat and age stand where they did, and lies in one
piece, for they go on through it. All samples are read and looked at for faults; what follows a stretch is not fitted,
and the campaign's notes say so.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from slipwise.campaign.campaign import Campaign, Run
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.record import Record

#: Samples of all runs together that are fitted.
MOST = 160_000
#: Rest that is kept before the first slip, for it shows the noise of the gauges [s].
_REST = 4.0
#: Share of the stroke that is no rest any more [1].
_SLIPS = 0.02


def cut_excerpts(campaign: Campaign, invalid: InvalidSamples, most: int = MOST) -> tuple[Campaign, InvalidSamples]:
    """Return a campaign with at most so many samples, and which of them are no measurement; a shorter one as it is.

    Args:
        campaign: decimated, so that nothing is cut for the sake of samples that tell nothing.
        invalid: run -> channel -> samples (n,) at which it is no measurement.
        most: samples of all runs together.
    """
    if sum(len(run.record) for run in campaign.runs) <= most:
        return campaign, invalid
    longest = _share([len(run.record) for run in campaign.runs], most)
    cut = {run.name: _stretch(run, longest) for run in campaign.runs if len(run.record) > longest}
    runs = tuple(_within(run, cut[run.name]) if run.name in cut else run for run in campaign.runs)
    masks = {run: {c: mask[cut[run]] if run in cut else mask for c, mask in of.items()} for run, of in invalid.items()}
    notes = (_note(cut, campaign),) if cut else ()
    return replace(campaign, runs=runs, notes=(*campaign.notes, *notes)), masks


def _share(lengths: list[int], most: int) -> int:
    """Return the samples that a run may have: what short runs leave goes to long ones."""
    left, waiting = most, sorted(lengths)
    while waiting and waiting[0] <= left // len(waiting):
        left -= waiting.pop(0)
    return left // len(waiting) if waiting else max(lengths)


def _stretch(run: Run, longest: int) -> slice:
    """Return the samples from a little before the first slip on."""
    slip = run.record["slip_x"] if "slip_x" in run.record else np.zeros(len(run.record))
    away = np.abs(np.nan_to_num(slip - slip[np.isfinite(slip)][:1].sum()))
    first = int(np.argmax(away > _SLIPS * away.max())) if away.any() else 0
    start = min(max(first - round(_REST / run.record.dt), 0), len(slip) - longest)
    return slice(start, start + longest)


def _within(run: Run, kept: slice) -> Run:
    record = run.record
    channels = {name: values[kept] for name, values in record.channels.items()}
    time = record.time[kept]
    wild = tuple(one.within(kept, time) for one in run.wild)
    return replace(run, record=Record(time, channels, record.provenance), wild=wild)


def _note(cut: Mapping[str, slice], campaign: Campaign) -> str:
    runs = [run for run in campaign.runs if run.name in cut]
    parts = [
        f"{run.name} from {run.record.time[cut[run.name].start]:.4g} to "
        f"{run.record.time[cut[run.name].stop - 1]:.4g} s of {run.record.time[-1]:.4g} s"
        for run in runs[:3]
    ]
    more = f" and {len(runs) - 3} more runs alike" if len(runs) > 3 else ""
    return f"too long to be fitted whole: fits use {', '.join(parts)}{more}"
