"""What a step is worth: when an effect has earned a name.

An effect counts when it lowers the mean squared residual of some relation by `MATERIAL` noise variances on the fitted
runs and by half of that on held-out runs: significance alone is no rule, for a modeller's own small errors are
significant too. They look like lags of gauges, not like laws of pads and buffers, of which half as much will do.
"""

from collections.abc import Iterable

from slipwise.estimation.parameters import Term
from slipwise.evidence.residual_summary import ResidualSummary

#: Least drop of a relation's mean squared residual that is worth a name [noise variance].
MATERIAL = 0.10
#: The same for laws: of 400 complete models of the blind bench none had one that lowered any relation by 0.035.
MATERIAL_LAW = 0.05
#: What acts on every force or motion at once, and so takes up a modeller's errors.
_EVERYWHERE = ("gauge", "girder", "table")
#: A further effect must lower a relation by more, and by this share of what the base left in it: what the first effect
#: does not quite describe is not a second effect.
MATERIAL_FURTHER = 0.20
FURTHER = 0.025
#: Where the effects before have changed a relation by less than this, on held-out runs by twice as much, they need no
#: repair there, and what is worth a name alone is worth one beside them [noise variance].
_UNTOUCHED = 0.05
#: However much the base left: what takes away this share of all that the first effect leaves, on fitted and on held-out
#: runs, is no repair of it [1].
_NEARLY_ALL = 0.85
#: Share of what is worth a name that a further step has reached where it is worth a fit to the end [1].
_NEAR = 0.5
#: What is really there worsens no relation: right effects raised none by more than 0.012, wrong ones one by 0.08.
_WORSENED = 0.03
#: Hypotheses whose scores differ by less than this much cannot be told apart [noise variance].
SAME_SCORE = 60.0


def material_drop(before: ResidualSummary, after: ResidualSummary) -> tuple[float, str]:
    """Give the largest material drop of a relation's mean squared residual, and the relation.

    The drop on held-out runs counts double, so that it may be half of that on fitted runs but not less; a campaign
    without held-out runs is judged by its fitted ones.
    """
    best, where = 0.0, ""
    for name in before.fitted:
        fitted = before.level(name, held_out=False) - after.level(name, held_out=False)
        if before.counts[name][1]:
            held = before.level(name, held_out=True) - after.level(name, held_out=True)
            fitted = min(fitted, 2.0 * held)
        if fitted > best:
            best, where = fitted, name
    return best, where


def least_material_drop(terms: Iterable[Term]) -> float:
    """Give the drop of a relation's mean squared residual from which on a first step is worth a name [1].

    Args:
        terms: effects that are added.
    """
    return MATERIAL if any(t.effect.port in _EVERYWHERE for t in terms) else MATERIAL_LAW


def material(base: ResidualSummary, before: ResidualSummary, after: ResidualSummary) -> bool:
    """Tell whether a step is worth a name.

    Args:
        base: of the base model.
        before: without the effect.
        after: with it.
    """
    if before is base:
        return material_drop(before, after)[0] >= MATERIAL
    for name in base.fitted:
        excess = max(base.level(name, held_out=False) - 1.0, 0.0)
        drop, least = _further_drop(base, before, after, name)
        if drop >= least and (drop > FURTHER * excess or _nearly_all(before, after, name)):
            return True
    return False


def is_near(base: ResidualSummary, before: ResidualSummary, after: ResidualSummary) -> bool:
    """Tell whether a further step that was fitted with slopes of before may be worth a name once it is fitted on.

    Of 15 such steps on the blind bench fitting on added a fifth at most to what any relation had lost.
    """
    drops = (_further_drop(base, before, after, name) for name in base.fitted)
    return any(drop >= _NEAR * least for drop, least in drops)


def _further_drop(
    base: ResidualSummary, before: ResidualSummary, after: ResidualSummary, name: str
) -> tuple[float, float]:
    """Give by how much a relation's mean squared residual has fallen, and the drop that is worth a name beside others.

    An effect that only repairs what the one before has spoilt explains nothing of the rig.
    """
    lower = {h: min(base.level(name, held_out=h), before.level(name, held_out=h)) for h in (False, True)}
    drop = lower[False] - after.level(name, held_out=False)
    if base.counts[name][1]:
        drop = min(drop, 2.0 * (lower[True] - after.level(name, held_out=True)))
    return drop, MATERIAL if _untouched(base, before, name) else MATERIAL_FURTHER


def _untouched(base: ResidualSummary, before: ResidualSummary, name: str) -> bool:
    """Tell whether a step has left a relation as it was."""
    kinds = (False, True) if base.counts[name][1] else (False,)
    changes = [abs(before.level(name, held_out=h) - base.level(name, held_out=h)) for h in kinds]
    return all(change < _UNTOUCHED * (1 + h) for h, change in zip(kinds, changes, strict=True))


def _nearly_all(before: ResidualSummary, after: ResidualSummary, name: str) -> bool:
    """Tell whether a step leaves next to nothing of what a relation had above its noise before it."""
    kinds = (False, True) if before.counts[name][1] else (False,)
    left = [before.level(name, held_out=h) - 1.0 for h in kinds]
    return all(
        now > 0.0 and after.level(name, held_out=h) - 1.0 < (1.0 - _NEARLY_ALL) * now
        for h, now in zip(kinds, left, strict=True)
    )


def worsens(before: ResidualSummary, after: ResidualSummary) -> bool:
    """Tell whether a step repairs some relation at the cost of another, on fitted and half as much on held-out runs."""
    return material_drop(after, before)[0] > _WORSENED


def score(before: ResidualSummary, after: ResidualSummary) -> float:
    """Give the drop of all squared residuals, held-out runs included; below zero where those get worse."""
    held = sum(before.held_out.values()) - sum(after.held_out.values())
    if held < 0.0:
        return held
    return before.total - after.total


def all_down(account: ResidualSummary) -> bool:
    """Tell whether nothing is left that could be worth a name."""
    return all(account.level(r, held_out=h) < 1.0 + MATERIAL for r in account.fitted for h in (False, True))
