"""What an ensemble says: quantiles of every response, and how often a limit was exceeded."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from slipwise.short_repr import short_repr
from slipwise.studies.ensemble.members_file import responses_of
from slipwise.studies.ensemble.responses import RESPONSES, Limit, Response

#: The median, one and two standard deviations of a normal distribution to either side, about [%].
QUANTILES = (5, 16, 50, 84, 95)


@short_repr
@dataclass(frozen=True)
class Quantiles:
    """One response to one motion at one scale.

    Attributes:
        motion: as it was given.
        scale: factor on it.
        response: which.
        members: that finished.
        failed: simulations that diverged; they are in no quantile.
        values: at `QUANTILES` [SI]; NaN where no member finished.
    """

    motion: str
    scale: float
    response: Response
    members: int
    failed: int
    values: tuple[float, ...]


@short_repr
@dataclass(frozen=True)
class Exceedance:
    """How often a limit was exceeded by one motion at one scale: over, of members that finished; failed beside them."""

    motion: str
    scale: float
    limit: Limit
    members: int
    failed: int
    over: int


def tables_of(
    path: Path, motions: Sequence[str], scales: Sequence[float], limits: Sequence[Limit]
) -> tuple[tuple[Quantiles, ...], tuple[Exceedance, ...]]:
    """Read members.parquet, a motion and a scale at a time.

    Args:
        path: of the file.
        motions: as they are named in it.
        scales: likewise.
        limits: that count.
    """
    quantiles: list[Quantiles] = []
    exceedances: list[Exceedance] = []
    for motion in motions:
        for scale in scales:
            values, failed = responses_of(path, motion, scale)
            for response in RESPONSES:
                own = values[response.name]
                found = np.percentile(own, QUANTILES) if len(own) else np.full(len(QUANTILES), np.nan)
                quantiles.append(Quantiles(motion, scale, response, len(own), failed, tuple(map(float, found))))
            for limit in limits:
                own = values[limit.response.name]
                exceedances.append(
                    Exceedance(motion, scale, limit, len(own), failed, int(np.count_nonzero(own > limit.value)))
                )
    return tuple(quantiles), tuple(exceedances)
