"""The catalogue: one small file per physical or instrument effect."""

from slipwise.effects._by_pad import for_pads
from slipwise.effects._catalogue import base_effects, catalogue, find_effect, load_effect
from slipwise.effects._effect import CONTRACT, RESPONSE, Effect, moved_channels
from slipwise.effects._fault import GaugeFault
from slipwise.effects._fields import NEEDS, ForDiagnosis, Gauges, Limit, Rare
from slipwise.effects._hooks import (
    COMPONENTS,
    DERIVED,
    FRICTION_PORTS,
    HOOKS,
    LAGGING,
    PAD_HOOKS,
    PAD_INPUTS,
    PORTS,
    RIG_MOTION,
)
from slipwise.effects._read import read_effect
from slipwise.effects._scaled import holding, scaled, scaled_to_gauge
from slipwise.effects._skeleton import skeleton
from slipwise.effects._states import BalanceStates
from slipwise.effects._trust import Trust, check_trusted
from slipwise.effects._writer import WrittenEffect, check_name, effect_text, write_effect
from slipwise.effects._written_hook import WrittenHook

__all__ = [
    "BalanceStates",
    "COMPONENTS",
    "CONTRACT",
    "DERIVED",
    "FRICTION_PORTS",
    "HOOKS",
    "LAGGING",
    "PAD_HOOKS",
    "PAD_INPUTS",
    "NEEDS",
    "PORTS",
    "RIG_MOTION",
    "RESPONSE",
    "ForDiagnosis",
    "Effect",
    "GaugeFault",
    "Gauges",
    "Limit",
    "Rare",
    "Trust",
    "WrittenEffect",
    "WrittenHook",
    "base_effects",
    "catalogue",
    "check_name",
    "check_trusted",
    "effect_text",
    "find_effect",
    "for_pads",
    "holding",
    "load_effect",
    "moved_channels",
    "read_effect",
    "scaled",
    "scaled_to_gauge",
    "skeleton",
    "write_effect",
]
