"""Levels of a structure in another order than campaign.toml maps them, and how each storey answers."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from slipwise.campaign.level_order import ISOLATORS_LEFT, STOREY_LEFT
from slipwise.preparation.level_faults import LevelsOfRun, agreed_late, agreed_turned


@dataclass(frozen=True)
class StoreyAnswer:
    """How the level above a storey's columns, or above the isolators, answers the one below in a run.

    Attributes:
        run: its name.
        level: channel of the level.
        below: channel of the one below.
        left: share of the inertia above that stiffness and damping leave [1].
        frequency: of all above as one mass on this storey [Hz].
        damping: likewise, of critical [1].
    """

    run: str
    level: str
    below: str
    left: float
    frequency: float
    damping: float

    def as_json(self) -> dict[str, Any]:
        """Return the entry of `slipwise audit --json`."""
        return dict(self.__dict__)


def storey_answers(read: Sequence[LevelsOfRun]) -> tuple[StoreyAnswer, ...]:
    """Return how each level answers the one below, in the runs whose levels stand as mapped."""
    return tuple(
        StoreyAnswer(levels.run, upper, lower, link.left, link.frequency, link.critical)
        for levels in read
        if levels.holds and not levels.contradicts
        for lower, upper, link in zip(levels.levels[:-1], levels.levels[1:], levels.links, strict=True)
    )


def contradicted_levels(read: Sequence[LevelsOfRun]) -> list[str]:
    """Say where levels stand in another order than mapped, and what is turned round or late in some runs only."""
    return [*_reordered(read), *_in_some_runs(read)]


def silent_levels(read: Sequence[LevelsOfRun]) -> list[str]:
    """Say of which runs the levels tell nothing of each other."""
    found = []
    for levels in read:
        if not levels.links:
            found.append(f"levels: {levels.run} has fewer than three that move; nothing holds them against each other")
        elif not levels.holds:
            worst = max(
                range(len(levels.links)),
                key=lambda i: levels.links[i].left / (ISOLATORS_LEFT if i == 0 else STOREY_LEFT),
            )
            left = levels.links[worst].left
            found.append(
                f"levels: in {levels.run} {levels.order[worst + 1]} does not answer {levels.order[worst]} as a storey "
                f"does, in no order: {left:.0%} of the force is left"
            )
    return found


def _reordered(read: Sequence[LevelsOfRun]) -> Iterator[str]:
    other = [levels for levels in read if levels.order != levels.levels]
    as_mapped = [levels for levels in read if levels.order == levels.levels and levels.holds]
    for order in dict.fromkeys(levels.order for levels in other):
        these = [levels for levels in other if levels.order == order]
        runs = ", ".join(levels.run for levels in these)
        moved = [f"{is_} in what is mapped to {mapped}" for is_, mapped in zip(these[0].levels, order, strict=True)]
        moved = [words for words, is_, mapped in zip(moved, these[0].levels, order, strict=True) if is_ != mapped]
        if as_mapped:
            yield (
                f"in {runs} the levels stand in another order than in the other runs: the motions show "
                f"{', '.join(moved)}; give that run its own lines in [run.columns]"
            )
        else:
            yield (
                f"the levels stand in another order than [columns] says: in {runs} the motions show "
                f"{', '.join(moved)}; correct [columns]"
            )


def _in_some_runs(read: Sequence[LevelsOfRun]) -> Iterator[str]:
    everywhere = {*agreed_turned(read), *agreed_late(read)}
    for levels in read:
        for name in levels.turned:
            if name not in everywhere:
                yield (
                    f"{name} stands turned round in {levels.run} and not in other runs; give that run sign = -1 for "
                    "it in [run.columns]"
                )
        for name, delay in levels.late.items():
            if name not in everywhere:
                yield (
                    f"{name} comes {1e3 * delay:.0f} ms late in {levels.run}, and not so in other runs; give that run "
                    "a file in which it is in step"
                )
