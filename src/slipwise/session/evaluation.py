"""A campaign made ready once, so that any state of a session is held against it in milliseconds."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from slipwise.campaign import Campaign
from slipwise.campaign.scales import scales_of
from slipwise.comparison.component_level import NAMES
from slipwise.estimation.base_fit import BaseFit, free_numbers, scale_model
from slipwise.estimation.least_squares import Solution, solve
from slipwise.estimation.objective import Objective, make_objective
from slipwise.model import Model, base_model
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import Prepared
from slipwise.relations.parameters import Free, make_stick_damping, make_terms
from slipwise.relations.run_data import FitRun, fit_runs
from slipwise.relations.table import Residuals
from slipwise.session.state import SessionState, Weights
from slipwise.short_repr import short_repr

#: What a table says of a relation that no sample judges.
NOT_JUDGED = "not judged"
#: Objectives that stay ready: this state's, that before it, the one it is compared with, each also coarse.
_READY = 6


@short_repr
@dataclass(frozen=True)
class BalanceError:
    """Error of one relation.

    Attributes:
        relation: "pads", "girder" ...
        name: as people call it.
        fitted: rms of the residual over its floor, of all runs that may be fitted [1]; None where none of their samples
            judges it.
        held_out: the same of the held-out runs; None where none is held out, or none of their samples judges it.
        runs: run -> the same of this run.
    """

    relation: str
    name: str
    fitted: float | None
    held_out: float | None
    runs: Mapping[str, float]

    @property
    def error(self) -> float | None:
        """The held-out error; that of the fitted runs where there is none; None for a relation that is not judged."""
        return self.fitted if self.held_out is None else self.held_out


@dataclass
class Evaluator:
    """The runs of a campaign, ready for the relations of a fit.

    Attributes:
        prepared: the campaign.
        model: where the session began, its effects with the bounds that they have in this campaign.
        runs: as a fit needs them.
    """

    prepared: Prepared
    model: Model
    runs: list[FitRun]
    _ready: list[tuple[Weights, Objective]] = field(default_factory=list[tuple[Weights, Objective]])

    def objective(self, state: SessionState, watch: Callable[[], None] | None = None) -> Objective:
        """Return the relations of a state, weighed as it says."""
        found = next((ready for ready in self._ready if ready[0] == state.weights), None)
        if found is None:
            found = (state.weights, self._weighed(state.weights))
            self._ready = [*self._ready, found][-_READY:]
        return replace(found[1], terms=state.terms, watch=watch)

    def _weighed(self, weights: Weights) -> Objective:
        objective = make_objective(self.runs, self.model.specimen, weights.terms)
        objective = objective.with_yaw() if weights.yaw else objective
        return objective.weigh(weights.values, finer=weights.finer)

    def coarse(self, state: SessionState) -> SessionState:
        """Return a state that is evaluated at half the instants: in half the time, and nearly as well."""
        return replace(state, weights=replace(state.weights, finer=False))

    def residuals(self, state: SessionState) -> Residuals:
        """Evaluate every relation in all runs."""
        return self.objective(state).residuals(state.values)

    def model_of(self, state: SessionState) -> Model:
        """Return the model that a state describes."""
        return self.objective(state).model(state.values)

    def free(self, state: SessionState) -> list[Free]:
        """Return every number of a state that may be changed, with its bounds; an effect on a card has one set."""
        objective = self.objective(state)
        model = Model(self.model.specimen, tuple(u for t in state.terms for u in t.uses(state.values)))
        cards = [t for t in state.terms if len(t.targets) > 1]
        single = {f"{u.label}.{n}" for t in cards for u in t.uses(state.values) for n in t.effect.parameter_names}
        free = [f for f in free_numbers(self.prepared.campaign, model, objective) if f.key not in single]
        for term in cards:
            free += term.free({n: state.values[f"{term.label}.{n}"] for n in term.effect.parameter_names})
        if "rig.stick_damping" in state.values and any(f.key == "rig.stick_length" for f in free):
            free.append(make_stick_damping(self.runs[0].scales.time))
        return free

    def as_fit(self, state: SessionState) -> BaseFit:
        """Return a state as a fit without slopes, for replays."""
        objective, free, residuals = self.objective(state), tuple(self.free(state)), self.residuals(state)
        cost = residuals.cost(objective.fitted)
        solution = Solution(dict(state.values), free, residuals, np.empty((0, 0)), cost, 0)
        return BaseFit(self.prepared.campaign, self.model_of(state), objective, free, solution)

    def with_slopes(self, state: SessionState) -> BaseFit:
        """Return a state that was fitted as a fit with its slopes, for what is held against it."""
        fit = self.as_fit(state)
        return replace(fit, solution=solve(fit.objective, dict(state.values), list(fit.free), most=1))


def evaluator(campaign: Campaign, model: Model | None) -> tuple[Evaluator, SessionState]:
    """Make a campaign ready, and give the state in which a session begins: the model as stated, nothing fitted.

    Args:
        campaign: as it was recorded.
        model: the user's; the paper's law on the campaign's rig when not given.

    Raises:
        InputError: a run lacks what every fit needs.
    """
    prepared = prepare(campaign)
    whole, stated = prepared.campaign, prepared.on_rig(model)
    begun = scale_model(stated or base_model(whole.specimen), scales_of(whole), typical=model is None)
    ready = Evaluator(prepared, begun, fit_runs(whole, prepared.invalid))
    terms = make_terms(begun)
    objective = make_objective(ready.runs, begun.specimen, terms)
    values = {f.key: prepared.start.get(f.key, f.start) for f in free_numbers(whole, begun, objective)}
    return ready, SessionState(terms, values, Weights(terms, values, finer=False))


def errors_of(objective: Objective, residuals: Residuals) -> tuple[BalanceError, ...]:
    """Return the error of every relation in floors."""
    out = []
    for relation in objective.relations:
        judged = [of for of in residuals.blocks(relation) if of.count]
        runs = {of.name: residuals.level(relation, [of.run]) for of in judged}
        fitted, held = (
            residuals.level(relation, places) if residuals.count(relation, places) else None
            for places in (objective.fitted, objective.held_out)
        )
        out.append(BalanceError(relation, NAMES[relation][0], fitted, held, runs))
    return tuple(out)
