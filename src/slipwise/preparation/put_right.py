"""Channels put right by a number that was found: brought forward, in their units, at their zero, with their sign."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from slipwise.campaign import Campaign, Run
from slipwise.campaign.aligned import spread
from slipwise.campaign.wild_samples import WildSamples
from slipwise.preparation.sample_fault import SampleFault
from slipwise.preparation.signs import reverse_signs
from slipwise.preparation.synchronisation import synchronise
from slipwise.preparation.tare import restore_zeros
from slipwise.preparation.wrong_units import convert_units
from slipwise.record import Record


def put_right(campaign: Campaign, faults: Sequence[SampleFault]) -> Campaign:
    """Return a campaign whose channels are put right, in the order in which their faults are found.

    Args:
        campaign: as recorded.
        faults: found in it; those whose samples are no measurement are no business of this step.
    """
    runs = (replace(r, record=_put_right(r.record, faults), wild=_synchronised(r, faults)) for r in campaign.runs)
    return replace(campaign, runs=tuple(runs))


def _put_right(record: Record, faults: Sequence[SampleFault]) -> Record:
    sizes = {kind: {n: f.size for f in faults if f.kind == kind for n in f.channels} for kind in ("scaled", "shifted")}
    for fault in faults:
        if fault.kind == "late":
            record = synchronise(record, fault.channels, fault.size)
    record = restore_zeros(convert_units(record, sizes["scaled"]), sizes["shifted"])
    return reverse_signs(record, [name for fault in faults if fault.kind == "turned" for name in fault.channels])


def _synchronised(run: Run, faults: Sequence[SampleFault]) -> tuple[WildSamples, ...]:
    """Return the wild samples of a run where they are once its late channels were brought forward."""
    late = {name: fault.size for fault in faults if fault.kind == "late" for name in fault.channels}
    moved = []
    for one in run.wild:
        steps = round(late.get(one.channel, 0.0) / run.record.dt)
        at = np.flatnonzero(one.bad) - steps
        bad = np.zeros(len(one.bad), dtype=bool)
        bad[at[(at >= 0) & (at < len(bad))]] = True
        moved.append(replace(one, bad=spread(bad, 1, 1) if steps else bad))
    return tuple(moved)
