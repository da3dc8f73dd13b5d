"""Many campaigns: what is kept of each, what they have in common, and how right the verdicts are where one knows."""

from slipwise.studies.campaigns.campaign_key import campaign_key
from slipwise.studies.campaigns.compared import CHANGED, Compared, EffectDifference, ValueChange, compare_outcomes
from slipwise.studies.campaigns.outcome import Outcome, numbers_of, standard_error
from slipwise.studies.campaigns.score import Scored, is_right, rates, read_truth, score_outcomes, with_truth

__all__ = [
    "CHANGED",
    "Compared",
    "EffectDifference",
    "Outcome",
    "Scored",
    "ValueChange",
    "campaign_key",
    "compare_outcomes",
    "is_right",
    "numbers_of",
    "rates",
    "read_truth",
    "score_outcomes",
    "standard_error",
    "with_truth",
]
