"""Compare: how well does a model do on a campaign, at two levels, and exactly where does it fail."""

from slipwise.compare.hold import compare
from slipwise.compare.result import Comparison
from slipwise.compare.tables import as_json

__all__ = ["Comparison", "as_json", "compare"]
