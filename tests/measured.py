"""Campaigns in memory, fitted and mended as a command does it."""

from collections.abc import Sequence

from slipwise.campaign import Campaign
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.base_fit import fit_base as fit_with_known_logger
from slipwise.model import Model
from slipwise.preparation.balance_records import BalanceRecords, leave_out_bad_rows
from slipwise.preparation.logger import determine_logger
from slipwise.preparation.masks import bridge_bad_samples, mask_bad_samples
from slipwise.preparation.put_right import put_right
from slipwise.preparation.sample_fault import SampleFault


def fit_base(campaign: Campaign, model: Model | None = None, invalid: InvalidSamples | None = None) -> BaseFit:
    """Fit a campaign's base parameters with no look at its samples, its logger as every command takes it."""
    seen, _, start = determine_logger(campaign, invalid or {})
    return fit_with_known_logger(seen, model, invalid, start)


def mended_for_fits(campaign: Campaign, faults: Sequence[SampleFault]) -> tuple[Campaign, InvalidSamples]:
    """Put faults right, bridge bad samples, and give those that must not be judged."""
    right = put_right(campaign, faults)
    return bridge_bad_samples(right, mask_bad_samples(right, faults))


def mended_for_balances(campaign: Campaign, faults: Sequence[SampleFault]) -> BalanceRecords:
    """Put faults right, and leave out the rows that bad samples spoil."""
    return leave_out_bad_rows(put_right(campaign, faults), faults)
