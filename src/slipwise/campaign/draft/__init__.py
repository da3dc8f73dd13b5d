"""A first campaign.toml, drafted from the files of a folder."""

from slipwise.campaign.draft.campaign_file import draft_campaign, init_campaign

__all__ = ["draft_campaign", "init_campaign"]
