"""Load and friction cells on a second logger that was started late: found by friction, which follows the slip.

    sum F(t + tau) = a s(t) + b x(t) + c girder_ax(t) + sum c_i storey_i_ax(t) + d,      s = tanh(v / v_0)

is fitted at every lag at which one of these resembles the sum of the pads' friction most; the best lag counts
where all runs agree on it and without it much less is explained. Shorter delays are the fits' own business.
"""

import numpy as np

from slipwise.campaign import Campaign, Run
from slipwise.instruments.lags import EXPLAINED, MORE, MOST, LateChannels, agreed, explained, strongest, vertex
from slipwise.rig import Specimen
from slipwise.rig.frame import storey_channels

#: Slip rate at which friction has turned [m/s].
_TURNED = 0.02
#: Lags beside the one of largest correlation that are tried [samples].
_BESIDE = 4


def late_cells(campaign: Campaign) -> LateChannels | None:
    """Tell whether the pads' cells are late as one, of a girder that slides by itself; None where they are not."""
    if not campaign.specimen.free:
        return None
    lags = [lag for run in campaign.runs if (lag := _lag(run, campaign.specimen)) is not None]
    delay = agreed(lags, campaign.runs[0].record.dt)
    if delay is None:
        return None
    names = dict.fromkeys(n for run in campaign.runs for n in run.record.channels if n.startswith("pad_"))
    return LateChannels(tuple(names), delay)


def _lag(run: Run, specimen: Specimen) -> float | None:
    """Give by how much the friction of a run comes late [s]; None where it says nothing."""
    record, dt = run.record, run.record.dt
    names, floors = [f"pad_{p}_Fx" for p in specimen.pads], storey_channels(specimen.storeys)
    if not record.has_all(*names, *floors, "slip_x", "girder_ax"):
        return None
    slip = record["slip_x"]
    force = np.sum([record[n] for n in names], axis=0)
    states = [np.tanh(np.gradient(slip, dt) / _TURNED), slip, record["girder_ax"], *(record[n] for n in floors)]
    if not all(np.isfinite(x).all() and np.ptp(x) > 0.0 for x in (force, *states)):
        return None
    most = min(round(MOST / dt), len(force) // 2)
    near = range(-_BESIDE, _BESIDE + 1)
    tried = {0, *(strongest(force, x, most) + beside for x in states for beside in near)}
    shares = {lag: explained(force, states, lag) for lag in sorted(tried)}
    best = max(shares, key=lambda lag: shares[lag])
    if shares[best] < EXPLAINED:
        return None
    if shares[best] < shares[0] + MORE:
        return 0.0
    return dt * (best + vertex(*(explained(force, states, best + beside) for beside in (-1, 0, 1))))
