"""From unknown to a law: on which state a missing force depends, how it enters, in which form, and how sure that is.

Everything is judged on the fitted runs; the held-out ones are looked at once, at the end, and can only take back.
Source: forward selection of one law at a time by curves over states, then forms; the shares were a trial's beginning.
"""

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign
from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.result import Diagnosis
from slipwise.discovery.candidate import CurveCandidate
from slipwise.discovery.curve_search import compute_dirt
from slipwise.discovery.law import Law
from slipwise.discovery.law_intervals import compute_law_intervals
from slipwise.discovery.law_objective import FittedLaw, LawObjective
from slipwise.discovery.law_summary import summarise_law
from slipwise.discovery.result import Discovery
from slipwise.discovery.search import (
    Found,
    Ground,
    add_missing,
    different,
    exchange_beside,
    find_law,
    fit_without_laws,
    make_ground,
    move_ground,
    take_out,
    without_law,
)
from slipwise.discovery.second_campaign import add_campaigns
from slipwise.effects import RIG_MOTION, Effect
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import Interval
from slipwise.estimation.least_squares import Solution, solve, with_slopes
from slipwise.estimation.objective import Objective
from slipwise.evidence.prior import Prior
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.model import Model
from slipwise.noise.level import is_at_floor
from slipwise.preparation.prepared import Prepared
from slipwise.residual_map.states import MEASURED, VARIED_BY, WORDS, pad_instants, pad_states, rig_states

#: Shares of the error above noise at which a law, a state, an organising state may be said [1].
LAW, STATE, ORGANISED = 0.95, 0.9, 0.5
#: A law leaves at most this many floors, on the fitted runs and on the held-out ones.
HELD_OUT = 1.25
#: What may be said, the least first.
_ORDER = ("unknown", "organised", "state", "nothing", "law")
#: Two laws tie within this much of the squared residual of the relation that they act on: so much, or the least of this
#: share of what the better one leaves above noise [1] and what makes it as many times likelier, samples counted as few
#: as in the posterior [nats].
_TIE, _TIE_OF_LEFT, _DOUBT = 60.0, 0.25, 4.0
#: A law without which no more than this share of what the start leaves comes back is needless [1].
_NEEDLESS = 1e-3
#: A further law takes this share of what the start leaves, and motions left out confirm this part of its curve [1].
_FURTHER, _CONFIRMED, _MOST_LAWS = 0.025, 0.4, 3
#: Candidates of the screen that are kept to be shown.
_SHOWN = 10
#: A law that leads, what ties with it, and the share of the error that it explains.
_Leader = tuple[FittedLaw, list[FittedLaw], float]


@dataclass(frozen=True)
class _Answer:
    """What the search has led to, by the fitted runs alone.

    Attributes:
        base: the fit without laws, with the effects of the catalogue that stand beside them.
        end: with the laws; the start where there is none.
        laws: in the order in which they were found.
        share: of the error above noise that they, or where there is none `organised`, explain [1].
        evidence: what the fitted runs alone would bear.
        organised: what explains most, whether or not it may be called a law.
        looked_at: what explains most in the first screen, best first.
        worst: relation that the laws act on.
        cannot_judge: states that could not be judged, and why.
        unexplained: share of what is left of that relation that small imperfections do not explain [1].
    """

    base: BaseFit
    end: Solution
    laws: tuple[Law, ...]
    share: float
    evidence: str
    organised: CurveCandidate | None
    looked_at: tuple[CurveCandidate, ...]
    worst: str
    cannot_judge: tuple[str, ...]
    unexplained: float


@one_thread_algebra()
def discover(
    campaign: Campaign | Path | str | Prepared,
    model: Model | Path | str | None = None,
    *,
    own: Iterable[Effect] = (),
    diagnosis: Diagnosis | None = None,
    others: Iterable[Campaign | Path | str] = (),
    progress: Callable[[str, float], None] | None = None,
) -> Discovery:
    """Find the law of what a model lacks where the catalogue ends.

    Args:
        campaign: or its folder; one that is prepared is not prepared again.
        model: the user's current model, as for `diagnose`.
        own: effects beside those of the catalogue.
        diagnosis: of the same campaign and model; made where not given.
        others: further campaigns: one law, its size in each of them; their own models begin from the paper's law.
        progress: called with what is being done and the share done.

    Raises:
        InputError: the campaign lacks what every fit needs.
    """
    tell, own = progress or (lambda words, share: None), tuple(own)
    if diagnosis is None:
        diagnosis = diagnose(campaign, model, own=own, progress=lambda words, share: tell(words, 0.5 * share))
    began = time.perf_counter()
    told = _held_against_the_others(diagnosis.campaign, _search(diagnosis, tell))
    if told.laws:
        further = [diagnose(other, own=own, progress=lambda words, _: tell(words, 0.9)) for other in others]
        told = add_campaigns(told, diagnosis, further)
    tell("done", 1.0)
    return replace(told, corrections=diagnosis.corrections, seconds=time.perf_counter() - began)


def diagnose_with_law(
    campaign: Campaign | Path | str | Prepared,
    model: Model | Path | str | None = None,
    *,
    own: Iterable[Effect] = (),
    system: bool = False,
    law: bool = True,
    progress: Callable[[str, float], None] | None = None,
) -> Diagnosis:
    """Say which effect a model lacks, and where the catalogue has none, which law its force follows.

    Args:
        campaign: or its folder; one that is prepared is not prepared again.
        model: the user's current model, or its model.toml; the paper's law on the campaign's rig when not given.
        own: effects beside those of the catalogue, as `slipwise.effects.find_effect` gives them.
        system: replay base and final model as well.
        law: look for a law where the verdict is unknown; `add_law` does it later.
        progress: called with what is being done and the share done.

    Raises:
        InputError: the campaign lacks what every fit needs.
    """
    part = 0.7 if law else 1.0
    tell = progress or (lambda words, share: None)
    found = diagnose(campaign, model, own=own, system=system, progress=lambda words, share: tell(words, part * share))
    found = add_law(found, lambda words, share: tell(words, part + (1.0 - part) * share)) if law else found
    tell("done", 1.0)
    return found


def add_law(found: Diagnosis, progress: Callable[[str, float], None] | None = None) -> Diagnosis:
    """Return a diagnosis with the law that its unknown force follows; another verdict as it is.

    Args:
        found: the diagnosis.
        progress: called with what is being done and the share done.
    """
    if found.verdict.kind != "unknown" and not found.verdict.unknown_beside:
        return found
    law = discover(found.search.base.campaign, diagnosis=found, progress=progress)
    times = {**found.stages, "looking for a law": law.seconds}
    return replace(found, law=law.proposal, seconds=found.seconds + law.seconds, stages=times)


def _search(diagnosis: Diagnosis, tell: Callable[[str, float], None]) -> _Answer:
    """Search for laws from where a diagnosis ended."""
    state, final = diagnosis.search, diagnosis.final
    base, objective, solution = final, final.objective, final.solution
    leaders: list[_Leader] = []
    candidates: tuple[CurveCandidate, ...] = ()
    ground: Ground | None = None
    if state.linearisation is not None and not _is_complete(objective, solution):
        ground = make_ground(state.base, state.linearisation, state.terms)
        for number in range(_MOST_LAWS):
            tell("looking for a law", 0.5 + 0.5 * number / _MOST_LAWS)
            found = find_law(ground, _name(number))  # a label of its own, whatever has been dropped
            candidates = candidates or found.candidates
            before = ground.solution
            leader, tied = _leader(found)
            if leader is None:
                break
            if not leaders:  # what stands beside the first law is where its share is counted from
                plain, before = without_law(ground, leader)
                objective, solution = plain, before
                base = replace(final, objective=plain, free=before.free, solution=before)
            if not _earned(leader, before, solution, first=not leaders):
                break
            leader = replace(leader, solution=with_slopes(leader.objective, leader.solution))
            leaders.append((leader, tied, _share([leader], before, leader.solution, solution)))
            whole = _above_noise(solution, leader.law.match.candidate.port.relation, leader.objective.fitted)
            leaders = _without_needless(leaders, whole)
            leaders, ground = _with_missing(leaders, ground)
            if _is_complete(objective, ground.solution):
                break
        if leaders and {t.label for t in ground.objective.plain.terms} != {t.label for t in objective.terms}:
            objective, solution = fit_without_laws(ground)
            base = replace(final, objective=objective, free=solution.free, solution=solution)
    now = leaders[-1][0].objective if leaders else LawObjective(pad_instants(objective, solution.values), objective, ())
    cannot = tuple(_cannot_judge(now))
    left = max(solution.residuals.level(r, objective.fitted) for r in objective.relations)
    organised = next((c for c in candidates[:1] if c.evidence > 0.0), None)  # else the catalogue alone is as likely
    dirt = compute_dirt(ground.system) if ground and leaders else {}

    def answer(kept: list[_Leader]) -> _Answer:
        end, known = kept[-1][0].solution if kept else solution, dict[str, Interval]()
        if kept:
            fit = replace(base, objective=kept[-1][0].objective.plain, free=end.free, solution=end)
            known = compute_law_intervals(fit, ground.system if ground and len(kept) == len(leaders) else None)
        acted = sorted({f.law.match.candidate.port.relation for f, _, _ in kept}) or objective.relations
        worst = max(acted, key=lambda r: solution.residuals.level(r, objective.fitted))
        every = [
            summarise_law(replace(f, solution=end), tied, objective.fitted, share, known) for f, tied, share in kept
        ]
        laws = tuple(replace(law, name=_name(number)) for number, law in enumerate(every))
        share = _share([f for f, _, _ in kept], solution, end, solution)
        unexplained = dirt.get(worst, 1.0) if kept else 1.0
        after = unexplained**0.5 * end.residuals.level(worst, objective.fitted)
        evidence = _evidence(laws, share, left, after)
        seen = share if laws or organised is None else organised.share
        return _Answer(base, end, laws, seen, evidence, organised, _looked_at(candidates), worst, cannot, unexplained)

    found = answer(leaders)
    if found.evidence in ("law", "state") or len(leaders) < 2:
        return found
    return answer(leaders[:1])  # what no law explains is not told by a sum of them


def _is_complete(objective: Objective, solution: Solution) -> bool:
    return all(is_at_floor(solution.residuals.level(r, objective.fitted)) for r in objective.relations)


def _with_missing(leaders: list[_Leader], ground: Ground) -> tuple[list[_Leader], Ground]:
    """Return the laws, and the ground with them, with what of the catalogue is missing beside them now."""
    last, tied, share = leaders[-1]
    ground = move_ground(ground, last.objective, last.solution)
    ground = exchange_beside(add_missing(ground) or ground)
    last = replace(last, objective=ground.objective, solution=ground.solution)
    return [*leaders[:-1], (last, tied, share)], ground


def _held_against_the_others(name: str, found: _Answer) -> Discovery:
    """Look at the held-out runs: what they do not bear is taken back."""
    base, objective = found.base, found.base.objective
    held_out = [{r: _held_out_level(objective, x, r) for r in objective.relations} for x in (base.solution, found.end)]
    errors = {r: (held_out[0][r], held_out[1][r]) for r in objective.relations}
    after = found.unexplained**0.5 * held_out[1][found.worst]
    borne = _evidence(found.laws, found.share, max(held_out[0].values()), after)
    evidence = min(found.evidence, borne, key=_ORDER.index)
    nearest = None if evidence == "nothing" else found.organised
    added = dict.fromkeys(t.effect.name for t in objective.terms)
    return Discovery(
        campaign=name,
        evidence=evidence,
        laws=found.laws,
        organised=nearest,
        looked_at=found.looked_at,
        share=found.share if found.laws or nearest else 0.0,
        relations=errors,
        worst=found.worst,
        cannot_judge=found.cannot_judge,
        base=base,
        files=(),
        seconds=0.0,
        beside=tuple(effect for effect in added if effect not in base.model),
    )


def _looked_at(candidates: Sequence[CurveCandidate]) -> tuple[CurveCandidate, ...]:
    """Return the best of each state and port, whichever gate, lag and start, best first."""
    kept: dict[tuple[tuple[str, ...], str], CurveCandidate] = {}
    for c in candidates:
        kept.setdefault((tuple(s.name for s in c.states), c.port.name), c)
    return tuple(kept.values())[:_SHOWN]


def _name(number: int) -> str:
    return "law" if number == 0 else f"law_{number + 1}"


def _evidence(laws: Sequence[Law], share: float, before: float, after: float) -> str:
    """Return what may be said.

    Args:
        laws: that were found.
        share: of the error above noise that they explain [1].
        before: largest error without them [floors].
        after: error of the relation that they act on, with them [floors].
    """
    if not laws:
        return "nothing" if is_at_floor(before) else "unknown"
    single = not any(law.tied or law.rivals for law in laws)
    if share >= LAW and after <= HELD_OUT and single:
        return "law"
    if share >= STATE and not any(law.other_states for law in laws):
        return "state"
    return "organised" if share >= ORGANISED else "unknown"


def _earned(leader: FittedLaw, before: Solution, start: Solution, *, first: bool) -> bool:
    """Return whether a law explains enough, and motions left out confirm it; a further one, a part of its gain."""
    gain = _share([leader], before, leader.solution, start)
    confirmed = leader.law.match.candidate.share
    return gain > _FURTHER and confirmed > (0.0 if first else _CONFIRMED)


def _share(laws: Sequence[FittedLaw], before: Solution, after: Solution, start: Solution) -> float:
    """Return what laws explain of the relations that they act on, as a share of what the start leaves above noise [1].

    What a laboratory's imperfections leave in the other balances is nothing that the laws could explain.
    """
    if not laws:
        return 0.0
    fitted = laws[0].objective.fitted
    acted = {f.law.match.candidate.port.relation for f in laws}
    gain = sum(before.residuals.squares(r, fitted) - after.residuals.squares(r, fitted) for r in acted)
    return gain / max(sum(_above_noise(start, r, fitted) for r in acted), 1e-9)


def _above_noise(solution: Solution, relation: str, fitted: Sequence[int]) -> float:
    return max(solution.residuals.squares(relation, fitted) - solution.residuals.count(relation, fitted), 0.0)


def _without_needless(leaders: list[_Leader], whole: float) -> list[_Leader]:
    """Leave out laws that the last one has made needless: it may be what the first one only stood for."""
    for needless in leaders[:-1]:
        last, tied, share = leaders[-1]
        label = needless[0].law.label
        laws = tuple(law for law in last.objective.laws if law.label != label)
        objective = replace(last.objective, laws=laws).without_results()
        values, free, known = take_out(last.solution, [label])
        solution = solve(objective, values, free, begin=known)
        if solution.cost <= last.solution.cost + max(_TIE, _NEEDLESS * whole):
            solution = with_slopes(objective, solution)
            kept = [one for one in leaders[:-1] if one is not needless]
            leaders = [*kept, (replace(last, objective=objective, solution=solution), tied, share + needless[2])]
    return leaders


def _leader(found: Found) -> tuple[FittedLaw | None, list[FittedLaw]]:
    """Return the law of fewest constants among those that tie, and the others of them."""
    fitted = different(found.fitted)
    if not fitted:
        return None, []
    within = fitted[0].solution.cost + _tolerance(fitted[0])
    tied = [f for f in fitted if f.solution.cost <= within]
    leader = min(tied, key=lambda f: (_constants(f), f.solution.cost))
    return leader, [f for f in tied if f is not leader]


def _tolerance(best: FittedLaw) -> float:
    """Return by how much more of the squared residual a law may leave that ties with one, see `_TIE`."""
    relation, fitted = best.law.match.candidate.port.relation, best.objective.fitted
    left = _above_noise(best.solution, relation, fitted)
    doubted = best.solution.residuals.squares(relation, fitted) * float(np.expm1(2.0 * _DOUBT / Prior().independent))
    return max(_TIE, min(_TIE_OF_LEFT * left, doubted))


def _constants(f: FittedLaw) -> int:
    match = f.law.match
    own = len(match.free) + bool(f.law.lag) + 2 * (len(match.forms) - 1) + (match.candidate.gate.name != "all")
    return own + len(match.candidate.beside)


def _cannot_judge(here: LawObjective) -> list[str]:
    """Say which states hardly vary, and where there is one motion only."""
    free = here.plain.specimen.free
    there = {s.name for s in (*pad_states(here.every), *rig_states(here.every))}
    missing = [name for name in WORDS if name not in {*there, *MEASURED} and (free or name not in RIG_MOTION)]
    out = [f"{WORDS[name]}: it does not vary in this campaign; {VARIED_BY[name]} would vary it" for name in missing]
    if len(here.fitted) < 2:
        out.append("whether a law carries over to another motion: there is one fitted run only")
    return out


def _held_out_level(objective: Objective, solution: Solution, relation: str) -> float:
    """Return the rms of a residual over the held-out runs, or the fitted ones where none is held out [noise floors]."""
    return solution.residuals.level(relation, objective.held_out or objective.fitted)
