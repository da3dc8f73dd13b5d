"""What a selection has looked at, never changed in place, and the refits that it asks for."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.least_squares import Solution
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.evidence.score import compute_score
from slipwise.jobs.parallel import on_every_core
from slipwise.relations.parameters import Term
from slipwise.selection.explained_alone import ExplainedAlone
from slipwise.selection.hypothesis import Hypothesis, polish, refit
from slipwise.selection.inclusion import Inclusion
from slipwise.selection.jacobian_memory import ROOM, complete_jacobian, drop_jacobian, lightened, size_of
from slipwise.selection.linearisation import Linearisation
from slipwise.selection.weighed_model import WeighedModel
from slipwise.short_repr import short_repr

#: Hypotheses of one kind that are fitted to the end.
_POLISHED = 2


@short_repr
@dataclass(frozen=True)
class Search:
    """What a selection has looked at; each step gives a new one.

    Attributes:
        base: the base fit.
        cannot: effects that the campaign cannot test, with the reason.
        terms: every candidate, those that change nothing here included.
        tried: every hypothesis that was refitted.
        path: base first, then with one, two ... effects up to the hypothesis at which the selection ended.
        alone: what each candidate could explain alone, best first; those that change nothing are left out.
        inclusions: effect -> what the posterior says of it.
        unexplained: relation -> share of what the final model leaves that small imperfections do not explain [1].
        final_refit: the hypothesis at which the search ended, refitted with the noise of its own law; None for the
            base.
        weighed: of which the inclusions are; None where no posterior was computed.
        linearisation: at which that posterior was computed, with the columns of all candidates; None where none was.
    """

    base: BaseFit
    cannot: Mapping[str, str]
    terms: Sequence[Term]
    tried: tuple[Hypothesis, ...]
    path: tuple[Hypothesis, ...]
    alone: Sequence[ExplainedAlone] = ()
    inclusions: Mapping[str, Inclusion] = field(default_factory=dict[str, Inclusion])
    unexplained: Mapping[str, float] = field(default_factory=dict[str, float])
    final_refit: Hypothesis | None = None
    weighed: WeighedModel | None = None
    linearisation: Linearisation | None = None

    @property
    def final(self) -> Hypothesis:
        """The hypothesis as it is reported."""
        return self.final_refit or self.best

    @property
    def best(self) -> Hypothesis:
        """The hypothesis at which the search ended."""
        return self.path[-1]


def try_one(
    state: Search, terms: Sequence[Term], starts: dict, before: Hypothesis | None = None
) -> tuple[Search, Hypothesis]:
    """Refit one hypothesis; arguments as `refit`, answer as `try_all`."""
    state, found = try_all(state, [(terms, starts)], before)
    return state, found[0]


def try_all(
    state: Search,
    asked: Sequence[tuple[Sequence[Term], dict]],
    before: Hypothesis | None = None,
) -> tuple[Search, list[Hypothesis]]:
    """Refit hypotheses of one kind, side by side; only the best of them are worth a fit to the end.

    Args:
        state: of the search.
        asked: terms and starting values of each.
        before: as of `refit`.

    Returns:
        the state that keeps them, and the hypotheses, best first.
    """
    origin, objective = state.path[0].summary, state.base.objective
    before = before and complete_jacobian(before)
    # what takes longest first, or one core waits for it
    asked = sorted(asked, key=lambda a: -sum(len(t.effect.parameters) for t in a[0]))
    # of a long campaign only what is fitted to the end has slopes: many at once would fill the memory
    keep, takes = len(asked) * size_of(state.base.solution) <= ROOM, state.base.solution.fit_memory
    fits = on_every_core(lambda i: take_fit(refit(state.base, *asked[i], before), keep=keep), len(asked), memory=takes)
    found = [Hypothesis(tuple(a[0]), objective.adding(*a[0]), *fit) for a, fit in zip(asked, fits, strict=True)]
    found.sort(key=lambda h: -compute_score(origin, h.summary))
    best: dict[tuple[str, ...], int] = {}
    for place, h in enumerate(found):
        best.setdefault(h.names, place)
    ended = list(best.values())[:_POLISHED]
    fits = on_every_core(lambda i: take_fit(polish(found[ended[i]])), len(ended), memory=takes)
    for place, fit in zip(ended, fits, strict=True):
        found[place] = Hypothesis(found[place].terms, found[place].objective, *fit)
    tried = lightened([*state.tried, *found], lambda h: compute_score(origin, h.summary))
    return replace(state, tried=tried), found


def take_fit(found: Hypothesis, *, keep: bool = True) -> tuple[Solution, ResidualSummary]:
    """Return a hypothesis without its terms, whose functions cannot be sent from one process to another."""
    return found.solution if keep else drop_jacobian(found.solution), found.summary


def left_with(state: Search, rest: Sequence[Term], whole: Hypothesis) -> tuple[Search, Hypothesis]:
    """Return the hypothesis of the rest of a whole: as it was fitted before, or from where the whole ended."""
    return tried_or_fitted(state, rest, {}, whole)


def tried_or_fitted(
    state: Search, terms: Sequence[Term], starts: dict, before: Hypothesis
) -> tuple[Search, Hypothesis]:
    """Return the hypothesis of some terms as it was fitted before, or refit it; arguments and answer as `try_one`."""
    known = tried_before(state, terms)
    return (state, known[0]) if known else try_one(state, terms, starts, before)


def tried_before(state: Search, terms: Sequence[Term]) -> list[Hypothesis]:
    """Return the hypotheses of these terms that were fitted."""
    labels = {t.label for t in terms}
    return [h for h in state.tried if {t.label for t in h.terms} == labels]
