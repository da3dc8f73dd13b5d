"""Thin out records that were logged far faster than anything moves: a fit's time grows with every sample.

What lies far above the new half rate is taken out before, in phase. Noise just above it is folded down on purpose: the
top of the spectrum stays as loud as the rest, and tells how loud that is.
"""

from dataclasses import replace

import numpy as np

from slipwise.arrays import Mask
from slipwise.campaign.campaign import Campaign, Run, Thinning
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.signals.filters import LowPass, lowpass

#: Samples a second that every law, the pads' pitch of 50 to 100 Hz and a logger's usual filter need [Hz].
ENOUGH = 400.0
#: Samples of one run of a slider that tell as much as more of them [1].
ENOUGH_OF_SLIDER = 8000
#: Steps that differ by more than this share are those of a logger whose rate was changed [1].
_UNIFORM = 0.1
#: The filter before thinning out, as a share of the new half rate [1], and its order.
_HALVED, _ORDER = 1.15, 16


def choose_thinning(run: Run, specimen: Specimen) -> int:
    """Return the whole number of samples of which one is kept: 1 where nothing is to be thinned out."""
    if not specimen.free:  # how fast things go there only its record knows
        steps = np.diff(run.record.time)
        uniform = bool(np.ptp(steps) < _UNIFORM * run.record.dt)
        return max(1, len(run.record) // ENOUGH_OF_SLIDER) if uniform else 1
    return max(1, int(np.floor(1.0 / (run.record.dt * ENOUGH) + 1e-6)))


def decimate(campaign: Campaign, invalid: InvalidSamples) -> tuple[Campaign, InvalidSamples]:
    """Return a campaign with at most twice `ENOUGH` samples a second, and which of its samples are no measurement.

    Args:
        campaign: as recorded.
        invalid: run -> channel -> samples (n,) at which it is no measurement.
    """
    every = {run.name: choose_thinning(run, campaign.specimen) for run in campaign.runs}
    if max(every.values()) == 1:
        return campaign, invalid
    records = {run.name: _thinned(run.record, every[run.name]) for run in campaign.runs}
    masks = {
        run: {name: _any_of(mask, every[run])[: len(records[run])] for name, mask in of.items()}
        for run, of in invalid.items()
    }
    runs = tuple(_thinned_run(run, records[run.name], every[run.name]) for run in campaign.runs)
    rate = 1.0 / next(iter(records.values())).dt
    logger = replace(campaign.logger, thinning=Thinning(_filter(rate), campaign.runs[0].record.dt))
    note = f"logged at {1.0 / campaign.runs[0].record.dt:.4g} Hz; fits use {rate:.4g} Hz, low-pass filtered before"
    return replace(campaign, runs=runs, logger=logger, notes=(*campaign.notes, note)), masks


def _filter(rate: float) -> LowPass:
    """Return the filter before samples are thinned out to a rate [Hz]: friction that turns round at once shows it."""
    return LowPass(_HALVED * 0.5 * rate, _ORDER)


def _thinned(record: Record, every: int) -> Record:
    if every == 1:
        return record
    by = _filter(1.0 / (every * record.dt))
    channels = {
        name: (lowpass(values, record.dt, by) if np.isfinite(values).all() else values)[::every]
        for name, values in record.channels.items()
    }
    return Record(record.time[::every], channels, record.provenance)


def _thinned_run(run: Run, record: Record, every: int) -> Run:
    wild = tuple(replace(one, bad=_any_of(one.bad, every)[: len(record)]) for one in run.wild)
    return replace(run, record=record, wild=wild)


def _any_of(mask: Mask, every: int) -> Mask:
    padded = np.concatenate([mask, np.zeros(-len(mask) % every, dtype=bool)])
    return np.asarray(padded.reshape(-1, every).any(axis=1))
