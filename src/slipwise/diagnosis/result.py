"""What `diagnose` answers: a verdict with its evidence, as an object, as JSON and in words."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from slipwise.comparison.component_level import NAMES
from slipwise.diagnosis.alternatives import find_nearest_family, list_discriminating_tests, list_explanations
from slipwise.diagnosis.ladder import Ladder, make_ladder
from slipwise.diagnosis.replays import replays
from slipwise.diagnosis.unknown_surface import ResidualSurface
from slipwise.diagnosis.verdict import Verdict
from slipwise.diagnosis.why_not import WhyNot, explain_rivals, explain_why_not
from slipwise.display import Drawn, Tabular
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import Interval
from slipwise.estimation.prediction_interval import PredictedFriction
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.model import Model
from slipwise.noise.level import is_at_floor
from slipwise.preparation.data_corrections import BEFORE_BALANCES, DataCorrection
from slipwise.record import Record
from slipwise.selection.columns_at_limits import plant_at_limits
from slipwise.selection.explained_alone import ExplainedAlone
from slipwise.selection.importance import Importance
from slipwise.selection.power import TWINS, EffectPower, compute_power
from slipwise.selection.search_state import Search
from slipwise.selection.upper_limits import UpperLimit
from slipwise.short_repr import short_repr

#: Number of the format of diagnosis.json.
SCHEMA = 2


@short_repr
@dataclass(frozen=True)
class Candidate:
    """A hypothesis that was refitted.

    Attributes:
        effect: names, joined by " + ".
        probability: that it is what is missing.
        holdout_before: held-out error of the base model where this hypothesis helps most, in floors.
        holdout_after: the same with it.
        absorbed_by_base: part of its own effect that base parameters could mimic [1].
        parameters: label.parameter -> interval; without ends where the hypothesis was not the best.
    """

    effect: str
    probability: float
    holdout_before: float
    holdout_after: float
    absorbed_by_base: float
    parameters: Mapping[str, Interval]


@dataclass(frozen=True, repr=False)
class Diagnosis(Drawn, Tabular):
    """The answer.

    Attributes:
        campaign: its name.
        verdict: kind, effects, probability.
        component: "pad friction", "pad load", "buffer", "girder", "table", "instrument" or "none".
        recorded_error: held-out component-level error of the base model on the campaign as it was recorded, worst
            relation, in floors.
        base_error: the same once faults of samples are put right.
        final_error: the same with the named effects.
        relations: relation -> (base, final) held-out error in floors.
        all_samples: the same over all samples of the held-out runs, where stretches of them were judged; else empty.
        system: {"base", "final"} held-out error at replay level, in floors; empty where it was not asked for.
        candidates: hypotheses, best first.
        confirmed: whether the held-out runs agree with what was found; None where none is held out, or not testable.
        predicted_friction: mean friction of the held-out runs of one slider, predicted and measured.
        least: effect -> smallest size that this campaign would have shown, and its unit.
        cannot_tell: what this campaign could not test, and why.
        corrections: what was done about the data before any fit.
        search: everything that was looked at.
        final: the best hypothesis as a fit, for reports and replays.
        seconds: it took.
        stages: what was done, in order -> how long it took [s].
        law: where the verdict is unknown: what `discover` proposes, for a program to read, or None.
        limits: effect that was not named -> how large it can be at most, the largest first.
        power: effect -> what would have been said of it at the limit of what matters; empty where nobody asked.
        why_not: answers of `with_why_not`.
    """

    campaign: str
    verdict: Verdict
    component: str
    recorded_error: float
    base_error: float
    final_error: float
    relations: Mapping[str, tuple[float, float]]
    all_samples: Mapping[str, tuple[float, float]]
    system: Mapping[str, float]
    candidates: tuple[Candidate, ...]
    confirmed: bool | None
    predicted_friction: tuple[PredictedFriction, ...]
    least: Mapping[str, tuple[float, str]]
    cannot_tell: tuple[str, ...]
    corrections: tuple[DataCorrection, ...]
    search: Search
    final: BaseFit
    seconds: float
    stages: Mapping[str, float]
    law: Mapping[str, Any] | None = None
    limits: Mapping[str, UpperLimit] = field(default_factory=dict[str, UpperLimit])
    power: Mapping[str, EffectPower] = field(default_factory=dict[str, EffectPower])
    why_not: tuple[WhyNot, ...] = ()

    @property
    def first(self) -> tuple[DataCorrection, ...]:
        """What was wrong with the data so that no balance meant anything."""
        return tuple(one for one in self.corrections if one.kind in BEFORE_BALANCES)

    @property
    def added(self) -> tuple[str, ...]:
        """Effects that the final model has beside the base's; none where the verdict names none."""
        return self.search.best.names if self.verdict.effects else ()

    @property
    def importance(self) -> Mapping[str, Importance]:
        """What leaving each effect out changes, by effect: those that are named, then those that are minor."""
        found = {f.name: f.importance for f in self.verdict.findings}
        return {n: found[n] for n in (*self.verdict.effects, *self.verdict.minor) if n in found}

    @property
    def held_out(self) -> bool:
        """Whether the campaign has a run that no fit has seen and that could be judged."""
        return self.search.path[0].summary.judged_apart

    @property
    def model(self) -> Model:
        """The model with the named effects, fitted."""
        return self.final.objective.model(self.final.solution.values)

    @property
    def discriminating_tests(self) -> tuple[str, ...]:
        """What would tell two explanations of an ambiguous verdict apart; nothing for another verdict."""
        return list_discriminating_tests(self.verdict, self.search)

    @property
    def may_be_missed(self) -> tuple[str, ...]:
        """Effects that were not named and may be there at a size that matters, for all this campaign can tell."""
        return tuple(name for name, limit in self.limits.items() if limit.may_matter)

    @one_thread_algebra()
    def with_power(self, twins: int = TWINS) -> "Diagnosis":
        """Return the diagnosis with what would have been said of each effect at the limit of what matters.

        Args:
            twins: campaigns with the same model, motions and noise that are looked at for each effect.
        """
        weighed = plant_at_limits(self.search)
        return self if weighed is None else replace(self, power=compute_power(weighed, twins))

    @one_thread_algebra()
    def with_why_not(self, *names: str) -> "Diagnosis":
        """Return the diagnosis with why each of some effects was not named; it is refitted for that.

        Args:
            names: of effects.

        Raises:
            UnknownNameError: an effect that this campaign does not know.
        """
        found = tuple(explain_why_not(self.search, self.verdict.effects, n) for n in names)
        return replace(self, why_not=(*self.why_not, *found))

    def explain_rivals(self, most: int = 2) -> list[WhyNot]:
        """Return why the best of what was refitted was not named: in the place of what was, or alone.

        Args:
            most: rivals at most.
        """
        return explain_rivals(self.search, self.verdict.effects, most)

    def ladder(self) -> Ladder:
        """Return the ladder that the diagnosis has climbed already."""
        return make_ladder(self.search, self.system, self.corrections, named=bool(self.added))

    @property
    def left_over(self) -> str:
        """What is left above the noise when the named effects are in the model, in words."""
        over = [
            f"{NAMES[name][0]} {after:.2f}" for name, (_, after) in self.relations.items() if not is_at_floor(after)
        ]
        if over:
            return f"still above the noise, in floors: {', '.join(over)}"
        if self.verdict.leftover != "none":
            surface = self.verdict.surface
            return f"what is left: {surface.words if surface else 'no state that was measured organises it'}"
        return "nothing is left above the noise"

    def replays(self) -> tuple[Record, list[tuple[str, Record]]]:
        """Replay the first held-out run with the model before and after: measured record, then label and record.

        Raises:
            InputError: the table's motion was not recorded.
        """
        return replays(self.search.base, self.final, self.added)

    @property
    def sentence(self) -> str:
        """The verdict in one sentence."""
        chance = f"{100 * self.verdict.probability:.0f} %"
        names = " and ".join(self.verdict.effects)
        error = "held-out error" if self.held_out else "error on the runs that were fitted"
        before, base = _short(self.recorded_error), _short(self.base_error)
        before += f" as recorded, {base} with what is wrong in the records put right" if before != base else ""
        fall = f"{error} {before} -> {_short(self.final_error)} times the noise floor"
        beside = ", and something outside the catalogue" if self.verdict.unknown_beside else ""
        match self.verdict.kind:
            case "complete":
                clean = is_at_floor(self.base_error) and not self.verdict.minor
                least = "above the noise" if clean else "that matters"
                return f"Nothing {least} is missing ({_short(self.base_error)} times the floor; {chance}){self._minor}."
            case "named" | "instrument" if self.verdict.is_doubtful:
                what = "missing" if self.verdict.kind == "named" else "missing, or a gauge is at fault"
                best = f"The best account of it, {names}{beside}, is more likely wrong in part than right ({chance})"
                return f"Something is {what}. {best}; {fall}{self._minor}{self._bounds}."
            case "named":
                return f"The model lacks {names}{beside} ({chance}); {fall}{self._minor}{self._bounds}."
            case "instrument":
                return f"A gauge is at fault: {names}{beside} ({chance}); {fall}{self._minor}{self._bounds}."
            case "ambiguous":
                rivals = " or ".join(" + ".join(e) for e in list_explanations(self.verdict, self.search))
                return f"Either {rivals}: this campaign cannot tell them apart ({chance})."
            case _:
                surface = self.verdict.surface
                shape = surface.words if surface else "no state that was measured organises it"
                what = f"Something outside the catalogue ({chance})"
                if self.verdict.is_doubtful:
                    what = f"What is left matters and has no name; a law outside the catalogue is not likely ({chance})"
                return f"{what}. {shape[0].upper()}{shape[1:]}{self._nearest}."

    @property
    def needless_with_law(self) -> tuple[str, ...]:
        """Effects that are named and do not stand beside the proposed law: they stood for a part of it."""
        beside = self.verdict.effects if self.law is None else self.law["beside"]
        return tuple(name for name in self.verdict.effects if name not in beside)

    @property
    def _nearest(self) -> str:
        """Which law of the catalogue comes nearest to what has no name, as the end of a sentence."""
        found = find_nearest_family(self.search)
        return f"; nearest in the catalogue: {found[0]}, which explains {found[1]:.0%} of it" if found else ""

    @property
    def _minor(self) -> str:
        """What is there and does not matter, as the end of a sentence."""
        return f"; present, but not material: {', '.join(self.verdict.minor)}" if self.verdict.minor else ""

    @property
    def _bounds(self) -> str:
        """Which parameters of the named effects ended on a bound, as the end of a sentence."""
        ends = [f"{f.name}.{p}" for f in self.verdict.findings if f.name in self.verdict.effects for p in f.at_bound]
        return f"; on its bound: {', '.join(ends)}" if ends else ""

    def as_json(self) -> dict[str, Any]:
        """Return the contract of diagnosis.json."""
        verdict = self.verdict
        return {
            "schema": SCHEMA,
            "campaign": self.campaign,
            "rig": self.final.campaign.specimen.name,
            "verdict": verdict.kind,
            "effects": list(verdict.effects),
            "minor": list(verdict.minor),
            "probability": round(verdict.probability, 3),
            "component": self.component,
            "recorded_error": _number(self.recorded_error),
            "base_error": _number(self.base_error),
            "floor": 1.0,
            "final_error": _number(self.final_error),
            "confirmed": self.confirmed,
            "relations": _pairs(self.relations),
            "all_samples": _pairs(self.all_samples),
            "system": {k: _number(v) for k, v in self.system.items()},
            "importance": {name: _importance(found) for name, found in self.importance.items()},
            "candidates": [_candidate(c) for c in self.candidates],
            "screened": [_screened(s) for s in self.search.alone],
            "leftover": verdict.leftover,
            "unknown_beside": verdict.unknown_beside,
            "unknown": _surface(verdict.surface) if verdict.leftover == "unknown" else None,
            "law": None if self.law is None else dict(self.law),
            "predicted_friction": [_predicted_friction(f) for f in self.predicted_friction],
            "least": {k: _number(v) for k, (v, _) in self.least.items()},
            "limits": {name: limit.as_json() for name, limit in self.limits.items()},
            "may_be_missed": list(self.may_be_missed),
            "power": {name: one.as_json() for name, one in self.power.items()},
            "why_not": [one.as_json() for one in self.why_not],
            "cannot_tell": list(self.cannot_tell),
            "first": [one.as_json() for one in self.first],
            "corrections": [one.as_json() for one in self.corrections],
            "words": self.sentence,
            "seconds": round(self.seconds, 1),
        }

    def _headline(self) -> str:
        return f"{self.campaign}: {self.sentence}"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {
                "hypothesis": c.effect,
                "probability": c.probability,
                "before": c.holdout_before,
                "after": c.holdout_after,
                "absorbed_by_base": c.absorbed_by_base,
            }
            for c in self.candidates
        ]


def _pairs(found: Mapping[str, tuple[float, float]]) -> dict[str, Any]:
    return {k: {"base": _number(a), "final": _number(b)} for k, (a, b) in found.items()}


def _short(error: float) -> str:
    """Write an error in two figures, or to a whole floor where that is more."""
    return f"{error:.2g}" if error < 99.5 else f"{error:.0f}"


def _number(value: float, figures: int = 4) -> float | None:
    return float(f"{value:.{figures}g}") if np.isfinite(value) else None


def _candidate(found: Candidate) -> dict[str, Any]:
    return {
        "effect": found.effect,
        "probability": round(found.probability, 3),
        "holdout_before": _number(found.holdout_before),
        "holdout_after": _number(found.holdout_after),
        "absorbed_by_base": _number(found.absorbed_by_base),
        "parameters": {k: written(p) for k, p in found.parameters.items()},
    }


def _importance(found: Importance) -> dict[str, Any]:
    responses = {name: [_number(x) for x in (c.value, c.low, c.high)] for name, c in found.responses.items()}
    return {**responses, "channels": {name: _number(x) for name, x in found.channels.items()}}


def _predicted_friction(found: PredictedFriction) -> dict[str, Any]:
    numbers = {"measured": found.measured, "value": found.value, "low": found.low, "high": found.high}
    return {"run": found.run, **{k: _number(v) for k, v in numbers.items()}, "unit": "N"}


def _screened(found: ExplainedAlone) -> dict[str, Any]:
    """Write what a candidate could explain alone, in squared residuals, and what the base parameters hide of it."""
    return {
        "effect": found.term.label,
        "gain": _number(found.gain),
        "absorbed_by_base": _number(max(found.absorbed, 0.0)),
    }


def written(found: Interval) -> dict[str, Any]:
    """Write a number with its interval; "limit" says that `high` is what it is at most, and that it may be absent."""
    numbers = {"value": found.value, "low": found.low, "high": found.high}
    out = {**{k: _number(v, found.figures) for k, v in numbers.items()}, "unit": found.unit}
    out["at_bound"] = bool(found.bound)
    return {**out, "limit": found.limit} if found.limit else out


def _surface(found: ResidualSurface | None) -> dict[str, Any] | None:
    if found is None:
        return None
    return {
        "relation": found.relation,
        "states": list(found.states),
        "edges": [[_number(float(x)) for x in e] for e in found.edges],
        "mean": _nested(found.mean),
        "band": _nested(found.band),
        "unit": found.unit,
        "explained": _number(found.explained),
        "words": found.words,
    }


def _nested(values: np.ndarray) -> list[Any]:
    return [_nested(v) for v in values] if values.ndim > 1 else [_number(float(v)) for v in values]
