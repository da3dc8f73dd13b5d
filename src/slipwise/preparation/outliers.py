"""Records without outliers: what lags, signs, units, balances and gains are estimated from."""

from dataclasses import replace

from slipwise.campaign import Campaign
from slipwise.campaign.wild_samples import not_motion
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.signals.outliers import outliers
from slipwise.signals.short_bursts import bridge_samples


def bridge_outliers(campaign: Campaign) -> Campaign:
    """Return a campaign with the outliers of every run bridged."""
    runs = (replace(run, record=bridge_outliers_of(run.record, campaign.specimen)) for run in campaign.runs)
    return replace(campaign, runs=tuple(runs))


def bridge_outliers_of(record: Record, specimen: Specimen) -> Record:
    """Return a record with the outliers of its channels bridged, but for those that a balance confirms as a motion."""
    channels = record.channels
    found = not_motion({name: outliers(values) for name, values in channels.items()}, channels, specimen)
    return record.replaced(**{name: bridge_samples(channels[name], bad) for name, bad in found.items()})
