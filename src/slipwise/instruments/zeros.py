"""Zeros that are far off as findings of the audit, and what the balances add to them."""

from collections.abc import Iterable
from dataclasses import replace

from slipwise.campaign.zero_state import ShiftedZero
from slipwise.effects._gauges import span
from slipwise.instruments.report import Finding
from slipwise.instruments.suspects import effect_of


def values_of_zero(zero: ShiftedZero) -> dict[str, float]:
    """Return the parameters of the effect that a shifted zero is."""
    return {effect_of("shifted").parameters[0].name: zero.size / span(zero.channels[0])}


def with_refined_zeros(shifted: Iterable[Finding], refined: Iterable[Finding]) -> list[Finding]:
    """Join what the weight says of a cell's zero with what the balances add to it: one cell has one zero.

    Args:
        shifted: findings of zeros that are far off, among others.
        refined: what the balances found once those were put right.
    """
    found, offset = list(shifted), effect_of("shifted").name
    for more in refined:
        at = next((i for i, first in enumerate(found) if first.name == more.name and more.what == offset), None)
        if at is None:
            found.append(more)
            continue
        first = found[at]
        zero = ShiftedZero((first.channel,), first.size + more.size)
        ends = {"low": first.size + more.low, "high": first.size + more.high}
        found[at] = replace(first, size=zero.size, words=zero.words, values=values_of_zero(zero), **ends)
    return found
