"""The preparation of a campaign, step by step, once for every command that audits or fits it."""

from dataclasses import replace
from pathlib import Path

from slipwise.campaign import Campaign, as_campaign
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.preparation.balance_records import leave_out_bad_rows
from slipwise.preparation.dead_cells import estimate_dead_loads
from slipwise.preparation.decimation import decimate
from slipwise.preparation.excerpts import cut_excerpts
from slipwise.preparation.logger import determine_logger
from slipwise.preparation.masks import bridge_bad_samples, mask_bad_samples
from slipwise.preparation.prepared import Prepared
from slipwise.preparation.put_right import put_right
from slipwise.preparation.rig_check import HELD_AGAINST, check_rig, put_on_rig_shaken
from slipwise.preparation.sample_faults import find_sample_faults


@one_thread_algebra()
def prepare(campaign: Campaign | Path | str | Prepared) -> Prepared:
    """Return a campaign as audits and fits see it, with what was found in its samples and done about it.

    Args:
        campaign: or its folder; one that is prepared stays as it is.

    Raises:
        InputError: the folder holds no campaign that can be read.
    """
    if isinstance(campaign, Prepared):
        return campaign
    recorded = as_campaign(campaign)
    faults = tuple(find_sample_faults(recorded))
    right = put_right(recorded, faults)  # synchronised, in its units, at its zeros, with its signs
    balances = leave_out_bad_rows(right, faults)
    masks = mask_bad_samples(right, faults)
    alive, estimated = estimate_dead_loads(right, faults, masks)
    bridged, invalid = bridge_bad_samples(alive, masks)
    uncut, unjudged, seen, invalid = _shortened(bridged, invalid)
    seen, logger, start = determine_logger(seen, invalid)
    other_rig = check_rig(seen, invalid, start, balances)
    if other_rig is not None:
        seen = put_on_rig_shaken(seen, other_rig)
        start = {key: value for key, value in start.items() if key.removeprefix("rig.") not in HELD_AGAINST}
    unmended = seen
    if any(fault.kind != "gap" for fault in faults):
        unmended = replace(_shortened(recorded, {})[2], logger=seen.logger, specimen=seen.specimen)
    return Prepared(
        recorded, faults, masks, estimated, logger, other_rig, balances, uncut, unjudged, seen, invalid, start, unmended
    )


def _shortened(
    campaign: Campaign, invalid: InvalidSamples
) -> tuple[Campaign, InvalidSamples, Campaign, InvalidSamples]:
    """Return a campaign decimated, and the excerpts of it that are fitted, each with its invalid samples."""
    uncut, unjudged = decimate(campaign, invalid)
    return uncut, unjudged, *cut_excerpts(uncut, unjudged)
