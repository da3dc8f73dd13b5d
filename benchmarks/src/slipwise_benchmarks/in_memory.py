"""Campaigns of the second simulator as the library holds them, without files in between."""

import hashlib
from pathlib import Path

from slipwise.campaign import Campaign, Logger, Run
from slipwise.model import base_model
from slipwise.record import Record
from slipwise.signals.filters import LowPass
from slipwise_benchmarks.campaign import Campaign as Made

ROLES = ("fit", "fit", "fit", "repeat", "holdout")


def as_campaign(made: Made) -> Campaign:
    """Turn a campaign of the bench into one that is read, its logger known as far as the laboratory states it."""
    chain = made.truth.logger
    by = LowPass(chain.lowpass, chain.order, chain.phase)
    runs = []
    for (name, channels), role in zip(made.recorded.items(), ROLES, strict=True):
        record = Record(channels["time"], {n: v for n, v in channels.items() if n != "time"})
        runs.append(Run(name, role, record, 1800.0, None, f"{name}.csv", hashlib.sha256(name.encode()).hexdigest()))
    rig = made.truth.rig
    logger = Logger(by, known=True) if chain.stated else Logger()
    return Campaign(f"bench {made.truth.seed}", rig, base_model(rig).specimen, logger, tuple(runs), Path())
