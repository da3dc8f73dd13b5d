"""Samples that are no measurement, each with its reason: bridged where a fit needs a value, and judged nowhere.

A fit judges channel by channel, so that one bad sample costs what is judged by its channel and no more.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from slipwise.arrays import Array, Mask
from slipwise.campaign import Campaign, Run
from slipwise.campaign.invalid_samples import InvalidSamples, widen_around
from slipwise.preparation.sample_fault import RAILS, SampleFault
from slipwise.preparation.synchronisation import without_partner

#: Faults whose samples are no measurement.
_INVALID = (*RAILS, "held", "lost", "dead", "wild")


def mask_bad_samples(campaign: Campaign, faults: Sequence[SampleFault]) -> dict[str, InvalidSamples]:
    """Return the samples that are no measurement by reason: kind of fault -> run -> channel -> samples (n,).

    A channel that was late shows nothing at the end of a run, where the others go on.

    Args:
        campaign: put right.
        faults: found in it.
    """
    found: dict[str, dict[str, dict[str, Mask]]] = {}
    for fault in faults:
        for run in campaign.runs if fault.kind in (*_INVALID, "late") else ():
            masks = found.setdefault(fault.kind, {}).setdefault(run.name, {})
            for name in fault.channels:
                if name in run.record:
                    bad = _bad(fault, run, run.record[name])
                    masks[name] = masks[name] | bad if name in masks else bad
    return {**found}


def _bad(fault: SampleFault, run: Run, values: Array) -> Mask:
    """Return samples (n,) that are no measurement; of a channel that lost some, those that repeat the one before."""
    if fault.kind == "late":
        return without_partner(len(values), run.record.dt, fault.size)
    if fault.kind == "lost":
        return np.concatenate([[False], values[1:] == values[:-1]])
    return fault.bad.get(run.name, np.zeros(len(values), dtype=bool))


def bridge_bad_samples(
    campaign: Campaign, masks: Mapping[str, InvalidSamples]
) -> tuple[Campaign, dict[str, dict[str, Mask]]]:
    """Return a campaign with bad samples bridged by lines, and those that must not be judged: run -> channel -> (n,).

    A rail is left as it is, for nobody knows what is beyond; so is a channel that is bad throughout.

    Args:
        campaign: put right.
        masks: as `mask_bad_samples` tells them.
    """
    runs: list[Run] = []
    invalid: dict[str, dict[str, Mask]] = {}
    for run in campaign.runs:
        record, unjudged = run.record, dict[str, Mask]()
        of = {reason: channels[run.name] for reason, channels in masks.items() if run.name in channels}
        for name in dict.fromkeys(name for channels in of.values() for name in channels):
            own = {reason: channels[name] for reason, channels in of.items() if name in channels}
            unpaired = own.pop("late", np.zeros(len(record), dtype=bool))
            own = {} if name in run.estimated else own  # another load stands there
            bad = np.any([np.zeros(len(record), dtype=bool), *own.values()], axis=0)
            if own and not set(own) & set(RAILS) and not bad.all():
                between = np.interp(record.time, record.time[~bad], record[name][~bad])
                record = record.replaced(**{name: between})
            unjudged[name] = unpaired | widen_around(name, bad) if own else unpaired
        runs.append(replace(run, record=record))
        invalid[run.name] = unjudged
    return replace(campaign, runs=tuple(runs)), invalid
