"""A held-out run must be a measurement of its own: no copy, and no part of a run that is fitted."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign.campaign import Run
from slipwise.errors import InputError
from slipwise.record import Record

#: Two measurements do not share more than this part of their samples by chance [1].
_SHARED = 0.2


def check_untouched(runs: Sequence[Run]) -> tuple[str, ...]:
    """Refuse a repeat or held-out run that holds the samples of another one; return a note of fitted ones that do.

    Samples are compared by value, over the windows: renaming a file, or moving its time, hides nothing. A repeat that
    is a copy would make the noise floor zero, so it is refused like a held-out run.

    Raises:
        InputError: a repeat or held-out run shares samples with another run.
    """
    marks = [_marks(run.record) for run in runs]
    notes: list[str] = []
    for i, run in enumerate(runs):
        for k, other in enumerate(runs):
            alike = (run.role == "fit") == (other.role == "fit")
            if k == i or (alike and k > i) or (run.role == "fit" and not alike):
                continue  # each pair once, from the run that may not share
            if set(run.record.channels) != set(other.record.channels):
                continue
            shared = np.isin(marks[i], marks[k])
            if not len(shared) or shared.mean() <= _SHARED:
                continue
            if run.role == "fit":
                notes.append(
                    f"the runs {other.name!r} ({other.file}) and {run.name!r} ({run.file}) share {shared.mean():.0%} "
                    "of their samples: one measurement, which counts once, and whose path wear and heat see twice"
                )
            else:
                raise InputError(
                    f"the {run.role} run {run.name!r} ({run.file}) holds {shared.mean():.0%} of the samples of the "
                    f"{other.role} run {other.name!r} ({other.file}): a copy tests nothing; use another measurement "
                    "or windows that do not overlap"
                )
    return tuple(notes)


def _marks(record: Record) -> NDArray[np.uint64]:
    """Return one number for each different sample, from the values of all channels that move."""
    mark = np.zeros(len(record), dtype=np.uint64)
    # odd constants of a multiplicative hash (Knuth): different channels must not cancel
    step = np.uint64(0x9E3779B97F4A7C15)
    for name in sorted(record.channels):
        values = record.channels[name]
        if np.ptp(values) > 0.0:
            # adding zero turns minus zero into zero
            mark = (mark ^ (values + 0.0).view(np.uint64)) * step
            mark ^= mark >> np.uint64(29)
    return np.unique(mark)
