"""The next test: which table motion would best tell the rivals of a diagnosis apart.

Each motion of a library, made smaller where the table could not make it, is shaken on the computer as each of the
rivals has it, and measured with the campaign's own channels, filter, step and noise. Then every rival is fitted to
every measurement, everything free. What a wrong one leaves, beyond what the right one leaves, is what the motion is
worth. Without the refit every motion looks good (Atkinson and Fedorov 1975; Hunter and Reiner 1965).

Nobody knows which of two rivals is right, so both ways count, by their mean (Box and Hill 1967). The smaller of them
would be nothing wherever one rival contains the other, as every effect contains the base model: what the base makes,
the effect explains at no size. Of three rivals the two that are hardest to tell apart count.

The specimen is taken as new: what pads and buffers remember of the campaign's runs is not carried on.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import combinations, product
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from slipwise.campaign import Campaign, Run
from slipwise.comparison.measured_replay import choose_simulation_step
from slipwise.comparison.system_level import build_replayed_model
from slipwise.design.law_contest import Contest, law_contest
from slipwise.design.motions import LIBRARY, Limits, motions_for
from slipwise.design.result import NextTest, Proposal
from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.indistinguishable import list_alike_pairs, list_known_effects
from slipwise.diagnosis.result import Diagnosis
from slipwise.effects import Effect
from slipwise.errors import InputError, SimulationError, SlipwiseError
from slipwise.estimation.base_fit import fit_base
from slipwise.evidence.acceptance import LEAST
from slipwise.evidence.calibration import load_calibration
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.evidence.score import compute_score, find_largest_drop
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.model import Model
from slipwise.motion import parse_motion
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import Prepared
from slipwise.record import Record
from slipwise.relations.parameters import Term
from slipwise.selection.hypothesis import Hypothesis, make_base_hypothesis, polish, refit
from slipwise.selection.search_state import Search
from slipwise.signals.filters import lowpass
from slipwise.simulation.replay import replay

#: Who is so near to the surest that a verdict can be needs no further motion [1].
_NEARLY = 0.01
#: Rivals that are held against each other: three cost nine fits a motion.
_MOST = 3


@one_thread_algebra()
def next_test(
    found: Diagnosis | Campaign | Path | str | Prepared,
    limits: Limits | None = None,
    library: Sequence[str] = LIBRARY,
    progress: Callable[[str, float], None] | None = None,
    *,
    model: Model | Path | str | None = None,
    own: Iterable[Effect] = (),
) -> NextTest:
    """Rank table motions by how well they would tell the rivals of a diagnosis apart.

    Args:
        found: the diagnosis; or a campaign or its folder, which is diagnosed first.
        limits: of the table.
        library: motions as `slipwise motions` describes them.
        model: where that diagnosis starts, see `diagnose`.
        own: effects beside those of the catalogue, for that diagnosis.
        progress: called with what is being done and the share done.

    Raises:
        InputError: the rig's slip is prescribed, or no effect can be held against the best hypothesis.
        SimulationError: no motion could be judged.
        SlipwiseError: a motion of the library cannot be read.
    """
    tell = progress or (lambda words, share: None)
    if not isinstance(found, Diagnosis):
        prepared, half = prepare(found), tell
        _refuse_prescribed(prepared.recorded)
        found = diagnose(prepared, model, own=own, progress=lambda words, share: half(words, 0.5 * share))
        tell = lambda words, share: half(words, 0.5 + 0.5 * share)  # noqa: E731
    _refuse_prescribed(found.final.campaign)
    asked = motions_for(library, limits or Limits())
    tell("rivals", 0.0)
    with TemporaryDirectory() as folder:  # the effects of laws are compiled from their files
        every = law_contest(found, Path(folder), _MOST) if found.verdict.kind == "unknown" else None
        if every is None:
            effects = rivals(found)
            every = Contest(effects, _chances(found, effects))
        return _ranked(found, every, asked, tell)


def _ranked(found: Diagnosis, every: Contest, asked: Mapping[str, str], tell: Callable[[str, float], None]) -> NextTest:
    """Rank motions, each with why the table cannot make it, by how well they tell a contest's hypotheses apart."""
    contest, chances = every.hypotheses[:_MOST], every.chances[:_MOST]
    if chances[0] >= _compute_surest() - _NEARLY:
        words = "Nothing is in doubt: no motion could make anybody surer of this than the campaign does."
        return NextTest(tuple(h.names for h in contest), chances, (), words, found.sentence, found.corrections)
    models = [_as_shaken(found, h) for h in contest]
    out = []
    for i, (text, refused) in enumerate(asked.items()):
        tell(text[:32], i / len(asked))
        separation, relation, failed = (0.0, "", "") if refused else _separation(found, contest, models, text)
        out.append(Proposal(text, separation, relation, _later(chances, separation), refused, failed))
    judged = [p for p in out if not p.refused]
    if judged and all(p.failed for p in judged):
        raise SimulationError(
            f"none of {len(judged)} motions could be judged; {judged[0].motion}: {judged[0].failed}. The rig is shaken "
            "with the values that were fitted: `slipwise diagnose` shows them, [specimen] of campaign.toml sets others"
        )
    ranked = sorted(out, key=lambda p: (bool(p.refused), bool(p.failed), -p.separation))
    most = max((p.separation for p in judged), default=np.inf)
    names = tuple(h.names for h in contest)
    test = NextTest(names, chances, tuple(ranked), "", found.sentence, found.corrections)
    doubt = "" if test.gain > 0.0 else "No motion could make anybody surer than the campaign does."
    return replace(test, words=" ".join(filter(None, (doubt, every.words, _words(found, contest, most)))))


def _refuse_prescribed(campaign: Campaign) -> None:
    """Refuse one slider on an actuator: a simulation knows neither its load nor what the actuator can do.

    Raises:
        InputError: it is one.
    """
    if not campaign.specimen.free:
        raise InputError(
            f"{campaign.name}: the slip of rig {campaign.rig!r} is prescribed, so there is no table motion to choose. "
            "`slipwise diagnose` names the rivals, `slipwise effects NAME` the test that tells an effect from others"
        )


def rivals(found: Diagnosis) -> tuple[Hypothesis, ...]:
    """Return what is left to be told apart, the best first.

    Of an ambiguous verdict all its rivals; beside a base model that lacks nothing the effect that came nearest to being
    named; else the strongest hypothesis of other effects.

    Raises:
        InputError: no effect can be held against the best hypothesis.
    """
    state, verdict = found.search, found.verdict
    base, best = state.path[0], state.best
    if verdict.kind == "complete" or (not best.terms and verdict.leftover == "none"):
        return base, _strongest(state, ())
    if verdict.kind == "ambiguous":
        near = sorted(verdict.rivals, key=lambda h: compute_score(base.summary, h.summary))
        unlike = {frozenset(h.names): h for h in (*near, best)}  # the same effects in another order are no rival
        others = [h for h in reversed(unlike.values()) if h is not best] or _partner(state)
        if others:
            return best, *others
    first = best if best.terms else _strongest(state, ())
    return first, _strongest(state, first.names)


def _strongest(state: Search, beside: Sequence[str]) -> Hypothesis:
    """Return the strongest hypothesis of other effects, and no more of them; where none was fitted, fit one."""
    base, named = state.path[0], set(beside)
    tried = [h for h in state.tried if len(h.terms) <= max(len(named), 1) and not set(h.names) <= named]
    if tried:
        return max(tried, key=lambda h: compute_score(base.summary, h.summary))
    fresh = [s.term for s in state.alone if s.term.effect.name not in named]
    if not fresh:
        raise InputError(
            "there is nothing to tell apart: this campaign can test no effect of the catalogue against "
            f"{' + '.join(beside) or 'the base model'}; `slipwise diagnose` says what each effect lacks"
        )
    return _fitted(state, fresh[0])


def _partner(state: Search) -> list[Hypothesis]:
    """Return the effect that is one thing with the best to this rig, fitted if it was not yet."""
    named = set(state.best.names)
    names = {
        name for pair in list_alike_pairs(list_known_effects(state).values()) if pair & named for name in pair - named
    }
    known = [h for h in state.tried if h.terms and set(h.names) <= names]
    return known[:1] or [_fitted(state, term) for term in state.terms if term.effect.name in names]


def _fitted(state: Search, term: Term) -> Hypothesis:
    start = next((s.values for s in state.alone if s.term.label == term.label), term.effect.typical())
    return polish(refit(state.base, [term], {term.label: start}))


def _chances(found: Diagnosis, contest: Sequence[Hypothesis]) -> tuple[float, ...]:
    """Return each one's today: rivals of an ambiguous verdict share its probability, others have what it gave them."""
    sure = found.verdict.probability
    if found.verdict.kind == "ambiguous":
        return (sure / len(contest),) * len(contest)
    listed = {c.effect: c.probability for c in found.candidates}
    labels = [" + ".join(t.label for t in h.terms) for h in contest]
    rest = 0.0 if listed else 1.0 - sure
    return tuple(listed.get(label, rest) if label else sure for label in labels)


def _compute_surest() -> float:
    """Return the largest probability of a verdict: what all of them are wrong by, whatever was measured, is in it."""
    return load_calibration().whole(1.0, 0.0)


def _later(chances: Sequence[float], separation: float) -> float:
    """Return the chance of the first hypothesis after a motion, if it is right; that none is right stays as likely."""
    # A material difference leaves a third of the others' odds, twice that a ninth.
    together, odds = sum(chances), sum(chances[1:]) * float(np.exp(-separation / LEAST.everywhere))
    return max(chances[0], min(_compute_surest(), together * chances[0] / max(chances[0] + odds, 1e-12)))


def _as_shaken(found: Diagnosis, right: Hypothesis) -> Model:
    """Return the model of a hypothesis with the pads' springs and the inertia that a replay needs."""
    base = found.search.base
    return build_replayed_model(
        replace(base, objective=right.objective, free=right.solution.free, solution=right.solution)
    )[0]


def _separation(
    found: Diagnosis, contest: Sequence[Hypothesis], models: Sequence[Model], text: str
) -> tuple[float, str, str]:
    """Return how far a motion separates the two rivals that are hardest to tell apart, where, and why not if not."""
    try:
        left = [_refitted(_measured(found, right, text), found.search.base.model, contest) for right in models]
    except SlipwiseError as error:
        return 0.0, "", " ".join(str(error).partition(". ")[0].split())
    pairs = []
    for a, b in combinations(range(len(contest)), 2):
        ways = [(left[right][right], left[right][wrong]) for right, wrong in ((a, b), (b, a))]
        more = {r: sum(max(_level(w, r) - _level(own, r), 0.0) for own, w in ways) / 2.0 for r in ways[0][0].fitted}
        where = max(more, key=lambda r: more[r])
        pairs.append((more[where], where))
    return *min(pairs), ""


def _level(account: ResidualSummary, relation: str) -> float:
    return account.fitted_level(relation)


def _refitted(campaign: Campaign, model: Model, contest: Sequence[Hypothesis]) -> list[ResidualSummary]:
    """Fit every rival to a campaign, each from where it was; what they leave is weighed alike."""
    base = fit_base(campaign, model)
    out = []
    for h in contest:
        if h.terms:
            known = replace(h, solution=replace(h.solution, values={**base.solution.values, **h.solution.values}))
            out.append(polish(refit(base, h.terms, {}, known)).summary)
        else:
            out.append(make_base_hypothesis(base).summary)
    return out


def _measured(found: Diagnosis, model: Model, text: str) -> Campaign:
    """Shake a model on the computer and measure it as the campaign was measured: channels, filter, step, noise."""
    campaign = found.final.campaign
    pattern = found.search.base.objective.run(0)
    rng = np.random.default_rng(1)
    dt = choose_simulation_step(pattern.dt, model.built_specimen())
    every = round(pattern.dt / dt)
    record = replay(model, parse_motion(text), dt=dt, output_dt=dt).record
    channels = {}
    for name in pattern.record.channels:
        if name not in record:
            continue
        kept = campaign.logger.of(name)
        # a logger's filter acts before it samples
        values = (lowpass(record[name], dt, kept) if kept is not None else record[name])[::every]
        channels[name] = values + pattern.noise.get(name, 0.0) * rng.standard_normal(len(values))
    run = Run("next", "fit", Record(record.time[::every], channels), None, None, text, "")
    return replace(campaign, runs=(run,))


def _words(found: Diagnosis, contest: Sequence[Hypothesis], most: float) -> str:
    """Say what else tells the rivals apart: the campaign itself, or a gauge where no motion separates them by more."""
    sentences = []
    if found.verdict.kind == "ambiguous" and not found.verdict.rivals:
        # effects that the verdict takes for one thing to the rig are one only if the rig is not known well
        more, where = find_largest_drop(contest[1].summary, contest[0].summary)
        if more >= LEAST.everywhere:
            sentences.append(
                f"Refitted to the campaign, {' + '.join(contest[0].names)} leaves {100.0 * more:.0f} % less of the "
                f"mean squared residual in {where} than {' + '.join(contest[1].names)}: if the rig is as rated, these "
                "runs tell them apart."
            )
    if most < LEAST.everywhere:
        rivals = " and ".join(" + ".join(h.names) or "the base model" for h in contest)
        sentences.append(
            f"No table motion of these tells {rivals} apart: {most:.2g} noise variances at most, "
            f"{LEAST.everywhere:g} is needed."
        )
        for one, other in combinations(contest, 2):
            pairs = product((t.effect for t in one.terms), (t.effect for t in other.terms))
            sentences += [f"{b.name} instead of {a.name}: {t}." for a, b in pairs if (t := a.confused_with.get(b.name))]
    return " ".join(dict.fromkeys(sentences))
