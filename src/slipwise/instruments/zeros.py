"""Zeros that are far off, found before any balance: gravity in vertical accelerometers, load cells tared under load."""

from slipwise.campaign import Campaign
from slipwise.campaign.zero_state import LOADS, ZeroState, zero_state
from slipwise.effects._gauges import span
from slipwise.instruments.suspects import effect_of


def shifted_zeros(campaign: Campaign) -> list[tuple[tuple[str, ...], float]]:
    """Give channels and what they read too much [SI]: gravity, or minus the quarter of the weight that was tared."""
    state = _state(campaign)
    found: list[tuple[tuple[str, ...], float]] = [((name,), size) for name, size in state.gravity.items()]
    if state.missing_weight is not None:
        found.append((LOADS, -state.missing_weight / len(LOADS)))
    return found


def words_of_zero(campaign: Campaign, channels: tuple[str, ...]) -> str:
    """Say what stands in the zero of these channels."""
    state = _state(campaign)
    words = dict(zip([*((name,) for name in state.gravity), LOADS], state.words(), strict=False))
    return words[channels]


def values_of_zero(channels: tuple[str, ...], size: float) -> dict[str, float]:
    """Give the parameters of that effect."""
    return {effect_of("shifted").parameters[0].name: size / span(channels[0])}


def _state(campaign: Campaign) -> ZeroState:
    weight = campaign.specimen.weight if campaign.specimen.free else None
    return zero_state([run.record for run in campaign.runs], weight)
