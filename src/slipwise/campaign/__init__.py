"""Campaigns: runs of one specimen, read from a folder with campaign.toml."""

from slipwise.campaign.campaign import ROLES, Campaign, Logger, Run
from slipwise.campaign.reader import as_campaign, load_campaign
from slipwise.campaign.states import States, measured_states

__all__ = ["ROLES", "Campaign", "Logger", "Run", "States", "as_campaign", "load_campaign", "measured_states"]
