"""The evidence for every effect of a final model, in the few numbers on which its probability rests."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign.materiality import Materiality
from slipwise.diagnosis.hypothesis import Hypothesis, parameters_at_bound
from slipwise.diagnosis.importance import Importance
from slipwise.diagnosis.removal import without
from slipwise.diagnosis.screening import Screened, away_from, basis_of
from slipwise.diagnosis.search_state import Search, left_with, tried_before, try_all
from slipwise.diagnosis.starting_grid import strengths
from slipwise.diagnosis.starting_values import starts_of
from slipwise.estimation.parameters import Term
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.evidence.score import FLOOR, lead, score

Array = NDArray[np.float64]
#: A substitute that a straight line sees explain this share of what an effect explains is fitted in its place [1].
_NEARLY = 0.6
#: Substitutes that are fitted for each effect, and for all.
_FITTED, _FITTED_IN_ALL = 2, 6
#: Nothing is surer than this many standard errors.
_SUREST = 30.0


@dataclass(frozen=True)
class Rival:
    """An effect in the place of one that was found.

    Attributes:
        hypothesis: the final model with the one in the place of the other, fitted.
        behind: by how many standard errors it is behind.
    """

    hypothesis: Hypothesis
    behind: float


@dataclass(frozen=True)
class Finding:
    """One effect of a final model, with all gauges on which it acts.

    Attributes:
        name: of the effect.
        terms: it consists of.
        worth: what the model's score loses without it [nats].
        lead: by how many standard errors the model is better with it, block of time by block.
        share: of the squared residual above the noise that the base model leaves, what comes back without it [1].
        rival: the effect that could best take its place; None where none comes near.
        at_bound: parameters that ended on a bound which is not their absence.
        importance: what leaving it out changes.
        material: importance over what matters [1].
    """

    name: str
    terms: tuple[Term, ...]
    worth: float
    lead: float
    share: float
    rival: Rival | None
    at_bound: tuple[str, ...]
    importance: Importance
    material: float

    @property
    def is_gauge(self) -> bool:
        """Whether it is a fault of gauges."""
        return self.terms[0].effect.component == "instrument"

    @property
    def matters(self) -> bool:
        """Whether it changes more than what is material."""
        return self.material >= 1.0


def findings(state: Search, importances: dict[str, Importance], limits: Materiality) -> list[Finding]:
    """Give the evidence for every effect of a search's final model, most important first.

    Args:
        state: of the finished search.
        importances: effect -> importance.
        limits: what matters.
    """
    final, origin = state.final, state.path[0].summary
    names = [n for n in final.names if n in importances]
    parts = {name: tuple(t for t in final.terms if t.effect.name == name) for name in names}
    left = {n: without(final, parts[n], lambda rest: left_with(state, rest, final)) for n in names}
    rivals = _rivals(state, {n: parts[n] for n in names})
    bounds = parameters_at_bound(final)
    base, end = above_noise(origin, final.summary), above_noise(final.summary, final.summary)
    out = [
        Finding(
            name=n,
            terms=parts[n],
            worth=score(left[n], final.summary),
            lead=min(lead(final.summary, left[n]), _SUREST),
            share=float(np.clip((above_noise(left[n], final.summary) - end) / max(base, 1e-12), 0.0, 1.0)),
            rival=rivals.get(n),
            at_bound=tuple(p for label, p in bounds if label in {t.label for t in parts[n]}),
            importance=importances[n],
            material=importances[n].share_of_limit(limits),
        )
        for n in names
    ]
    return sorted(out, key=lambda f: -f.material)


def above_noise(summary: ResidualSummary, best: ResidualSummary) -> float:
    """Give the squared residual that stands above the noise, over all relations.

    Args:
        summary: of a hypothesis.
        best: one that may tell that the noise is less than was thought, for it leaves less.
    """
    return sum(
        max(summary.left_out[r] - min(count, best.left_out[r]), 0.0) for r, (count, _) in summary.counts.items()
    )


def _rivals(state: Search, parts: dict[str, tuple[Term, ...]]) -> dict[str, Rival]:
    """Fit, for every effect, what a straight line sees do nearly as much in its place; give the best of each."""
    final = state.final
    asked: list[tuple[str, Screened]] = []
    for name, terms in parts.items():
        asked += [(name, s) for s in _substitutes(state, terms)[:_FITTED]]
    asked = asked[:_FITTED_IN_ALL]
    out: dict[str, Rival] = {}
    for name in dict.fromkeys(n for n, _ in asked):
        rest = [t for t in state.best.terms if t.effect.name != name]
        chosen = [s for n, s in asked if n == name]
        fitted = [h for s in chosen for h in tried_before(state, [*rest, s.term])]
        fresh = [s for s in chosen if not tried_before(state, [*rest, s.term])]
        fitted += try_all(state, starts_of(fresh, rest), left_with(state, rest, state.best)) if fresh else []
        best = max(fitted, key=lambda h: score(state.best.summary, h.summary), default=None)
        if best is not None:
            out[name] = Rival(best, float(np.clip(lead(state.best.summary, best.summary), -_SUREST, _SUREST)))
    return out


def _substitutes(state: Search, terms: Sequence[Term]) -> list[Screened]:
    """Give candidates that nearly explain what an effect explains, beside all others of the final model."""
    whole = state.best
    labels = {t.label for t in terms}
    problem, solution = whole.problem, whole.solution
    stays = np.array([f.key.rpartition(".")[0] not in labels for f in solution.free], dtype=bool)
    mine = solution.jacobian[:, ~stays]
    if not mine.shape[1]:
        return []
    weights = _weights(whole)
    basis = basis_of(solution.jacobian[:, stays] * weights[:, None])
    absent = {f"{t.label}.{p.name}": float(p.neutral or 0.0) for t in terms for p in strengths(t.effect)}
    own = [f for f, kept in zip(solution.free, stays, strict=True) if not kept]
    amounts = np.array([(solution.values[f.key] - absent.get(f.key, solution.values[f.key])) / f.scale for f in own])
    step = away_from(basis, weights * (mine @ amounts))  # what the effect does, the others making up for what they can
    total = float(step @ step)
    used = set(whole.names)
    out: list[tuple[float, Screened]] = []
    for s in state.all_screened:
        if s.term.effect.name in used:
            continue
        column = away_from(basis, weights * s.column.astype(np.float64))
        length = float(column @ column)
        explained = float(step @ column) ** 2 / length if length > 1e-9 else 0.0
        if explained > _NEARLY * total:
            out.append((explained, s))
    return [s for _, s in sorted(out, key=lambda pair: -pair[0])]


def _weights(found: Hypothesis) -> Array:
    """Give the weight of every row: one over the level that the hypothesis leaves in its relation."""
    problem = found.problem
    return np.concatenate(
        [
            np.full(found.solution.residuals.parts[r][i].size, max(found.summary.left_out_level(r), FLOOR) ** -0.5)
            for r in problem.relations
            for i in problem.fitted
        ]
    )
