"""Fits of a session: from where its numbers stand, told of as they go on, and stopped by whoever listens."""

import os
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from math import isfinite

from slipwise.estimation.base_fit import BaseFit, refit_finally
from slipwise.estimation.intervals import Interval, compute_intervals
from slipwise.estimation.least_squares import Solution, solve
from slipwise.estimation.objective import Objective
from slipwise.preparation.prepared import fit_prepared
from slipwise.session.evaluation import Evaluator
from slipwise.session.state import Known, SessionState, Weights

#: Called with what is being done and the share done; what it raises ends the fit.
Progress = Callable[[str, float], None]
#: Somebody who waits is told at least so often [s].
_TOLD_EVERY = 0.2
#: A fit is over when a step lowers the squared residual by less than this, and by less than this share of what is left
#: above the noise; one that falls by more than this share is followed by another, so often at most [1].
_ENOUGH, _ROUGH, _FALLS, _AGAIN = 10.0, 5e-4, 0.05, 3


@dataclass
class Watch:
    """Counts the evaluations of a fit and tells of them.

    How many a fit needs is not known before: within its stage the share done comes ever nearer to the whole.

    Attributes:
        progress: whom to tell.
        stage: what is being done.
        begin: share done when this stage began [1].
        end: share done when it is over [1].
        usual: evaluations that this stage usually takes.
    """

    progress: Progress
    stage: str = "fitting"
    begin: float = 0.0
    end: float = 1.0
    usual: int = 50
    _count: int = 0
    _told: float = -1.0
    _here: int = field(default_factory=os.getpid)

    def next(self, stage: str, end: float, usual: int) -> None:
        """Go on to the next stage."""
        self.begin, self.end, self.stage, self.usual, self._count = self.end, end, stage, usual, 0
        self.progress(stage, self.begin)

    def __call__(self) -> None:
        """Count one evaluation; processes that take their part of the slopes tell nobody."""
        if os.getpid() != self._here:
            return
        self._count += 1
        now = time.monotonic()
        if now - self._told > _TOLD_EVERY:
            self._told = now
            share = self._count / (self._count + self.usual)
            self.progress(self.stage, self.begin + (self.end - self.begin) * share)


def fit_state(ready: Evaluator, state: SessionState, progress: Progress) -> SessionState:
    """Fit all numbers of a state to the runs that may be fitted, and say how sure each is.

    A state that no fit has been near to begins from rated numbers, as every command does; any other from where it
    stands, with the noise weighed by the law that is fitted, in the end twice.

    Args:
        ready: the campaign.
        state: where to begin.
        progress: told of the fit; what it raises ends it.
    """
    watch = Watch(progress, end=0.0)
    weighed_terms = state.weights.terms
    if state.weights.fitted:
        watch.next("fitting from here", 0.45, 40)
        objective, solution = _from_here(ready, ready.objective(ready.coarse(state), watch), state, state.values)
    else:
        watch.next("fitting from rated numbers", 0.45, 60)
        base = fit_prepared(ready.prepared, ready.model, watch)
        objective, solution, weighed_terms = base.objective, base.solution, base.objective.terms
        if state.terms != objective.terms:
            values = {**state.values, **{k: v for k, v in solution.values.items() if k.startswith("rig.")}}
            objective, solution = _from_here(ready, objective.having(state.terms), state, values)
    watch.next("fitting on, with the noise that this law leaves", 0.85, 80)
    objective, solution = refit_finally(objective, solution)
    watch.next("how sure the numbers are", 1.0, 30)
    fit = BaseFit(ready.prepared.campaign, ready.model, objective, solution.free, solution)
    known = {e.key: _known(e) for e in compute_intervals(fit).entries}
    weighed = objective.weighing.weighed_by
    # a slider keeps the noise of its base law: another floor would make errors before and after two different things
    terms = state.terms if objective.balanced else weighed_terms
    weights = Weights(terms, weighed, finer=objective.balanced, yaw=objective.yaw, fitted=True)
    values = {**state.values, **solution.values}
    progress("done", 1.0)
    return replace(state, values=values, weights=weights, fitted=True, known=known, words="fitted", edit="")


def _from_here(
    ready: Evaluator, objective: Objective, state: SessionState, values: Mapping[str, float]
) -> tuple[Objective, Solution]:
    free = ready.free(state)
    start = {**values, **{f.key: min(max(values.get(f.key, f.start), f.low), f.high) for f in free}}
    solution = solve(objective, start, free, most=8, enough=_ENOUGH, rough=_ROUGH)
    for _ in range(_AGAIN):
        before = solution.cost
        solution = solve(objective, solution.values, free, most=6, enough=_ENOUGH, rough=_ROUGH)
        if before - solution.cost < _FALLS * solution.cost:
            break
    return objective, solution


def _known(entry: Interval) -> Known:
    low, high = (e if isfinite(e) else None for e in (entry.low, entry.high))
    return Known(low, high, entry.bound, entry.limit)
