"""Compare: how well does a model do on a campaign, at two levels, and exactly where does it fail."""

from slipwise.compare.checks import Checks, check_instruments, corrected_campaign
from slipwise.compare.hold import compare
from slipwise.compare.refine import Refined, refine
from slipwise.compare.result import Comparison
from slipwise.compare.tables import as_json

__all__ = [
    "Checks",
    "Comparison",
    "Refined",
    "as_json",
    "check_instruments",
    "compare",
    "corrected_campaign",
    "refine",
]
