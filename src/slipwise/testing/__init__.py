"""For who writes an effect: hold its file to the contract that every effect of the catalogue keeps."""

from slipwise.testing.check import check_effect
from slipwise.testing.checks import CHECKS, ContractError

__all__ = ["CHECKS", "ContractError", "check_effect"]
