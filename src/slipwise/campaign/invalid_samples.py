"""Samples at which a channel is no measurement: how they are told, and how far around them nothing is judged."""

from collections.abc import Mapping

import numpy as np

from slipwise.arrays import Mask
from slipwise.campaign.aligned import spread
from slipwise.campaign.campaign import Run
from slipwise.channels import VELOCITY_CHANNELS

#: run -> channel -> samples (n,) at which the channel is no measurement.
InvalidSamples = Mapping[str, Mapping[str, Mask]]
#: Invalid before and after a bad sample; more where the velocity is made of the channel [samples].
_REACH, _REACH_OF_MOTION = 6, 40


def widen_around(name: str, bad: Mask) -> Mask:
    """Return the samples (n,) that bad ones of a channel make unsure."""
    reach = _REACH_OF_MOTION if name in VELOCITY_CHANNELS else _REACH
    return spread(bad, reach, reach)


def add_wild_samples(run: Run, invalid: Mapping[str, Mask]) -> dict[str, Mask]:
    """Return the samples that a fit must not judge: those given, and those around a run's wild samples.

    Args:
        run: with its wild samples.
        invalid: channel -> samples (n,) at which it is no measurement.
    """
    out = dict(invalid)
    for name, bad in run.invalid.items():
        out[name] = out.get(name, np.zeros(len(bad), dtype=bool)) | widen_around(name, bad)
    return out
