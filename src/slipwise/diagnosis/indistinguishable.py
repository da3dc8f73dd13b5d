"""Effects that are one thing to a rig, as their files say, unless what tells them apart was measured."""

from collections.abc import Iterable

from slipwise.effects import Effect, catalogue
from slipwise.estimation.objective import Objective
from slipwise.selection.search_state import Search

Pairs = dict[frozenset[str], tuple[str, ...]]


def list_known_effects(state: Search) -> dict[str, Effect]:
    """Return the catalogue and a user's own effects that were looked at, by name."""
    return {**catalogue(), **{t.effect.name: t.effect for t in state.terms}}


def list_alike_pairs(known: Iterable[Effect]) -> Pairs:
    """Return the names of each two effects that may be one thing, with what tells them apart; one file may say so."""
    return {frozenset({e.name, other}): unless for e in known for other, unless in e.same_unless.items()}


def is_distinguishable(objective: Objective, unless: Iterable[str]) -> bool:
    """Return whether two effects that may be one thing are distinguishable in a campaign.

    Args:
        objective: of the campaign.
        unless: what tells the two apart where it was measured: "yaw", or a balance of the girder ("pitch").
    """
    measured = {*objective.relations, *(("yaw",) if objective.run(0).states.has_yaw else ())}
    return not measured.isdisjoint(unless)
