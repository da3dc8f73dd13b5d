"""The wild samples of a campaign's runs: bridged and marked, counted, warned of and named."""

import warnings
from collections.abc import Sequence
from dataclasses import replace

from slipwise.campaign.campaign import Campaign, Run
from slipwise.campaign.wild_samples import without_wild_samples
from slipwise.errors import SlipwiseWarning

#: A channel of which more than this share is wild is faulty as a whole [1].
FAULTY = 0.02


def marked(campaign: Campaign) -> Campaign:
    """Return a campaign without the wild samples of its runs, in which they are marked; a warning and a note name them.

    A campaign without any, such as one that was read from its folder, is given as it is.
    """
    runs: list[Run] = []
    fresh: list[Run] = []
    for run in campaign.runs:
        channels, wild = without_wild_samples(run.record.time, run.record.channels, campaign.specimen)
        if wild:
            record = run.record.replaced(**{one.channel: channels[one.channel] for one in wild})
            fresh.append(replace(run, wild=wild))
            run = replace(run, record=record, wild=(*run.wild, *wild))
        runs.append(run)
    if not fresh:
        return campaign
    return replace(campaign, runs=tuple(runs), notes=(*campaign.notes, *warned(fresh)))


def warned(runs: Sequence[Run]) -> tuple[str, ...]:
    """Warn of the wild samples of runs, and give the sentences."""
    told = sentences(runs)
    for words in told:
        warnings.warn(words, SlipwiseWarning, stacklevel=4)
    return told


def sentences(runs: Sequence[Run]) -> tuple[str, ...]:
    """Name the wild samples of runs, a sentence a channel."""
    found = [(run.name, one) for run in runs for one in run.wild if len(one.times)]
    told: dict[str, list[str]] = {}
    for run, one in found:
        told.setdefault(one.channel, []).append(f"{run}: {one.words}")
    return tuple(f"{name} holds what no gauge can have read, left out: {'; '.join(by)}" for name, by in told.items())


def faulty_share(runs: Sequence[Run], name: str) -> float:
    """Return the share of wild samples in a channel over the runs that have it [1]."""
    count = sum(len(run.record) for run in runs if name in run.record)
    return sum(len(one.times) for run in runs for one in run.wild if one.channel == name) / max(count, 1)
