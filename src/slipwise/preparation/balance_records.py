"""Records in which bad samples do no harm to balances.

A balance looks at all channels at one instant, so that one bad sample costs a row.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

from slipwise.arrays import Array, Mask
from slipwise.campaign import Campaign
from slipwise.campaign.aligned import spread
from slipwise.preparation.outliers import bridge_outliers_of
from slipwise.preparation.sample_fault import RAILS, SampleFault
from slipwise.preparation.synchronisation import without_partner
from slipwise.record import Record

#: Rows left out before and after a rail or a gap [s].
_AROUND = 0.03


@dataclass(frozen=True)
class BalanceRecords:
    """What balances look at.

    Attributes:
        campaign: with bad samples and outliers bridged, and without channels that show nothing.
        left_out: run -> samples (n,) at which no balance is evaluated.
    """

    campaign: Campaign
    left_out: dict[str, Mask]


def leave_out_bad_rows(campaign: Campaign, faults: Sequence[SampleFault]) -> BalanceRecords:
    """Return records in which bad samples do no harm to the balances, and the samples to leave out, by run.

    Repeated samples are bridged; around rails, gaps and wild samples rows are left out; outliers are bridged; a channel
    that is dead or wild throughout, or has lost samples and so its place in time, is taken out.

    Args:
        campaign: put right.
        faults: found in it.
    """
    runs, out = [], {}
    late = [fault.size for fault in faults if fault.kind == "late"]
    for run in campaign.runs:
        channels, leave = dict(run.record.channels), np.zeros(len(run.record), dtype=bool)
        for bad in (*(without_partner(len(leave), run.record.dt, delay) for delay in late), *(w.bad for w in run.wild)):
            leave |= bad
        for fault in faults:
            bad = fault.bad.get(run.name)
            if bad is None:
                continue
            if fault.kind in (*RAILS, "gap"):
                leave |= bad
            for name in fault.channels:
                if fault.kind == "held" and name in channels:
                    channels[name] = bridge_by_splines(channels[name], bad)
        for fault in faults:
            if fault.kind in ("lost", "dead", "wild"):
                for name in fault.channels:
                    channels.pop(name, None)
        reach = max(int(_AROUND / run.record.dt), 1)
        record = Record(run.record.time, channels, run.record.provenance)
        runs.append(replace(run, record=bridge_outliers_of(record, campaign.specimen)))
        out[run.name] = spread(leave, reach, reach) if leave.any() else leave
    note = "wrong signs turned back, bad samples and outliers left out"
    return BalanceRecords(replace(campaign, runs=tuple(runs), notes=(*campaign.notes, note)), out)


def bridge_by_splines(values: Array, bad: Mask) -> Array:
    """Return the values with bad samples interpolated between their good neighbours, by cubic splines."""
    good = np.flatnonzero(~bad)
    return np.where(bad, CubicSpline(good, values[good])(np.arange(len(values))), values)
