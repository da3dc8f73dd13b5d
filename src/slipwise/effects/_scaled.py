"""Effects for a rig of another size: typical values and bounds as its weight, or a slider's record, scales them."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from slipwise.channels import channel
from slipwise.effects._catalogue import catalogue
from slipwise.effects._effect import Effect
from slipwise.params import Parameter


def scaled(effect: Effect, scale: Callable[[str], float], room: float) -> Effect:
    """Return an effect whose typical values and bounds are scaled by their units; itself where nothing is.

    One that is not of the catalogue stays as it is: its user has given it the numbers of his own rig.

    Args:
        effect: of the catalogue with the numbers of the reference rig, or a user's own.
        scale: SI unit -> how many times larger such quantities are [1].
        room: how much wider the bounds of what is scaled are on both sides [1].
    """
    if effect.name not in catalogue() or all(scale(p.unit) == 1.0 for p in effect.parameters):
        return effect
    return replace(effect, parameters=tuple(_scaled(p, scale(p.unit), room) for p in effect.parameters))


def scaled_to_gauge(effect: Effect, target: str, scale: Callable[[str], float]) -> Effect:
    """Return a gauge's fault that is counted in spans as one slider's gauge has them; itself where it is not.

    Args:
        effect: the fault.
        target: a channel on which it sits.
        scale: SI unit -> how many times larger such quantities are than in the reference rig [1].
    """
    factor = scale(channel(target).unit)
    if effect.fault is None or not effect.fault.unit.startswith("channel") or factor == 1.0:
        return effect
    spans = tuple(_scaled(p, factor, 1.0) if p.neutral is not None else p for p in effect.parameters)
    return replace(effect, parameters=spans)


def _scaled(p: Parameter, factor: float, room: float) -> Parameter:
    if factor == 1.0:
        return p
    low = p.low * factor * (room if p.low < 0.0 else 1.0 / room)
    neutral = None if p.neutral is None else p.neutral * factor
    return replace(p, typical=p.typical * factor, low=low, high=p.high * factor * room, neutral=neutral)


def holding(effect: Effect, values: Mapping[str, float]) -> Effect:
    """Return an effect whose bounds hold these values, pure numbers apart: what was stated of a slider is possible.

    Args:
        effect: whose bounds.
        values: parameter -> value [SI], also those of single pads: strength[A].
    """
    kept = tuple(_holding(p, values) if p.unit != "1" else p for p in effect.parameters)
    return effect if kept == effect.parameters else replace(effect, parameters=kept)


def _holding(p: Parameter, values: Mapping[str, float]) -> Parameter:
    given = [v for n, v in values.items() if n.partition("[")[0] == p.name]
    return replace(p, low=min(p.low, *given), high=max(p.high, *given))
