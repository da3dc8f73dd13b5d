"""What speaks for a suspect, and why it may be refused: sizes that agree, a share of what is seen, an interval."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.instruments.joint_fit import EVIDENCE, Case, JointFit, predicted
from slipwise.instruments.suspects import Suspect
from slipwise.noise.level import AT_FLOOR
from slipwise.regression.normal_equations import build_equations, invert_regularised, weigh_equations

#: A fault explains at least this part of what its relations show above their floors, and of what they showed at first.
_SHARE, _FIRST_SHARE = 0.5, 0.1
#: Sizes seen by single runs and single relations lie within this of the whole [1], or this many standard errors.
_AGREE, _APART = 0.5, 3.0
#: A size is known when it is this many standard errors from zero, in balances that may accuse too.
_SIGNIFICANT = 4.0
#: Runs and relations that hold less than this part of the evidence are not asked.
_ASKED = 0.08


@dataclass(frozen=True)
class Evidence:
    """What speaks for one suspect.

    Attributes:
        suspect: who.
        size: fitted.
        error: its standard error.
        share: of what its relations showed above their floors that it explains [1].
        runs: sizes that single runs give.
        balances: relation -> size that it gives alone.
        gain: of the score.
        rivals: (name, loss of score if the rival stood in its place), nearest first.
        why_not: reason for refusal, or "".
        small: whether its size is below what matters.
    """

    suspect: Suspect
    size: float
    error: float
    share: float
    runs: tuple[float, ...]
    balances: dict[str, float]
    gain: float
    rivals: tuple[tuple[str, float], ...] = ()
    why_not: str = ""
    small: bool = False


def weigh(case: Case, first: JointFit, before: JointFit, after: JointFit, number: int) -> Evidence:
    """Say what speaks for the suspect that a fit has and the one before has not.

    Args:
        case: what is judged.
        first: a fit without physics, against which the suspect must explain something too.
        before: the fit without the suspect.
        after: the fit with it.
        number: of the suspect among the sizes of that fit.
    """
    suspect, size = after.model.sizes[number]
    free = _alone(after, len(after.stack.base) + number)
    weight = {n: 1.0 / s for n, s in after.scale.items()}
    asked = [r.name for r in case.relations if r.accuses and r.name in free]
    power = {n: (weight[n] * free[n]) ** 2 for n in asked}
    along = {n: weight[n] ** 2 * free[n] * (after.left[n] + size * free[n]) for n in asked}
    total = sum(float(p.sum()) for p in power.values()) or 1e-300
    balances = {n: float(along[n].sum() / power[n].sum()) for n in asked if float(power[n].sum()) > _ASKED * total}
    # standard errors grow with what is left, for a relation weighs by that
    spread = {n: _error(float(power[n].sum())) for n in balances}
    runs, run_errors = [], []
    for i in range(len(case.runs)):
        weight_of_run = sum(float(power[n][after.stack.run_of[n] == i].sum()) for n in asked)
        projection = sum(float(along[n][after.stack.run_of[n] == i].sum()) for n in asked)
        if weight_of_run > _ASKED * total:
            runs.append(projection / weight_of_run)
            run_errors.append(_error(weight_of_run))
    share, first_share = _shares(first, before, after, balances)
    gain, little = after.score - before.score, abs(size) < suspect.least
    evidence = Evidence(suspect, size, after.errors[number], share, tuple(runs), balances, gain, small=little)
    apart = {"runs": _apart(size, runs, run_errors), "balances": _apart(size, balances.values(), spread.values())}
    return replace(evidence, why_not=_why_not(evidence, first_share, _error(total), apart))


def _error(power: float) -> float:
    """Return the standard error of a size that has so much weighed power behind it."""
    return 1.0 / float(np.sqrt(max(EVIDENCE * power, 1e-300)))


def _apart(size: float, sizes: Iterable[float], errors: Iterable[float]) -> bool:
    """Return whether single sizes differ from the whole by more than usual, and by more than their errors."""
    return any(
        abs(one - size) > max(_AGREE * abs(size), _APART * error) for one, error in zip(sizes, errors, strict=True)
    )


def _alone(after: JointFit, number: int) -> dict[str, Array]:
    """Return a signature without what constants and the other explanations could imitate, relation -> (n,)."""
    own = {n: columns[:, 0] for n, columns in after.columns[number].items()}
    others = [block for i, block in enumerate(after.columns) if i != number]
    whole = {n: own.get(n, np.zeros(len(left))) for n, left in after.left.items()}
    parts, starts = build_equations(others, whole)
    squares, along = weigh_equations(parts, {n: 1.0 / s for n, s in after.scale.items()}, int(starts[-1]))
    solution = invert_regularised(squares) @ along
    return {n: rows - predicted(others, n, solution, starts) for n, rows in whole.items()}


def _shares(first: JointFit, before: JointFit, after: JointFit, balances: Mapping[str, float]) -> tuple[float, float]:
    """Return the part of the excess over the floors that the last explanation took: of what was left, and of all."""
    took = was = began = 0.0
    for name in balances:
        squares = [float(np.sum((f.left[name] / after.floor[name]) ** 2)) for f in (first, before, after)]
        sure = AT_FLOOR**2 * len(after.left[name])
        took += squares[1] - squares[2]
        was += max(squares[1] - sure, 0.0)
        began += max(squares[0] - sure, 0.0)
    return (took / was if was > 0.0 else 1.0), (took / began if began > 0.0 else 1.0)


def possible(evidence: Evidence) -> bool:
    """Return whether a size has a sign that the fault can have."""
    return evidence.size > 0.0 or not evidence.suspect.one_sided


def _why_not(evidence: Evidence, first_share: float, error: float, apart: Mapping[str, bool]) -> str:
    suspect, size = evidence.suspect, evidence.size
    if not evidence.balances:
        return "no balance that may accuse shows it"
    if not possible(evidence):
        return "its size has a sign that this fault cannot have"
    if evidence.small:
        return f"{size:.3g} {suspect.unit} is below {suspect.least:g}, from where it matters"
    if abs(size) < _SIGNIFICANT * evidence.error:
        return "its interval reaches zero"
    if abs(size) < _SIGNIFICANT * error:
        return "the balances that may accuse are too noisy to confirm it: only pads that differ show it"
    if evidence.share < _SHARE:
        return f"it explains only {evidence.share:.0%} of what its balances show"
    if first_share < _FIRST_SHARE:
        return f"it explains only {first_share:.0%} of what its balances showed before anything else was named"
    for kind, sizes in (("runs", evidence.runs), ("balances", tuple(evidence.balances.values()))):
        if apart[kind]:
            return f"{kind} disagree on its size: " + ", ".join(f"{one:.3g}" for one in sizes)
    return ""
