"""A fit with a law that is no effect yet: its force is added to what the fit predicts, through the logger's filter.

Nothing has to be compiled for it, and base parameters, named effects and the law's constants are free together.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from slipwise.arrays import Array
from slipwise.discovery.matching import Match, constants_of, limits, place_of, product_at
from slipwise.estimation.least_squares import Solution, get_slopes, solve
from slipwise.estimation.objective import Objective
from slipwise.relations.noise import whiten_residual
from slipwise.relations.pad_law import log_force
from slipwise.relations.pad_stages import divide_by_noise
from slipwise.relations.parameters import Free
from slipwise.relations.stages import Inputs, Memo, Stage, make_memo
from slipwise.relations.table import Residuals
from slipwise.residual_map.states import DrivingState, PadInstants, derived
from slipwise.short_repr import short_repr
from slipwise.signals.filters import LowPass
from slipwise.signals.pitch import pass_through_pitch

#: A fit ends where a step lowers the squared residual by less than this, and than this share of what is left [1].
_ENOUGH, _ROUGH = 10.0, 5e-4
#: Largest strength, as a multiple of the one that was matched [1], and factor by which a time constant may change.
_STRONGEST, _LAG = 30.0, 8.0
STRENGTH, TIME_CONSTANT, LEVER = "strength", "time_constant", "lever"


@short_repr
@dataclass(frozen=True)
class PlacedLaw:
    """A matched form where it acts.

    Attributes:
        label: begins the keys of its numbers.
        match: the form, its states, port and gate.
        opened: per run (f, p) 1 where the gate is open.
        lever: how far below the girder's centre a force on it acts [m]: it tips the girder.
        longest_lever: up to which the lever is free [m]; 0 where it is known, or nothing tells it.
    """

    label: str
    match: Match
    opened: tuple[Array, ...]
    lever: float = 0.0
    longest_lever: float = 0.0

    @property
    def lag(self) -> float:
        """Time constant of its states [s]; 0 where none lags."""
        return max(s.time_constant for s in self.match.candidate.states)

    def own(self, values: Mapping[str, float]) -> dict[str, float]:
        """Return its numbers by name: strength, constants, time constant and lever, as far as they are there."""
        names = (STRENGTH, *constants_of(self.match.forms), TIME_CONSTANT, LEVER)
        return {name: values[key] for name in names if (key := f"{self.label}.{name}") in values}

    def free(self, strength: float) -> list[Free]:
        """Return its numbers as free ones, strength first."""
        port, states = self.match.candidate.port, self.match.candidate.states
        most = _STRONGEST * abs(strength)
        out = [Free(f"{self.label}.{STRENGTH}", strength, -most, most, 0.3 * abs(strength), port.unit)]
        for name, constant in constants_of(self.match.forms).items():
            if constant.kind == "reference":
                continue
            low, high = limits(constant, states[place_of(name)])
            value = self.match.constants[name]
            size = 0.1 * abs(value) if constant.kind in ("width", "period") else 0.05 * (high - low)
            out.append(Free(f"{self.label}.{name}", value, min(low, value), max(high, value), size, ""))
        if self.lag:
            out.append(
                Free(f"{self.label}.{TIME_CONSTANT}", self.lag, self.lag / _LAG, self.lag * _LAG, 0.2 * self.lag, "s")
            )
        if self.longest_lever:
            most = self.longest_lever
            out.append(Free(f"{self.label}.{LEVER}", self.lever, -most, most, 0.1 * most, "m"))
        return out


@short_repr
@dataclass(frozen=True, eq=False)
class LawObjective:
    """An objective with laws added.

    Attributes:
        every: all runs at the instants, for states that lag by another time.
        plain: the objective without them.
        laws: what is added.
    """

    every: PadInstants
    plain: Objective
    laws: tuple[PlacedLaw, ...]

    @property
    def fitted(self) -> list[int]:
        """Places of the runs that may be fitted."""
        return self.plain.fitted

    @property
    def relations(self) -> tuple[str, ...]:
        """Names of the relations."""
        return self.plain.relations

    @property
    def balanced(self) -> bool:
        """Whether the balances of a girder are there."""
        return self.plain.balanced

    def near(self, values: Mapping[str, float]) -> "LawObjective":
        """Return the objective of which slopes at these values are to be taken."""
        plain = self.plain.near(values)
        return self if plain is self.plain else replace(self, plain=plain)

    def residuals(self, values: Mapping[str, float], *, fitted_only: bool = False) -> Residuals:
        """Evaluate every relation; arguments as `Objective.residuals`."""
        found = self.plain.residuals(values, fitted_only=fitted_only)
        evaluation = replace(self.plain.evaluation(values), memo=self._memo)
        for stage in self._stages:
            found = found.less(evaluation.of(stage))
        return found

    def without_results(self) -> "LawObjective":
        """Return the objective without the results that it keeps at hand: each is as long as all the runs."""
        return replace(self)

    @cached_property
    def _memo(self) -> Memo:
        return make_memo(self.plain.measurements)

    @cached_property
    def _stages(self) -> list[Stage[dict[str, list[Array]]]]:
        return [Stage(law.label, partial(self.columns, law)) for law in self.laws]

    def columns(self, law: PlacedLaw, inputs: Inputs) -> dict[str, list[Array]]:
        """Return what a law adds to the predictions, relation -> of every run, in noise, shaped as its residual."""
        values, relation = inputs.values, law.match.candidate.port.relation
        own = law.own(values)
        states, places = self.driving(law, own), range(len(inputs.measurements.runs))
        forces = [self.force(i, law, states, own, values) for i in places]
        out = {relation: [_seen(inputs, relation, i, force) for i, force in enumerate(forces)]}
        lever = own.get(LEVER, law.lever)
        if relation == "girder" and lever and "pitch" in self.relations:
            out["pitch"] = [_seen(inputs, "pitch", i, _tipping(inputs, i, f, lever)) for i, f in enumerate(forces)]
        return out

    def force(
        self,
        place: int,
        law: PlacedLaw,
        states: Sequence[DrivingState],
        own: Mapping[str, float],
        values: Mapping[str, float],
    ) -> Array:
        """Return what a law adds to the prediction of one run at its samples, in its relation's unit and shape.

        Args:
            place: of the run.
            law: any, whether or not it is one of the objective's.
            states: what `driving` gives.
            own: the law's numbers by name.
            values: of the fit.
        """
        run, port = self.plain.run(place), law.match.candidate.port
        form = product_at(law.match.forms, [s.values[place] for s in states], {**law.match.constants, **own})
        force = own[STRENGTH] * port.carrier[place] * law.opened[place] * form
        if port.relation != "pads":
            return force[:: run.fine, 0]
        by = LowPass(values["rig.logger"]) if "rig.logger" in values else None
        delay = values.get("rig.late_force", 0.0)
        return log_force(force, run, by, averaged=not self.plain.has_stick, delay=delay)

    def driving(self, law: PlacedLaw, own: Mapping[str, float]) -> list[DrivingState]:
        """Return the states that drive a law, with the lag of its own numbers."""
        states, now = law.match.candidate.states, own.get(TIME_CONSTANT, law.lag)
        if now == law.lag:
            return list(states)
        found = derived(self.every, now)
        return [replace(s, time_constant=now, values=tuple(found[s.name])) if s.time_constant else s for s in states]


def _tipping(inputs: Inputs, place: int, acceleration: Array, lever: float) -> Array:
    """Return the pitch load (n,) [N] of a force that accelerates the girder so [m/s^2], as `predict_balances`."""
    values, specimen, run = inputs.values, inputs.measurements.specimen, inputs.measurements.runs[place]
    load = -values.get("rig.mass", specimen.mass) * acceleration * lever / specimen.half_spacing[0]
    return pass_through_pitch(load, run.dt, values["rig.pitch_frequency"], values["rig.pitch_damping"])


def _seen(inputs: Inputs, relation: str, place: int, column: Array) -> Array:
    """Return what is added to a prediction as its residual shows it: whitened alike, in noise."""
    run, sigmas, ringing = inputs.measurements.runs[place], inputs.weighed("sigmas"), inputs.weighed("ringing")
    if relation in ringing:
        column = whiten_residual(column, run, float(np.min(sigmas[relation][place])), ringing[relation][place])
    return divide_by_noise(inputs, relation, place, column, run)


@short_repr
@dataclass(frozen=True)
class FittedLaw:
    """A law with its constants, everything else free beside it.

    Attributes:
        law: where it acts.
        objective: that was fitted.
        solution: of the fit.
    """

    law: PlacedLaw
    objective: LawObjective
    solution: Solution

    @property
    def rated_load(self) -> float:
        """Mean load of the runs [N]."""
        return float(np.mean(np.concatenate([s.load for s in self.objective.every.states])))

    @property
    def buffers(self) -> int:
        """How many buffers share a force on the girder."""
        return max(len(self.objective.plain.specimen.buffer_stiffness), 1)

    @property
    def values(self) -> dict[str, float]:
        """The law's numbers by name: strength, constants, references, time constant."""
        own = {k.partition(".")[2]: v for k, v in self.solution.values.items() if k.startswith(f"{self.law.label}.")}
        return {**self.law.match.constants, **own}


def fit_law(before: LawObjective, solution: Solution, law: PlacedLaw, strength: float) -> FittedLaw:
    """Fit a law's constants with everything else free, led by the slopes of before.

    Args:
        before: the objective that it is added to.
        solution: where the fit begins, with its slopes.
        law: the form and where it acts.
        strength: to begin with.
    """
    objective = replace(before, laws=(*before.laws, law)).without_results()
    own = law.free(strength)
    values = {**solution.values, **{f.key: f.start for f in own}}
    known = get_slopes(solution)
    found = solve(objective, values, [*solution.free, *own], most=6, enough=_ENOUGH, rough=_ROUGH, known=known)
    return FittedLaw(law, objective.without_results(), found)


def fit_on(found: FittedLaw) -> FittedLaw:
    """Fit on with slopes of its own."""
    solution = solve(
        found.objective, found.solution.values, found.solution.free, most=12, enough=_ENOUGH, rough=0.1 * _ROUGH,
        begin=get_slopes(found.solution),
    )  # fmt: skip
    return replace(found, solution=solution)
