"""A fit with a law that is no effect yet: its force is added to what the fit predicts, through the logger's filter.

Nothing has to be compiled for it, and base parameters, named effects and the law's constants are free together.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.discovery.matching import Match, constants_of, limits, place_of, product_at
from slipwise.discovery.states import PadInstants, State, derived
from slipwise.estimation.least_squares import Solution, slopes_of, solve
from slipwise.estimation.pad_forces import as_logged
from slipwise.estimation.parameters import Free
from slipwise.estimation.problem import Problem
from slipwise.estimation.residuals import Residuals
from slipwise.signals.filters import LowPass

Array = NDArray[np.float64]
#: A fit ends where a step lowers the squared residual by less than this, and than this share of what is left [1].
_ENOUGH, _ROUGH = 10.0, 5e-4
#: Largest strength, as a multiple of the one that was matched [1], and factor by which a time constant may change.
_STRONGEST, _LAG = 30.0, 8.0
STRENGTH, TIME_CONSTANT = "strength", "time_constant"


@dataclass(frozen=True)
class PlacedLaw:
    """A matched form where it acts.

    Attributes:
        label: begins the keys of its numbers.
        match: the form, its states, port and gate.
        opened: per run (f, p) 1 where the gate is open.
    """

    label: str
    match: Match
    opened: tuple[Array, ...]

    @property
    def lag(self) -> float:
        """Time constant of its states [s]; 0 where none lags."""
        return max(s.time_constant for s in self.match.candidate.states)

    def free(self, strength: float) -> list[Free]:
        """Give its numbers as free ones, strength first."""
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
        return out


@dataclass
class LawProblem:
    """A problem with laws added.

    Attributes:
        every: all runs at the instants, for states that lag by another time.
        plain: the problem without them.
        laws: what is added.
    """

    every: PadInstants
    plain: Problem
    laws: tuple[PlacedLaw, ...]
    _kept: dict[tuple[float, ...], list[Array]] = field(default_factory=dict[tuple[float, ...], list[Array]])

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

    def near(self, values: Mapping[str, float]) -> "LawProblem":
        """Give the problem of which slopes at these values are to be taken."""
        return replace(self, plain=self.plain.near(values))

    def residuals(self, values: Mapping[str, float], *, fitted_only: bool = False) -> Residuals:
        """Evaluate every relation; arguments as `Problem.residuals`."""
        found = self.plain.residuals(values, fitted_only=fitted_only)
        parts = {name: list(of) for name, of in found.parts.items()}
        for law in self.laws:
            relation = law.match.candidate.port.relation
            for i, column in enumerate(self._columns(law, values)[: len(parts[relation])]):
                parts[relation][i] = parts[relation][i] - column
        return Residuals(parts, found.pad_forces)

    def _columns(self, law: PlacedLaw, values: Mapping[str, float]) -> list[Array]:
        """Give what a law adds to the prediction of every run, in noise, shaped as its residual."""
        own = {k.removeprefix(f"{law.label}."): v for k, v in values.items() if k.startswith(f"{law.label}.")}
        key = (float(self.laws.index(law)), *(own[k] for k in sorted(own)))
        if key not in self._kept:
            if len(self._kept) > 8:
                self._kept.clear()
            self._kept[key] = self._made(law, own, values)
        return self._kept[key]

    def _made(self, law: PlacedLaw, own: Mapping[str, float], values: Mapping[str, float]) -> list[Array]:
        relation, states = law.match.candidate.port.relation, self.driving(law, own)
        out = []
        for i, run in enumerate(self.plain.runs):
            force = self.force(i, law, states, own, values)
            out.append(np.where(run.judged[relation], force / self.plain.sigmas[relation][i], 0.0))
        return out

    def force(
        self, place: int, law: PlacedLaw, states: Sequence[State], own: Mapping[str, float], values: Mapping[str, float]
    ) -> Array:
        """Give what a law adds to the prediction of one run at its samples, in its relation's unit and shape.

        Args:
            place: of the run.
            law: any, whether or not it is one of the problem's.
            states: what `driving` gives.
            own: the law's numbers by name.
            values: of the fit.
        """
        run, port = self.plain.runs[place], law.match.candidate.port
        form = product_at(law.match.forms, [s.values[place] for s in states], {**law.match.constants, **own})
        force = own[STRENGTH] * port.carrier[place] * law.opened[place] * form
        if port.relation != "pads":
            return force[:: run.fine, 0]
        by = LowPass(values["rig.logger"]) if "rig.logger" in values else None
        delay = values.get("rig.late_force", 0.0)
        return as_logged(force, run, by, averaged=not self.plain.has_stick, delay=delay)

    def driving(self, law: PlacedLaw, own: Mapping[str, float]) -> list[State]:
        """Give the states that drive a law, with the lag of its own numbers."""
        states, now = law.match.candidate.states, own.get(TIME_CONSTANT, law.lag)
        if now == law.lag:
            return list(states)
        found = derived(self.every, now)
        return [replace(s, time_constant=now, values=tuple(found[s.name])) if s.time_constant else s for s in states]


@dataclass(frozen=True)
class FittedLaw:
    """A law with its constants, everything else free beside it.

    Attributes:
        law: where it acts.
        problem: that was fitted.
        solution: of the fit.
    """

    law: PlacedLaw
    problem: LawProblem
    solution: Solution

    @property
    def rated_load(self) -> float:
        """Mean load of the runs [N]."""
        return float(np.mean(np.concatenate([s.load for s in self.problem.every.states])))

    @property
    def buffers(self) -> int:
        """How many buffers share a force on the girder."""
        return max(len(self.problem.plain.specimen.buffer_stiffness), 1)

    @property
    def values(self) -> dict[str, float]:
        """The law's numbers by name: strength, constants, references, time constant."""
        own = {k.partition(".")[2]: v for k, v in self.solution.values.items() if k.startswith(f"{self.law.label}.")}
        return {**self.law.match.constants, **own}


def fit_law(before: LawProblem, solution: Solution, law: PlacedLaw, strength: float) -> FittedLaw:
    """Fit a law's constants with everything else free, led by the slopes of before.

    Args:
        before: the problem that it is added to.
        solution: where the fit begins, with its slopes.
        law: the form and where it acts.
        strength: to begin with.
    """
    problem = replace(before, laws=(*before.laws, law), _kept={})
    own = law.free(strength)
    values = {**solution.values, **{f.key: f.start for f in own}}
    known = slopes_of(solution)
    found = solve(problem, values, [*solution.free, *own], most=6, enough=_ENOUGH, rough=_ROUGH, known=known)
    return FittedLaw(law, problem, found)


def fit_on(found: FittedLaw) -> FittedLaw:
    """Fit on with slopes of its own."""
    solution = solve(
        found.problem, found.solution.values, found.solution.free, most=12, enough=_ENOUGH, rough=0.1 * _ROUGH,
        begin=slopes_of(found.solution),
    )  # fmt: skip
    return replace(found, solution=solution)
