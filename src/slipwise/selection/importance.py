"""What an effect changes that an engineer asks for: slip, energy, load and every measured channel without it.

The final model is replayed from the measured table motion, once as it is and once with the effect left out, everything
else as fitted: in the held-out run (in the last one where none is held out) for slip, energy and load, and for the
channels also in the run in which the effect does most, for wear may be over when the held-out run begins. A slider is
not replayed: its motion is prescribed, and its law is driven by what was measured.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.materiality import Materiality
from slipwise.campaign.rig_motion import rig_motion
from slipwise.comparison.measured_replay import choose_simulation_step, get_measured_motion
from slipwise.comparison.system_level import build_replayed_model
from slipwise.effects import Effect
from slipwise.errors import SlipwiseError
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import Interval
from slipwise.estimation.objective import Objective
from slipwise.jobs.parallel import on_every_core
from slipwise.model import Model
from slipwise.motion.resample import resample
from slipwise.relations.force_offset import compute_largest_zero
from slipwise.relations.parameters import ZERO, Term
from slipwise.relations.run_data import FitRun
from slipwise.rig.build import largest_step
from slipwise.short_repr import short_repr
from slipwise.simulation.kernel.layout import buffer_memories, pad_memories
from slipwise.simulation.predict import predictor
from slipwise.simulation.result import Memory, Replay, SimulationDiverged
from slipwise.simulation.simulator import simulate
from slipwise.simulation.step_check import warn_of_coarse_step

RESPONSES: tuple[str, ...] = ("peak_slip", "energy", "largest_load")
#: Half width of an interval beside what the size's own interval gives: of the change itself, for a law is not quite the
#: true one, and absolute, for a replay is not the rig [1].
_OF_CHANGE, _ABSOLUTE = 0.25, 0.004


@dataclass(frozen=True)
class Change:
    """A relative change with its 95 % interval [1]."""

    value: float
    low: float
    high: float


@short_repr
@dataclass(frozen=True)
class Importance:
    """What leaving an effect out changes.

    Attributes:
        responses: name of `RESPONSES` -> relative change of the replay without the effect; empty for a slider.
        channels: channel -> rms of the change over the channel's rms about its mean [1].
        gauge: whether the effect is a fault of gauges.
    """

    responses: Mapping[str, Change]
    channels: Mapping[str, float]
    gauge: bool

    def share_of_limit(self, limits: Materiality) -> float:
        """Return the largest change as a share of what matters: 1 and more is material."""
        of_channel = limits.gauge if self.gauge else limits.channel
        shares = [value / of_channel for value in self.channels.values()]
        if not self.gauge:
            shares += [abs(change.value) / limits.response for change in self.responses.values()]
        return max(shares, default=0.0)


def compute_importance(final: BaseFit, terms: Sequence[Term], sizes: Sequence[Interval]) -> dict[str, Importance]:
    """Return the importance of every effect that was added to a model.

    Args:
        final: the fitted model.
        terms: that were added; those of one effect are left out together.
        sizes: its fitted numbers with their intervals.
    """
    if not terms:
        return {}
    added: dict[str, list[Term]] = {}
    for term in terms:
        added.setdefault(term.effect.name, []).append(term)
    objective = final.objective
    shown = choose_shown(final)
    places = {name: list(dict.fromkeys([shown, _where_most(final, of)])) for name, of in added.items()}
    asked = [("", place) for place in dict.fromkeys(p for of in places.values() for p in of)]
    asked += [(name, place) for name, of in places.items() for place in of]
    models = _models(final, added)
    free = is_replayable(models[""], final, shown)

    def answer(k: int) -> Answer:
        name, place = asked[k]
        return compute_answer(models[name], final, place, replayed=free, partly=True)

    replies = on_every_core(answer, len(asked))
    answers = dict(zip(asked, replies, strict=True))
    out: dict[str, Importance] = {}
    for name, of in added.items():
        spread = _spread([t.label for t in of], sizes)
        whole, without = answers["", shown].responses, answers[name, shown].responses
        responses = {r: _change(without[r] / size - 1.0, spread) for r, size in whole.items() if size > 0.0}
        channels: dict[str, float] = {}
        zero = _usual_zero(objective, of[0].effect)
        for place in places[name]:
            one, other = answers["", place].channels, answers[name, place].channels
            measured = objective.run(place).record
            for c in (c for c in one if c in measured):
                change = other[c] - one[c]
                within = c.endswith("_Fx") and np.abs(change).max() < zero
                share = 0.0 if within else compute_share_of_channel(change, measured[c])
                channels[c] = max(channels.get(c, 0.0), share)
        out[name] = Importance(responses, channels, of[0].effect.port == "gauge")
    return out


def _usual_zero(objective: Objective, effect: Effect) -> float:
    """Return by how much an effect may shift a slider's friction gauge and be its zero all the same [N]."""
    shifts = effect.port == "gauge" and ZERO in effect.stands_for and not objective.specimen.free
    return compute_largest_zero(objective.fitted_runs) if shifts else 0.0


@dataclass(frozen=True)
class Answer:
    """What a model answers in one run.

    Attributes:
        responses: name of `RESPONSES` -> its value [SI].
        channels: channel -> what a gauge would show (n,) [SI].
        replayed: whether the run was replayed; else its pads were driven. What is held against it is answered alike.
    """

    responses: Mapping[str, float]
    channels: Mapping[str, Array]
    replayed: bool


def choose_shown(final: BaseFit) -> int:
    """Return the place of the run whose answer tells what matters: the first held-out one in which anything is judged.

    It is the last one that is fitted where no held-out run is: the gauges may be dead in all of them.
    """
    objective, left = final.objective, final.solution.residuals
    judged = [i for i in objective.held_out if any(left.count(relation, [i]) for relation in objective.relations)]
    return [*judged, *objective.fitted[-1:]][0]


def build_answering_model(final: BaseFit) -> Model:
    """Return the fitted model as `compute_answer` needs it: a slider's is only driven."""
    objective = final.objective
    return build_replayed_model(final)[0] if objective.specimen.free else objective.model(final.solution.values)


def is_replayable(model: Model, final: BaseFit, place: int) -> bool:
    """Return whether a run can be replayed: of a slider, and without the table's motion, it can only be driven.

    So it is where a fit, which knows no such bound, has left the inertias of no rigid body: no rig is built of them.

    Args:
        model: of `build_answering_model`.
        final: the fit.
        place: of the run.
    """
    objective = final.objective
    if not objective.specimen.free or "table_ax" not in objective.run(place).record:
        return False
    inertia = model.built_specimen().inertia
    return 2.0 * max(inertia) <= sum(inertia)


def compute_answer(
    model: Model, final: BaseFit, place: int, *, replayed: bool, rough: bool = False, partly: bool = False
) -> Answer:
    """Return what a model answers in a run: replayed, or its pads driven with the measured load and motion.

    Args:
        model: the fitted model, or a change of it.
        final: the fit.
        place: of the run.
        replayed: of a slider, and without the table's motion, a law can only be driven.
        rough: take twice the usual step where the pads allow it, which changes shares by some hundredths.
        partly: take a replay that leaves every bound as far as it went, and its last sample from there on.

    Raises:
        SimulationDiverged: a replay left every bound, and `partly` was not asked for.
    """
    return _replayed(model, final, place, rough=rough, partly=partly) if replayed else _driven(model, final, place)


def _models(final: BaseFit, added: Mapping[str, Sequence[Term]]) -> dict[str, Model]:
    """Return the final model by "", and by the name of each effect the model without it."""
    values, whole = final.solution.values, build_answering_model(final)
    return {"": whole} | {n: whole.without(*(u.label for t in of for u in t.uses(values))) for n, of in added.items()}


def _where_most(final: BaseFit, terms: Sequence[Term]) -> int:
    """Return the place of the run whose balances change most when an effect is set to its absence."""
    objective, solution = final.objective, final.solution
    absent = {f"{t.label}.{p.name}": p.neutral for t in terms for p in t.effect.parameters if p.neutral is not None}
    try:
        there = objective.residuals({**solution.values, **absent})
    except SlipwiseError:
        return objective.fitted[-1]
    return int(np.argmax(np.nan_to_num(solution.residuals.changes_by_run(there))))


def _replayed(model: Model, final: BaseFit, place: int, *, rough: bool, partly: bool) -> Answer:
    """Replay a run's measured table motion, memory of pads and buffers from the runs before."""
    run = final.objective.run(place)
    specimen, motion = model.built_specimen(), get_measured_motion(run.states)
    dt = choose_simulation_step(run.dt, specimen)
    start, rest = compute_memory_before(model, final.objective.runs_before(place)), run.rest_before

    def shake(step: float) -> tuple[Replay, SimulationDiverged | None]:
        try:
            shaken = resample(motion, step).acceleration
            return simulate(model, shaken, dt=step, output_dt=run.dt, start=start, rest=rest), None
        except SimulationDiverged as error:
            return error.replay, error

    doubled = rough and round(run.dt / dt) % 2 == 0 and 2.0 * dt <= largest_step(specimen)
    answer, stopped = shake(2.0 * dt if doubled else dt)
    if stopped and doubled:
        answer, stopped = shake(dt)
    if stopped and not partly:
        raise stopped
    channels = _as_long_as(answer.record.channels, len(run.time)) if stopped else answer.record.channels
    if not rough:
        warn_of_coarse_step(model, answer, motion.title)
    responses = {
        "peak_slip": answer.largest_slip,
        "energy": sum(answer.pad_energy.values()),
        "largest_load": max(high for _, high in answer.load_range.values()),
    }
    return Answer(responses, channels, replayed=True)


def _as_long_as(channels: Mapping[str, Array], count: int) -> dict[str, Array]:
    """Return channels (m,) of a replay that was stopped as channels (count,) that stay as they were last."""
    return {name: np.pad(x, (0, max(count - len(x), 0)), mode="edge")[:count] for name, x in channels.items()}


def compute_memory_before(model: Model, runs: Sequence[FitRun]) -> Memory:
    """Return what pads and buffers remember after the runs before, their laws driven with what was measured."""
    law = predictor(model)
    layout = law.law.layout
    for before in runs:
        law.rest(before.rest_before)
        states = before.states
        motion = rig_motion(states) if law.asks_for_motion else None
        law.pads(states.time, states.load, states.pad_velocity, states.pad_slip, states.pads, motion)
        if model.specimen.buffer_stiffness:
            count = len(model.specimen.buffer_stiffness)
            law.buffers(states.time, *(np.stack([s] * count, axis=1) for s in (states.slip, states.velocity)))
    return Memory(pad_memories(layout, law.numbers).copy(), buffer_memories(layout, law.numbers).copy())


def _driven(model: Model, final: BaseFit, place: int) -> Answer:
    """Drive a slider's law with measured load and motion; its gauges' faults act on what it answers."""
    law, run = predictor(model), final.objective.run(place)
    force = run.states.pad_velocity  # of the run's own shape, where there is nothing before it
    for each in final.objective.runs_before(place + 1):
        law.rest(each.rest_before)
        states = each.states
        motion = rig_motion(states) if law.asks_for_motion else None
        force = law.pads(each.time, each.load, states.pad_velocity, states.pad_slip, each.pads, motion).force
    record = run.record.replaced(**{f"pad_{p}_Fx": force[:, i, 0] for i, p in enumerate(run.pads)})
    for entry in model.with_hook("gauge"):
        record = entry.effect.hooks["gauge"](record, entry.target, **entry.values)
    energy = sum(float(np.sum(force[:, i, 0] * run.velocity) * run.dt) for i in range(len(run.pads)))
    return Answer({"energy": energy}, record.channels, replayed=False)


def compute_share_of_channel(change: Array, measured: Array) -> float:
    """Return the rms of a change (n,) over the rms of the measured channel (n,) about its mean [1]; 0 if it stands."""
    if np.ptp(measured) == 0.0:  # the deviation of equal numbers is round-off, no zero
        return 0.0
    return float(np.sqrt(np.mean(change**2)) / np.std(measured))


def _change(value: float, spread: float) -> Change:
    half = float(np.hypot(abs(value) * np.hypot(spread, _OF_CHANGE), _ABSOLUTE))
    return Change(value, value - half, value + half)


def _spread(labels: list[str], sizes: Sequence[Interval]) -> float:
    """Return the half width of the interval of an effect's best known number, as a share of it [1]."""
    found = [
        0.5 * (i.high - i.low) / abs(i.value)
        for i in sizes
        if i.key.rpartition(".")[0] in labels and i.value and np.isfinite(i.high - i.low)
    ]
    return min(1.0, min(found, default=1.0))
