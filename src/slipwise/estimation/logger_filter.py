"""What the logger's filter was, where the campaign does not say: the one through which reversals look as they do.

At a reversal friction turns round within a fraction of a millisecond. What the record makes of that step is the
filter's own step response, ringing and lag included, so kind, order and frequency can be read from it. They are read
in the run whose reversals say most, and beside a level and a gain that may wander: a friction that heats up, runs in or
reads the load too has bent them least there. Of eight campaigns of another simulator whose filter is on record seven
were found within 7 %, beside heating and cross-talk too; under a washboard no filter was estimated.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.signal import fftconvolve
from scipy.signal.windows import gaussian

from slipwise.campaign import Campaign, Logger, Run
from slipwise.estimation.least_squares import Solution, solve
from slipwise.estimation.parameters import YAW_INERTIA, Free, Term, base_free, terms_of
from slipwise.estimation.problem import Problem
from slipwise.estimation.run_data import FitRun, fit_runs
from slipwise.model import Model
from slipwise.parallel import on_every_core
from slipwise.signals import LowPass, lowpass

Array = NDArray[np.float64]
_KINDS: tuple[tuple[int, str], ...] = ((4, "zero"), (2, "zero"), (4, "causal"), (2, "causal"))
_FREQUENCIES: tuple[float, ...] = (55.0, 80.0, 115.0, 165.0)
#: A kind is looked at more closely while its best error is within that of the best of all, and the squared error may
#: fall by this power of the step in frequency: it fell by 2.5 to 3.5 where a grid was 0.8 or 1.25 times off.
_STEEP = 3.0
#: A closer look is in vain where the worst of all is not this much worse than the best: the law is wrong by far more
#: than a filter could be, and the usual kind is taken [1].
_DISTINGUISHED = 1.3
#: A filter is the same to the pads if it leaves no more than this of what the best leaves [1].
_SAME = 1.02
#: Ratio of neighbouring frequencies at which the closer look begins and ends; each round takes its square root.
_WIDE, _NARROW = 1.2, 1.02
#: Numbers of the rig that decide how a reversal looks.
_OF_REVERSALS = ("rig.stick_length", "rig.late_force", "rig.pitch_slip", "rig.shear_strength")
#: What filters differ in lies above this [Hz].
_SHARP = 50.0
#: Time within which a friction that only rises or falls, or a zero that wanders, says nothing of a filter [s].
_LOCAL = 0.15
#: Gains of a moment that friction may have, and that a moment in which it hardly changes may ask for [1].
_GAINS = (0.5, 2.0)


def _frequencies(limit: float) -> list[float]:
    """Give frequencies to begin with, below the highest that samples can show; lower ones for a slow logger [Hz]."""
    usual = [f for f in _FREQUENCIES if f < limit]
    return usual if len(usual) > 1 else [f * limit / (_WIDE * _FREQUENCIES[-1]) for f in _FREQUENCIES]


def _clearest(campaign: Campaign, first: Solution) -> Run:
    """Give the run whose reversals speak loudest against what a fit leaves of the pads' forces."""

    def clearness(place: int) -> float:
        said, left = first.residuals.pad_forces[place], first.residuals.parts["pads"][place]
        dt = campaign.runs[place].record.dt
        sharp = np.stack([f - lowpass(f, dt, LowPass(_SHARP)) for f in said.T], axis=1)
        return float(np.sum(sharp**2) / np.sum(left**2))

    fitted = [i for i, run in enumerate(campaign.runs) if run.role != "holdout"]
    return campaign.runs[max(fitted, key=clearness)]


def _levelled(run: FitRun, said: Array) -> FitRun:
    """Give a run whose pads' forces have the level and the gain of what is said, moment by moment.

    Args:
        run: what was measured.
        said: (n, p) what is predicted [N].
    """
    kept = run.judged["pads"].astype(float)
    width = _LOCAL / run.dt
    kernel = gaussian(2 * round(4.0 * width) + 1, width)[:, None]
    kernel /= np.sum(kernel)

    def spread_out(values: Array) -> Array:
        return fftconvolve(values, kernel, mode="same", axes=0)

    weight = np.maximum(spread_out(kept), 1e-6)
    seen_level, said_level = spread_out(kept * run.force) / weight, spread_out(kept * said) / weight
    together = spread_out(kept * run.force * said) / weight - seen_level * said_level
    alone = spread_out(kept * said**2) / weight - said_level**2
    gain = np.clip(together / np.maximum(alone, 1e-12 * float(np.max(said**2))), *_GAINS)
    return replace(run, force=said_level + (run.force - seen_level) / gain)


@dataclass
class _FilterTrials:
    """Filters under which one run was fitted.

    Attributes:
        campaign: of that run alone.
        model: its base model.
        terms: effects beside the model's.
        free: numbers that may change.
        steady: the run as it is under every filter that moves nothing in time.
        left: filter -> squared error of the pads' forces that is left [N^2].
        ended: filter -> values at which its fit ended.
    """

    campaign: Campaign
    model: Model
    terms: tuple[Term, ...]
    free: list[Free]
    steady: FitRun
    left: dict[LowPass, float] = field(default_factory=dict[LowPass, float])
    ended: dict[LowPass, dict[str, float]] = field(default_factory=dict[LowPass, dict[str, float]])

    def try_all(self, asked: Sequence[tuple[LowPass, Mapping[str, float]]], jacobians: int) -> None:
        """Fit under each filter that was not tried yet, from the values beside it."""
        fresh = [(kind, begin) for kind, begin in dict(asked).items() if kind not in self.left]
        answers = on_every_core(lambda i: self._fitted(*fresh[i], jacobians), len(fresh))
        for (kind, _), (left, values) in zip(fresh, answers, strict=True):
            self.left[kind], self.ended[kind] = left, values

    def best_of(self, kinds: Iterable[LowPass]) -> LowPass:
        """Give the filter that leaves least of those that were tried."""
        return min(kinds, key=self.left.__getitem__)

    def _fitted(self, kind: LowPass, start: Mapping[str, float], jacobians: int) -> tuple[float, dict[str, float]]:
        steady = kind.phase == "zero"
        run = replace(self.steady, filtered=kind) if steady else _prepared(self.campaign, kind)
        values, said = start, np.empty(0)
        for most in (jacobians, 1):
            problem = Problem([run], self.model.specimen, (*terms_of(self.model), *self.terms))
            problem.relations = ("pads",)
            problem.weigh(values)
            found = solve(problem, values, self.free, most=most, enough=20.0)
            values, said = found.values, found.residuals.pad_forces[0]
            run = _levelled(run, said)
        left = np.where(run.judged["pads"], run.force - said, 0.0)
        return float(np.sum(left**2)), dict(values)


def _prepared(campaign: Campaign, kind: LowPass) -> FitRun:
    """Give a campaign's only run as it is under a filter."""
    return fit_runs(replace(campaign, logger=Logger(kind, known=True)))[0]


def estimated_logger(
    campaign: Campaign, model: Model, first: Solution, terms: Sequence[Term] = (), earlier: LowPass | None = None
) -> LowPass:
    """Give the filter under which the law of friction, fitted anew for each, explains one run's pads best.

    A law that was fitted under a wrong filter has bent itself to it and speaks for a filter like that one.

    Args:
        campaign: of unknown logger.
        model: its base model.
        first: a fit with a guessed filter; a start.
        terms: effects that this fit has added to the model: what they do at reversals is not the filter's doing.
        earlier: the filter that was found without them; it stays unless another is better by more than a trifle.
    """
    chosen = _clearest(campaign, first)
    limit = 0.48 / chosen.record.dt
    start = {k: v for k, v in first.values.items() if k != "rig.logger"}
    start |= {"rig.stick_length": 1e-6, "rig.late_force": 0.0}
    own = [f for f in base_free(model, balances=True) if not f.key.startswith("rig.") or f.key in _OF_REVERSALS]
    if terms:
        beside = tuple(f"{t.label}." for t in terms)
        own += [f for f in first.free if f.key.startswith(beside) or f.key == YAW_INERTIA]
    one = replace(campaign, runs=(replace(chosen, role="fit"),))
    coarse = [[LowPass(f, order, phase) for f in _frequencies(limit)] for order, phase in _KINDS]
    steady = next(kind for kinds in coarse for kind in kinds if kind.phase == "zero")
    trials = _FilterTrials(one, model, tuple(terms), own, _prepared(one, steady))
    trials.try_all([(kind, start) for kinds in (*coarse, [earlier] if earlier else []) for kind in kinds], 3)
    if max(trials.left.values()) < _DISTINGUISHED * min(trials.left.values()):
        return earlier or trials.best_of(coarse[0])
    best = _looked_closely(trials, [trials.best_of(kinds) for kinds in coarse], limit)
    return earlier if earlier and trials.left[earlier] < _SAME * trials.left[best] else best


def _looked_closely(trials: _FilterTrials, leaders: list[LowPass], limit: float) -> LowPass:
    """Give the best filter of any kind whose leader is near the best, with ever smaller steps in frequency."""
    ratio = _WIDE
    while ratio > _NARROW:
        least = min(trials.left[k] for k in leaders)
        leaders = [k for k in leaders if trials.left[k] <= ratio**_STEEP * least]
        beside = [[replace(k, frequency=k.frequency * x) for x in (1.0 / ratio, 1.0, ratio)] for k in leaders]
        beside = [[k for k in kinds if k.frequency < limit] for kinds in beside]
        asked = [(k, trials.ended[leader]) for leader, kinds in zip(leaders, beside, strict=True) for k in kinds]
        trials.try_all(asked, 2)
        leaders = [trials.best_of(kinds) for kinds in beside]
        ratio = float(np.sqrt(ratio))
    return trials.best_of(leaders)
