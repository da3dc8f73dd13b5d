"""What a named effect means for the bridge: many earthquakes, with it and without it."""

from slipwise.studies.consequence.judge import judge_consequence
from slipwise.studies.consequence.result import Consequence, Distribution

__all__ = ["Consequence", "Distribution", "judge_consequence"]
