"""Why an effect was not named: the best that it can do, and the motions, balances and instants that contradict it.

It is refitted in the place of the named effect that it is most like, and beside everything that was named, all other
numbers free. What it leaves is held against what the named model leaves, run by run and balance by balance; where it
leaves most more, the measurement contradicts it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.comparison.cells import correct_for_many_tests, gather, judge_cells
from slipwise.comparison.component_level import NAMES
from slipwise.comparison.motion_states import STATES, classify_motion_states
from slipwise.comparison.sentences import describe_places
from slipwise.diagnosis.indistinguishable import list_known_effects
from slipwise.errors import SlipwiseError, unknown_name
from slipwise.estimation.objective import Objective
from slipwise.evidence.prior import OF_MODEL
from slipwise.evidence.residual_summary import get_error
from slipwise.evidence.score import compute_lead, compute_score
from slipwise.relations.parameters import Term
from slipwise.relations.table import Block
from slipwise.selection.candidates import at_odds
from slipwise.selection.hypothesis import Hypothesis, polish, refit
from slipwise.selection.hypothesis_fit import make_fit
from slipwise.selection.initial_grid import strengths
from slipwise.selection.jacobian_memory import complete_jacobian
from slipwise.selection.search_state import Search
from slipwise.selection.units import compute_moved_by_sizes
from slipwise.short_repr import short_repr

#: Length of a stretch of time that is shown as a contradiction [time scale of the rig], and how many are.
_STRETCH, _INSTANTS = 0.25, 3
#: Less than this many floors more in a stretch contradicts nothing: noise does as much.
_CONTRADICTS = 0.5


@dataclass(frozen=True)
class Errors:
    """Error of one balance in one run [noise floors].

    Attributes:
        relation: the balance.
        run: its name.
        role: "fit", "repeat" or "holdout".
        base: of the base model.
        named: of the model with what was named.
        instead: of the model with the effect in the place of what was named.
        beside: of the model with both; NaN where they cannot be in one model.
    """

    relation: str
    run: str
    role: str
    base: float
    named: float
    instead: float
    beside: float


@short_repr
@dataclass(frozen=True)
class Instant:
    """A stretch of time that contradicts an effect.

    Attributes:
        relation: the balance.
        run: its name.
        place: of the run.
        column: number of the pad; 0 for a balance.
        pad: its name; "" for a balance.
        start: begin of the stretch [s].
        end: of the stretch [s].
        named: error of the named model there [noise floors].
        instead: of the model with the effect in its place [noise floors].
        state: what the slider does there most of the time.
        speed: rms slip speed there [m/s].
        load: mean load of a pad there [N].
    """

    relation: str
    run: str
    place: int
    column: int
    pad: str
    start: float
    end: float
    named: float
    instead: float
    state: str
    speed: float
    load: float


@short_repr
@dataclass(frozen=True)
class WhyNot:
    """Why an effect was not named.

    Attributes:
        effect: its name.
        named: what was named.
        replaced: the named effect in whose place it was fitted; "" where nothing was named.
        reason: why there is nothing to compare; else "".
        errors: of every balance in every run.
        unseen: whether `worst` is of held-out runs.
        apart: whether it cannot be in one model with what was named.
        worst: error of the worst balance of the base model, of the named one, with the effect in the place, and
            beside [noise floors].
        behind: by how many standard errors the effect is behind what was named; of none named, by how many the model
            with it leads that without it.
        gain: by how many standard errors the model with both leads the named one; NaN where that was not fitted.
        size: of the effect beside what was named, or alone where nothing was [limits of materiality]; NaN where that
            was not replayed.
        where: where the error of the model with the effect in the place lies, in words; "" where it has none.
        instants: that contradict it most.
        shown: residuals to draw: the named model, the base where none is named, and the effect in the place.
    """

    effect: str
    named: tuple[str, ...]
    replaced: str = ""
    reason: str = ""
    errors: tuple[Errors, ...] = ()
    unseen: bool = False
    apart: bool = False
    worst: Mapping[str, float] = field(default_factory=dict[str, float])
    behind: float = float("nan")
    gain: float = float("nan")
    size: float = float("nan")
    where: str = ""
    instants: tuple[Instant, ...] = ()
    shown: tuple[Hypothesis, Hypothesis] | None = None

    def as_json(self) -> dict[str, Any]:
        """Return its entry of diagnosis.json."""
        return {
            "effect": self.effect,
            "replaced": self.replaced or None,
            "reason": self.reason or None,
            "worst": {k: _number(x) for k, x in self.worst.items()},
            "behind": _number(self.behind),
            "gain": _number(self.gain),
            "size": _number(self.size),
            "where": self.where or None,
            "errors": [{k: _json(v) for k, v in asdict(e).items()} for e in self.errors],
            "instants": [
                {k: _json(v) for k, v in asdict(i).items() if k not in ("place", "column")} for i in self.instants
            ],
        }


def explain_why_not(state: Search, named: Sequence[str], effect: str) -> WhyNot:
    """Say why an effect was not named.

    All models are weighed with the noise of the base model, as they were in the search: only so they compare.

    Args:
        state: of the finished search.
        named: what the verdict names.
        effect: that is asked about.

    Raises:
        UnknownNameError: no effect that was looked at has this name.
    """
    own = [t for t in state.terms if t.effect.name == effect]
    known = list_known_effects(state)
    if effect not in known:
        raise unknown_name("effect", effect, known, "`slipwise effects` lists them.")
    if reason := _find_reason(state, named, effect, tested=bool(own)):
        return WhyNot(effect, tuple(named), reason=reason)
    reference = complete_jacobian(state.best if named else state.path[0])
    term, values = _choose_term(state, own)
    rest = [t for t in reference.terms if t.effect.name != effect]
    without = reference if len(rest) == len(reference.terms) else _fit(state, rest, {}, reference)
    replaced = _find_most_alike(state, term, [t for t in rest if t.effect.name in named])
    kept = [t for t in rest if t.effect.name != replaced and not at_odds(t, term)]
    try:
        instead = _fit_best(state, [*kept, term], {term.label: values}, without)
        together = not any(at_odds(t, term) for t in rest)
        absent = {**values, **{p.name: float(p.neutral or 0.0) for p in strengths(term.effect)}}
        beside = _fit(state, [*rest, term], {term.label: absent}, without) if replaced and together else None
    except SlipwiseError as error:
        return WhyNot(effect, tuple(named), reason=f"no fit with it can be made: {error}")
    told = beside or instead
    asked = [(term, told.values_of(term))]
    [moved] = compute_moved_by_sizes(
        make_fit(state.base, without, with_slopes=False), asked, state.base.campaign.materiality, {}
    )
    found = _compare(state, named, effect, replaced, without, instead, beside)
    return replace(found, apart=not together, size=moved.share)


def _find_reason(state: Search, named: Sequence[str], effect: str, *, tested: bool) -> str:
    """Say why there is nothing to compare; "" where there is."""
    if effect in named:
        return "it was named"
    if tested:
        return ""
    if effect in state.cannot:
        return f"this campaign cannot test it: {state.cannot[effect]}"
    return "it is part of the base model already, or does not act on a rig like this one"


def explain_rivals(state: Search, named: Sequence[str], most: int) -> list[WhyNot]:
    """Say why the best of what was refitted was not named; nothing is fitted anew.

    Args:
        state: of the finished search.
        named: what the verdict names; each rival stands in the place of one of these, or alone where nothing is named.
        most: rivals at most.
    """
    best, out = state.best if named else state.path[0], dict[str, WhyNot]()
    for h in sorted(state.tried, key=lambda h: -compute_score(best.summary, h.summary)):
        own = [n for n in h.names if n not in best.names]
        gone = [n for n in best.names if n not in h.names and n in named]
        told = len(own) == 1 and len(gone) == min(len(named), 1) and own[0] not in (*named, *out)
        if told and len(out) < most and not h.solution.residuals.is_empty:
            out[own[0]] = _compare(state, named, own[0], "".join(gone), best, h, None)
    return list(out.values())


def _compare(
    state: Search,
    named: Sequence[str],
    effect: str,
    replaced: str,
    reference: Hypothesis,
    instead: Hypothesis,
    beside: Hypothesis | None,
) -> WhyNot:
    """Hold a model with an effect in the place of another against the one that was named."""
    models = {"base": state.path[0], "named": reference, "instead": instead, "beside": beside}
    there = [r for r, counts in reference.summary.counts.items() if any(counts)]
    behind = compute_lead(reference.summary, instead.summary) if replaced else float("nan")
    both = beside if replaced else instead
    return WhyNot(
        effect=effect,
        named=tuple(named),
        replaced=replaced,
        errors=_list_errors(models),
        unseen=any(reference.summary.counts[r][1] for r in there),
        worst={k: max(get_error(h.summary, r) for r in there) for k, h in models.items() if h is not None},
        behind=behind,
        gain=float("nan") if both is None else compute_lead(both.summary, reference.summary),
        where=_find_where(instead) if replaced else "",
        instants=_find_instants(reference, instead) if replaced else (),
        shown=(reference, instead),
    )


def _fit(state: Search, terms: Sequence[Term], starts: dict, before: Hypothesis) -> Hypothesis:
    found = polish(refit(state.base, terms, starts, before)) if terms else state.path[0]
    return complete_jacobian(found)


def _fit_best(state: Search, terms: Sequence[Term], starts: dict, before: Hypothesis) -> Hypothesis:
    """Fit terms to what is best, from a model with other terms or from the base: either may be a local minimum."""
    starts = {t.label: before.values_of(t) for t in before.terms} | starts
    first, second = (polish(refit(state.base, terms, starts, start)) for start in (before, None))
    best = first if first.solution.cost < second.solution.cost else second
    return complete_jacobian(best)


def _choose_term(state: Search, own: Sequence[Term]) -> tuple[Term, dict[str, float]]:
    """Return the term of an effect that explains most alone, and its values there."""
    labels = {t.label for t in own}
    best = max((a for a in state.alone if a.term.label in labels), key=lambda a: a.gain, default=None)
    return (own[0], own[0].effect.typical()) if best is None else (best.term, dict(best.values))


def _find_most_alike(state: Search, term: Term, named: Sequence[Term]) -> str:
    """Return the name of the effect whose column is most like one of a term's; the first where no product tells."""
    if not named:
        return ""
    if state.weighed is None:
        return named[0].effect.name
    weighed = state.weighed
    whole = weighed.left_by_base.sum(axis=0)
    size = np.sqrt(np.maximum(np.diag(whole), 1e-300))
    own = [i for i, c in enumerate(weighed.columns) if c.label == term.label]
    likeness: dict[str, float] = {t.effect.name: 0.0 for t in named}
    for i, c in enumerate(weighed.columns):
        if c.form == OF_MODEL and c.effect in likeness and own:
            alike = float(np.max(np.abs(whole[i, own]) / (size[i] * size[own])))
            likeness[c.effect] = max(likeness[c.effect], alike)
    return max(likeness, key=lambda name: likeness[name])


def _list_errors(models: Mapping[str, Hypothesis | None]) -> tuple[Errors, ...]:
    reference = models["named"]
    assert reference is not None
    out: list[Errors] = []
    for block in reference.solution.residuals.blocks():
        if not block.count:
            continue
        levels = {
            k: float("nan") if h is None else h.solution.residuals.level(block.relation, [block.run])
            for k, h in models.items()
        }
        out.append(Errors(block.relation, block.name, block.role, **levels))
    return tuple(out)


def _find_where(found: Hypothesis) -> str:
    """Say where a model's error lies, in the words of a comparison; "" where all of it is at the floor."""
    objective = found.objective
    motions = [classify_motion_states(run) for run in objective.runs]
    relations = [r for r in objective.relations if r in NAMES and found.solution.residuals.count(r, objective.fitted)]
    samples = {
        r: gather(found.solution.residuals.blocks(r), objective.runs, motions, objective.specimen.pad_area)
        for r in relations
    }
    cells = correct_for_many_tests(cell for one in samples.values() for cell in judge_cells(one))
    errors = {r: float(np.sqrt(one.squared.mean())) for r, one in samples.items()}
    places = describe_places(cells, (), {}, errors)
    return places[0].words if places else ""


def _find_instants(reference: Hypothesis, instead: Hypothesis) -> tuple[Instant, ...]:
    """Return the stretches of time in which a model leaves most more than another, one a run and balance."""
    found: list[tuple[float, Instant]] = []
    objective = reference.objective
    for mine in reference.solution.residuals.blocks():
        theirs = instead.solution.residuals.block(mine.relation, mine.run)
        length = max(2, round(_STRETCH * objective.scales.time / mine.dt))
        edges = np.arange(0, len(mine.time), length)
        counts = np.add.reduceat(mine.mask.reshape(len(mine.time), -1).astype(float), edges, axis=0)
        more = np.add.reduceat(theirs.columns**2 - mine.columns**2, edges, axis=0)
        more = np.where(counts >= 0.5 * length, more / np.maximum(counts, 1.0), 0.0)
        stretch, column = np.unravel_index(int(np.argmax(more)), more.shape)
        if more[stretch, column] > _CONTRADICTS:
            inside = slice(int(edges[stretch]), int(edges[stretch]) + length)
            found.append((float(more[stretch, column]), _instant(objective, mine, theirs, inside, int(column))))
    best = sorted(found, key=lambda one: -one[0])
    return tuple(instant for _, instant in best[:_INSTANTS])


def _instant(objective: Objective, mine: Block, theirs: Block, inside: slice, column: int) -> Instant:
    run, states = objective.run(mine.run), classify_motion_states(objective.run(mine.run)).label[inside]
    wide = mine.columns.shape[1] > 1
    return Instant(
        relation=mine.relation,
        run=mine.name,
        place=mine.run,
        column=column,
        pad=run.pads[column] if wide and column < len(run.pads) else "",
        start=float(mine.time[inside][0]),
        end=float(mine.time[inside][-1]),
        named=_rms(mine.columns[inside, column]),
        instead=_rms(theirs.columns[inside, column]),
        state=STATES[int(np.bincount(states, minlength=len(STATES)).argmax())],
        speed=_rms(run.velocity[inside]),
        load=float(np.mean(run.load[inside])),
    )


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _number(value: float) -> float | None:
    return float(f"{value:.4g}") if np.isfinite(value) else None


def _json(value: Any) -> Any:
    return _number(value) if isinstance(value, float) else value
