"""Hypotheses of one small campaign whose residuals are chosen: what is judged is real, but nothing has to be fitted."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from slipwise.campaign import Campaign, Logger, Run
from slipwise.campaign.materiality import Materiality
from slipwise.diagnosis.findings import EffectFinding, _left_where_it_shows, _rivals, compute_excess_over_noise
from slipwise.diagnosis.result import Candidate, Diagnosis
from slipwise.diagnosis.verdict import Verdict, decide_verdict, is_confirmed
from slipwise.effects import catalogue
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.least_squares import Solution
from slipwise.estimation.objective import Objective, make_objective
from slipwise.evidence.residual_summary import get_error, summarise_residuals
from slipwise.evidence.score import compute_lead, compute_score
from slipwise.model import base_model
from slipwise.record import Record
from slipwise.relations.parameters import Free, Term, list_base_numbers, make_terms
from slipwise.relations.run_data import FitRun, fit_runs
from slipwise.relations.setting import Weighing
from slipwise.relations.table import Block, Residuals
from slipwise.selection.hypothesis import Hypothesis, is_at_limit, list_parameters_at_bound, make_base_hypothesis
from slipwise.selection.hypothesis_fit import make_fit
from slipwise.selection.importance import Change, Importance
from slipwise.selection.inclusion import MATTERS, Inclusion
from slipwise.selection.search_state import Search, tried_before
from slipwise.signals.filters import LowPass

Array = NDArray[np.float64]
DT, SECONDS, REST = 0.002, 6.0, 1.0
NOISE = {"slip_x": 2e-5, "table_ax": 0.01, "table_az": 0.01, "girder_ax": 0.01, "girder_az": 0.01, "yaw": 1e-5}
FORCE_NOISE = 20.0
#: How many times what matters an effect changes, where nothing is said: well beyond doubt.
MATERIAL = 5.0
#: Floors that the posterior sees of an effect, and the share of its size by which it may be off.
SHOWS, KNOWN = 2.0, 0.05


def shaken(frequency: float, seed: int, gauges: tuple[str, ...] = ()) -> Record:
    """Give the usual channels of bridge 1 after a rest: slip is a sine, forces and accelerations follow from it."""
    rng, specimen = np.random.default_rng(seed), base_model("bridge1").specimen
    time = np.arange(round(SECONDS / DT)) * DT
    turn, moving = 2.0 * np.pi * frequency, np.clip(time - REST, 0.0, None)
    slip, velocity = 0.01 * (1.0 - np.cos(turn * moving)), 0.01 * turn * np.sin(turn * moving)
    acceleration = 0.01 * turn**2 * np.cos(turn * moving) * (time > REST)
    vertical = 1.5 * np.sin(2.0 * np.pi * 3.1 * moving)
    loads = np.tile((specimen.weight + specimen.mass * vertical)[:, None] / 4.0, 4)
    forces = 0.11 * loads * np.tanh(velocity / 5e-3)[:, None]
    girder = -(forces.sum(axis=1) + sum(specimen.buffer_stiffness) * slip) / specimen.mass
    channels = {"slip_x": slip, "table_ax": girder - acceleration, "table_az": vertical}
    channels |= {"girder_ax": girder, "girder_az": vertical}
    channels |= {"yaw": 1e-4 * slip} if "yaw" in gauges else {}
    channels |= {f"pad_{p}_N": loads[:, i] for i, p in enumerate("ABCD")}
    channels |= {f"pad_{p}_Fx": forces[:, i] for i, p in enumerate("ABCD")}
    return Record(time, {k: v + rng.normal(0.0, NOISE.get(k, FORCE_NOISE), len(time)) for k, v in channels.items()})


@cache
def measured(*gauges: str, held_out: bool = True) -> Campaign:
    """Give a campaign of a fitted run and another, behind a logger of 100 Hz.

    Args:
        gauges: beside the usual ones: "yaw".
        held_out: whether the other run is kept from every fit.
    """
    roles = ("fit", "holdout" if held_out else "fit")
    shakes = zip(roles, (1.5, 2.0), strict=True)
    runs = tuple(
        Run(f"sine_{role}_{f:g}", role, shaken(f, i, gauges), 1800.0, None, f"{f:g}.csv", f"{i}")
        for i, (role, f) in enumerate(shakes)
    )
    specimen = base_model("bridge1").specimen
    return Campaign("made", "bridge1", specimen, Logger(LowPass(100.0), known=True), runs, Path())


@cache
def _objective(*gauges: str, held_out: bool) -> Objective:
    model = base_model("bridge1")
    objective = make_objective(fit_runs(measured(*gauges, held_out=held_out)), model.specimen, make_terms(model))
    sigmas = {
        name: tuple(np.full((1,) * run.judged[name].ndim, FORCE_NOISE) for run in objective.runs)
        for name in objective.relations
    }
    return replace(objective, weighing=Weighing(sigmas))


def table_of(parts: Mapping[str, Sequence[Array]], forces: Sequence[Array] = (), dt: float = 0.01) -> Residuals:
    """Give a table of these residuals, relation -> per run, every sample of which is judged."""

    def block(name: str, place: int, value: Array) -> Block:
        everywhere = np.ones(value.shape, dtype=bool)
        time = np.arange(len(value)) * dt
        return Block(name, place, f"run_{place}", place, "fit", time, dt, value, np.ones(()), everywhere)

    return Residuals(tuple(block(n, i, one) for n, of in parts.items() for i, one in enumerate(of)), tuple(forces))


@cache
def base(*gauges: str, held_out: bool = True, **left: float) -> BaseFit:
    """Give a base fit of that campaign that leaves so much in each relation, and noise where nothing is said.

    Args:
        gauges: as in `measured`.
        held_out: as in `measured`.
        left: relation -> mean squared residual [noise variance].
    """
    campaign, model, objective = (
        measured(*gauges, held_out=held_out),
        base_model("bridge1"),
        _objective(*gauges, held_out=held_out),
    )
    free = tuple(list_base_numbers(model, balances=objective.balanced))
    return BaseFit(campaign, model, objective, free, _solution(objective, {f.key: f.start for f in free}, free, left))


def on(name: str, group: str) -> Term:
    """Give a fault on one channel, or on a group of the pads' channels: "pad_*_N"."""
    return Term(catalogue()[name], tuple(group.replace("*", p) for p in "ABCD") if "*" in group else (group,), group)


def left_by(
    *terms: Term | str,
    of: BaseFit,
    held_out: Mapping[str, float] | None = None,
    values: Mapping[str, float] | None = None,
    over: Callable[[FitRun], Array] | None = None,
    **left: float,
) -> Hypothesis:
    """Give the hypothesis of these effects that leaves so much in each relation, and noise where nothing is said.

    Args:
        terms: effects, by name or with their channels.
        of: the base fit.
        held_out: relation -> mean squared residual on held-out runs, where that is something else.
        values: key -> value where its parameters or the rig's are not typical.
        over: state of a run (n,) on which depends what the pads have above noise; no state predicts it if not given.
        left: relation -> mean squared residual [noise variance].
    """
    every = tuple(t if isinstance(t, Term) else Term(catalogue()[t]) for t in terms)
    objective = of.objective.adding(*every)
    new = [f for t in every for f in t.free(t.effect.typical())]
    start = {**of.solution.values, **{f.key: _inside(f) for f in new}, **(values or {})}
    solution = _solution(objective, start, (*of.free, *new), left, held_out or {}, over)
    return Hypothesis(every, objective, solution, summarise_residuals(objective, solution))


def _inside(free: Free) -> float:
    """Give where a number begins, but not on a bound: a law that has run against one is weighed as such."""
    margin = 0.05 * (free.high - free.low)
    return (
        free.start
        if free.low < free.start < free.high
        else float(np.clip(free.start, free.low + margin, free.high - margin))
    )


def searched(of: BaseFit, *tried: Hypothesis) -> Search:
    """Give a search from this base fit that ended at the first of what it tried."""
    terms = {t.label: t for h in tried for t in h.terms}
    return Search(of, {}, list(terms.values()), tuple(tried), (make_base_hypothesis(of), *tried[:1]))


def changing(share: float, *, gauge: bool = False, limits: Materiality | None = None) -> Importance:
    """Give the importance of an effect whose largest change is so many times what matters.

    Args:
        share: largest change over its limit [1].
        gauge: whether it is a fault of gauges, which changes its channel only.
        limits: what matters.
    """
    limits = limits or Materiality()
    size = share * (limits.gauge if gauge else limits.channel)
    half = 0.0 if gauge else 0.5 * share * limits.response
    responses = {"peak_slip": Change(half, 0.8 * half, 1.2 * half), "energy": Change(-half, -half, 0.0)}
    return Importance(responses, {"pad_A_Fx": size, "slip_x": 0.1 * size}, gauge)


def findings_of(
    state: Search, material: Mapping[str, float] | None = None, limits: Materiality | None = None
) -> list[EffectFinding]:
    """Give the evidence for every effect of a search's final model: residuals are chosen, so nothing is replayed.

    What is left without an effect is what the rest was given to leave, or the base where the rest was not tried.

    Args:
        state: of the search.
        material: effect -> its largest change over what matters; `MATERIAL` where nothing is said.
        limits: what matters.
    """
    final, origin = state.final, state.path[0].summary
    parts = {name: tuple(t for t in final.terms if t.effect.name == name) for name in final.names}
    rivals, bounds = _rivals(state, parts), list_parameters_at_bound(final)
    end = compute_excess_over_noise(final.summary, final.summary)
    base_over = max(compute_excess_over_noise(origin, final.summary) - end, 1e-12)
    out = []
    for name, terms in parts.items():
        rest = tried_before(state, [t for t in final.terms if t.effect.name != name])
        left = (rest or [state.path[0]])[0].summary
        gauge = terms[0].effect.port == "gauge"
        importance = changing((material or {}).get(name, MATERIAL), gauge=gauge, limits=limits)
        out.append(
            EffectFinding(
                name=name,
                terms=terms,
                worth=compute_score(left, final.summary),
                lead=min(compute_lead(final.summary, left), 30.0),
                share=float(np.clip((compute_excess_over_noise(left, final.summary) - end) / base_over, 0.0, 1.0)),
                rival=rivals.get(name),
                at_bound=tuple(p for label, p in bounds if label in {t.label for t in terms}),
                at_limit=any(t.label in is_at_limit(final) for t in terms),
                importance=importance,
                material=(size := importance.share_of_limit(limits or Materiality())),
                stays=1.0,
                inclusion=Inclusion(float(norm.cdf((1.0 - MATTERS / size) / KNOWN)), 1.0, size, KNOWN, SHOWS, 0.0, 1.0),
                beside=_left_where_it_shows(left, final.summary),
            )
        )
    return sorted(out, key=lambda f: -f.material)


def decided(state: Search, material: Mapping[str, float] | None = None, limits: Materiality | None = None) -> Verdict:
    """Give the verdict of a search; arguments as of `findings_of`."""
    limits = limits or Materiality()
    return decide_verdict(state, findings_of(state, material, limits), limits)


def diagnosed(
    state: Search,
    verdict: Verdict | None = None,
    probabilities: Sequence[float] = (),
    material: Mapping[str, float] | None = None,
) -> Diagnosis:
    """Give the diagnosis of a search.

    Args:
        state: of the search.
        verdict: where it is another than the search's own.
        probabilities: of the hypotheses that were tried; those that have none are not listed.
        material: as in `decided`, for the search's own verdict.
    """
    verdict = verdict or decided(state, material)
    shown = state.final if verdict.effects else state.path[0]
    errors = {r: tuple(get_error(h.summary, r) for h in (state.path[0], shown)) for r in shown.summary.fitted}
    listed = tuple(
        Candidate(" + ".join(t.label for t in h.terms), chance, *errors["pads"], 0.0, {})
        for h, chance in zip(state.tried, probabilities, strict=False)
    )
    before, after = (max(each) for each in zip(*errors.values(), strict=True))
    return Diagnosis(
        campaign=state.base.campaign.name,
        verdict=verdict,
        component="pad friction",
        recorded_error=before,
        base_error=before,
        final_error=after,
        relations=errors,
        all_samples={},
        system={},
        candidates=listed,
        confirmed=is_confirmed(state) if verdict.effects else None,
        predicted_friction=(),
        least={},
        cannot_tell=(),
        corrections=(),
        search=state,
        final=make_fit(state.base, shown, with_slopes=False),
        seconds=1.0,
        stages={},
    )


def _solution(
    objective: Objective,
    values: dict[str, float],
    free: tuple[Free, ...],
    left: Mapping[str, float],
    held_out: Mapping[str, float] | None = None,
    over: Callable[[FitRun], Array] | None = None,
) -> Solution:
    parts: dict[str, list[Array]] = {}
    for name in objective.relations:
        levels = [left.get(name, 1.0)] * len(objective.runs)
        for place in objective.held_out:
            levels[place] = (held_out or {}).get(name, levels[place])
        by = over if name == "pads" else None
        parts[name] = [_residual(run, name, i, levels[i], by) for i, run in enumerate(objective.runs)]
    residuals = objective.layout.filled(parts, [0.9 * run.force for run in objective.runs])
    stacked = residuals.stacked(objective.fitted)
    return Solution(values, free, residuals, np.zeros((len(stacked), len(free))), float(stacked @ stacked), 1)


def _residual(run: FitRun, name: str, place: int, level: float, over: Callable[[FitRun], Array] | None) -> Array:
    """Give a residual of this mean square over what is judged: noise, and on top of it a step over a state."""
    kept = run.judged[name]
    noise = np.random.default_rng([place, len(name)]).normal(size=kept.shape)
    if over is not None and level > 1.0:
        step = np.sign(over(run) - np.median(over(run)))
        noise = noise + np.sqrt(level - 1.0) * (step[:, None] if kept.ndim == 2 else step)
    return np.where(kept, noise * np.sqrt(level / np.mean(noise[kept] ** 2)), 0.0)
