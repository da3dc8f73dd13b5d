"""The catalogue: one small file per physical or instrument effect."""

from slipwise.effects._catalogue import catalogue, find_effect, load_effect
from slipwise.effects._effect import COMPONENTS, HOOKS, PORTS, RESPONSE, Effect, moved_channels, read_effect
from slipwise.effects._states import BalanceStates

__all__ = [
    "BalanceStates",
    "COMPONENTS",
    "HOOKS",
    "PORTS",
    "RESPONSE",
    "Effect",
    "catalogue",
    "find_effect",
    "load_effect",
    "moved_channels",
    "read_effect",
]
