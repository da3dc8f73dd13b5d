"""Zeros that are far off, found before any balance: gravity in vertical accelerometers, load cells tared under load."""

from collections.abc import Mapping

from slipwise.campaign import Campaign
from slipwise.campaign.zero_state import ShiftedZero, shifted_zeros
from slipwise.record import Record


def find_shifted_zeros(campaign: Campaign) -> tuple[ShiftedZero, ...]:
    """Return the channels of a campaign whose zero is far off."""
    rig = campaign.specimen
    loads = tuple(f"pad_{pad}_N" for pad in rig.pads) if rig.free else ()
    return shifted_zeros([run.record for run in campaign.runs], loads, rig.weight)


def find_tared_cells(campaign: Campaign) -> tuple[str, ...]:
    """Return the load cells that do not show the girder's weight."""
    return tuple(name for zero in find_shifted_zeros(campaign) if zero.tared for name in zero.channels)


def restore_zeros(record: Record, shifts: Mapping[str, float]) -> Record:
    """Return a record without what its channels read too much, channel -> that [SI]."""
    return record.replaced(**{name: record[name] - size for name, size in shifts.items() if name in record})
