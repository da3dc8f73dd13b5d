"""The base fit: the user's model with its own parameters and the rig's numbers, nothing missing added."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.campaign import Campaign
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.campaign.scales import Scales, scales_of
from slipwise.effects import catalogue, holding, scaled
from slipwise.errors import InputError
from slipwise.estimation.least_squares import Solution, get_slopes, solve
from slipwise.estimation.objective import Objective, make_objective
from slipwise.model import Model, base_model, use_of
from slipwise.relations.force_offset import free_zero
from slipwise.relations.parameters import (
    DAMPED_STICK,
    ZERO,
    Free,
    list_base_numbers,
    list_replaced_numbers,
    make_free_inertia,
    make_stick_damping,
    make_terms,
)
from slipwise.relations.run_data import FitRun, fit_runs
from slipwise.relations.sample_masks import LEAST_SAMPLES
from slipwise.short_repr import short_repr

#: Noise near reversals depends on the fit and the fit on the noise: each is made anew, and every fit ends where a step
#: promises less than this much of the squared residual. One halfwidth of an interval is worth four [1].
_ENOUGH = (1.0, 0.1)
#: Both are made anew more often, so often at most, where the resonance of the girder's pitch has moved by more than
#: this share of its width, and noise is louder there by more than this share of the squared residual.
_MORE_ROUNDS, _AT_REST, _LOUDER = 3, 0.1, 0.02
#: The same as a share of what is left above the noise: a law that is wrong needs no fine fit [1].
_ROUGH = 1e-5
#: Where a fit that is reported ends, and where one that is only to be weighed by [1]; both also at a share of what is
#: left above the noise: a law that is wrong needs no fine fit.
_FINAL_REFIT, _TO_WEIGH, _MUCH_LEFT = 0.1, 50.0, 5e-4
#: A stick longer than this share of the stroke is no detail of the rig [1].
_STICK_SHARE = 0.01
#: A fit from elsewhere is another one if it leaves this share less of the squared residual [1].
_BETTER = 0.01
#: Two laws weigh alike that change the squared residual by less than this share [1].
_WEIGHS_ALIKE = 0.1
#: Share of the pads' squared residual that yaw must take away [1].
_MIN_YAW_GAIN = 0.03


@short_repr
@dataclass(frozen=True)
class BaseFit:
    """What the base model makes of a campaign.

    Attributes:
        campaign: that was fitted.
        model: where the fit began.
        objective: relations and noise.
        free: base parameters.
        solution: the fit.
    """

    campaign: Campaign
    model: Model
    objective: Objective
    free: tuple[Free, ...]
    solution: Solution


def fit_base(
    campaign: Campaign,
    model: Model | None = None,
    invalid: InvalidSamples | None = None,
    start: Mapping[str, float] | None = None,
    watch: Callable[[], None] | None = None,
) -> BaseFit:
    """Fit a campaign's base parameters on its runs of role fit and repeat.

    Args:
        campaign: with at least one run that is not held out; where its logger is not known, the frequency of the usual
            filter is fitted too.
        model: the user's current model; the paper's law on the campaign's rig when not given.
        invalid: run -> channel -> samples (n,) at which it is no measurement.
        start: key -> value where the fit begins; rated or typical where none is given.
        watch: called before every evaluation; what it raises ends the fit.

    Raises:
        InputError: a run lacks what every fit needs, or the runs are too short for one.
    """
    model = scale_model(model or base_model(campaign.specimen), scales_of(campaign), typical=model is None)
    objective = make_objective(fit_runs(campaign, invalid), model.specimen, make_terms(model), watch=watch)
    _refuse_too_short(objective, free_numbers(campaign, model, objective))
    return _fitted(campaign, model, objective, start or {})


def _refuse_too_short(objective: Objective, free: Sequence[Free]) -> None:
    """Refuse runs that do not hold as many samples as there are numbers to fit, and those of which none counts.

    Raises:
        InputError: there are too few samples by which a law can be judged.
    """
    reason = "samples near the ends of a run, in a gap and where a pad lifts do not count"
    for run in objective.runs:
        if not run.states.usable.any():
            raise InputError(f"{run.name}: a law can be judged by no sample of it: {reason}; leave this run out")
    judged = sum(_judged_samples(objective, run) for run in objective.fitted_runs)
    if judged < len(free):
        raise InputError(
            f"{len(free)} numbers are to be fitted, and a law can be judged by {judged} samples of the runs that are "
            f"not held out: {reason}, nor do fewer than {LEAST_SAMPLES} of a run; give longer runs"
        )


def _judged_samples(objective: Objective, run: FitRun) -> int:
    """Count the samples of a run by which a relation is judged in which a law shows; too few tell nothing."""
    names = [relation for relation in objective.relations if relation != "motion"]
    masks = [run.judged[relation].reshape(len(run.time), -1).any(axis=1) for relation in names]
    count = int(np.count_nonzero(np.any(masks, axis=0)))
    return count if count >= LEAST_SAMPLES else 0


def fit_roughly(campaign: Campaign, invalid: InvalidSamples | None = None) -> Solution:
    """Return where a rough fit of the paper's law ends, the logger's frequency among its numbers if that is not known.

    Args:
        campaign: with at least one run that is not held out.
        invalid: as for `fit_base`.

    Raises:
        InputError: a run lacks what every fit needs.
    """
    model = scale_model(base_model(campaign.specimen), scales_of(campaign), typical=True)
    objective = make_objective(fit_runs(campaign, invalid), model.specimen, make_terms(model))
    return _roughly(objective, free_numbers(campaign, model, objective), {})[1]


def scale_model(model: Model, scales: Scales, *, typical: bool) -> Model:
    """Return a model whose effects may have the values that a record of these scales asks for.

    Of the plastic pressure and the shear strength only the ratio counts, s/H: both go with the pressure.

    Args:
        model: as stated.
        scales: of the campaign.
        typical: whether its values are typical ones, to be scaled too; those that a user has stated are kept.
    """
    if scales == Scales():
        return model
    uses = []
    typical = typical and model.specimen.slides  # dampers of what does not slide are in the size of this rig already
    for entry in model.uses:
        effect = scaled(catalogue().get(entry.effect.name, entry.effect), scales.of, scales.room)
        values = {n: scales.of(effect.parameter(n).unit) * v if typical else v for n, v in entry.numbers.items()}
        uses.append(replace(use_of(holding(effect, values), values, entry.target), held=entry.held))
    if not typical:
        return replace(model, uses=tuple(uses))
    rated = model.specimen
    specimen = replace(
        rated,
        plastic_pressure=scales.pressure * rated.plastic_pressure,
        shear_strength=scales.pressure * rated.shear_strength,
    )
    return Model(specimen, tuple(uses))


def free_numbers(campaign: Campaign, model: Model, objective: Objective) -> list[Free]:
    """Return what a fit of a model may change, with bounds that this campaign's strokes and gauges set.

    Raises:
        InputError: no run may be fitted.
    """
    if not objective.fitted_runs:
        raise InputError(
            "no run may be fitted: every run is held out; give one run or more the role fit in campaign.toml"
        )
    length, known = objective.scales.length, campaign.logger.known
    free = list_base_numbers(
        model, balances=objective.balanced, forces=objective.forces_measured, loads=objective.loads_measured,
        logger_known=known, length=length,
    )  # fmt: skip
    stroke = min(float(np.ptp(run.slip)) for run in objective.fitted_runs)
    most = max(_STICK_SHARE * stroke, 1e-7 * length)
    if not model.specimen.free and ZERO not in list_replaced_numbers(u.effect for u in model.uses):
        zero = free_zero(objective.fitted_runs)
        free += [zero] if zero else []
    free += [make_free_inertia(objective.specimen, key) for key in objective.inertias]
    return [
        replace(f, high=min(f.high, most), start=min(f.start, most)) if f.key == "rig.stick_length" else f for f in free
    ]


def _roughly(objective: Objective, free: list[Free], start: Mapping[str, float]) -> tuple[Objective, Solution]:
    """Fit as a beginning, from these numbers where there are any, weighed by where it begins."""
    values = {f.key: start.get(f.key, f.start) for f in free}
    objective = objective.weigh(values)
    return objective, solve(objective, values, free, most=6, enough=_TO_WEIGH)


def _fitted(campaign: Campaign, model: Model, objective: Objective, start: Mapping[str, float]) -> BaseFit:
    free = free_numbers(campaign, model, objective)
    objective, solution = _roughly(objective, free, start)
    weighed = solution.values
    for enough in _ENOUGH:
        weighed = solution.values
        objective = objective.weigh(weighed)
        solution = solve(objective, weighed, free, most=8, enough=enough, rough=_ROUGH)
    for _ in range(_MORE_ROUNDS):
        if not _resonance_moved(weighed, solution.values):
            break
        again, weighed = objective.weigh(solution.values), solution.values
        if _cost(again, weighed) > (1.0 - _LOUDER) * solution.cost:
            break
        objective = again
        solution = solve(objective, weighed, free, most=8, enough=_ENOUGH[-1], rough=_ROUGH)
    if _yaw_improves_fit(objective, solution):
        objective = objective.with_yaw()
        free = free_numbers(campaign, model, objective)  # the inertia that yaw speaks of too
        start = {**{f.key: f.start for f in free}, **solution.values}
        solution = solve(objective, start, free, most=8, enough=_ENOUGH[-1], rough=_ROUGH)
    return BaseFit(campaign, model, objective, tuple(free), solution)


def _resonance_moved(weighed: Mapping[str, float], found: Mapping[str, float]) -> bool:
    """Return whether the girder's pitch was weighed with another resonance than was found: its noise is loud there."""
    if "rig.pitch_frequency" not in found:
        return False
    frequency, damping = (found[k] / weighed[k] - 1.0 for k in ("rig.pitch_frequency", "rig.pitch_damping"))
    return abs(frequency) > _AT_REST * found["rig.pitch_damping"] or abs(damping) > _AT_REST


def refit_finally(objective: Objective, solution: Solution) -> tuple[Objective, Solution]:
    """Fit on with the laws evaluated at twice the instants, weighed anew twice, and a stick that may be damped.

    What was weighed by another law is off near reversals, where that law was wrong. A slider's fit stays as it is: its
    gauges are often so quiet that nearly all its floor is what the base law's reversals leave unsure, and another floor
    would make its error before and after two different things.
    """
    if not objective.balanced:
        return objective, solution
    objective, free, start = objective.weigh(solution.values, finer=True), list(solution.free), solution.values
    if any(f.key in DAMPED_STICK for f in free):
        scale = objective.scales
        free.append(make_stick_damping(scale.time))
        damped = {f.key: scale.of(f.unit) * DAMPED_STICK[f.key] for f in free if f.key in DAMPED_STICK}
        starts = ({**start, "rig.stick_damping": 0.0}, {**start, **damped})
        start = min(starts, key=lambda values: _cost(objective, values))
    begin = get_slopes(solution)
    # of the first fit only the numbers are kept: slopes are what takes most memory
    values = solve(objective, start, free, most=4, enough=_TO_WEIGH, rough=_MUCH_LEFT, begin=begin).values
    objective = objective.weigh(values)
    return objective, solve(objective, values, free, most=3, enough=_FINAL_REFIT, rough=_MUCH_LEFT)


def refine_base_fit(base: BaseFit) -> BaseFit:
    """Fit on as all that is reported is, see `refit_finally`."""
    objective, solution = refit_finally(base.objective, base.solution)
    return replace(base, objective=objective, free=solution.free, solution=solution)


def restart_base_fit(base: BaseFit, values: Mapping[str, float]) -> BaseFit | None:
    """Fit the base once more from where a hypothesis has led its parameters; None where that is no better.

    Args:
        base: the base fit.
        values: key -> value of the hypothesis.
    """
    start = {**base.solution.values, **{f.key: values[f.key] for f in base.free if f.key in values}}
    fall = 0.1 * _BETTER * base.solution.cost
    solution = solve(base.objective, start, base.free, most=8, enough=fall, begin=get_slopes(base.solution))
    if solution.cost > (1.0 - _BETTER) * base.solution.cost:
        return None
    objective = base.objective.weigh(solution.values)
    again = solve(objective, solution.values, base.free, most=8, enough=_ENOUGH[-1], rough=_ROUGH)
    return replace(base, objective=objective, solution=again)


def reweigh_base_fit(base: BaseFit, found: Objective, values: Mapping[str, float]) -> BaseFit | None:
    """Fit the base once more, weighed as another law has it; None where that weighs alike.

    A slider whose base law lacks what the bearing does turns its friction round more slowly than the bearing. Single
    samples beside a reversal then decide a fit: 175 floors were seen where the velocity was off by half a millimetre a
    second.

    Args:
        base: the base fit.
        found: objective of the other law, weighed as the base is.
        values: its numbers.
    """
    weighed = found.weigh(values)
    before, after = _cost(found, values), _cost(weighed, values)
    if abs(after - before) <= _WEIGHS_ALIKE * before:
        return None
    objective = weighed.having(base.objective.terms)
    solution = solve(objective, base.solution.values, base.free, most=8, enough=_ENOUGH[-1], rough=_ROUGH)
    return replace(base, objective=objective, solution=solution)


def _cost(objective: Objective, values: Mapping[str, float]) -> float:
    return objective.residuals(values, fitted_only=True).cost(objective.fitted)


def _yaw_improves_fit(objective: Objective, solution: Solution) -> bool:
    """Return whether yaw made from the measured forces improves the fit by more than its noise makes it worse."""
    if not objective.measurements.yaw_is_computable:
        return False
    left = objective.with_yaw().residuals(solution.values, fitted_only=True).cost(objective.fitted, "pads")
    return left < (1.0 - _MIN_YAW_GAIN) * solution.residuals.cost(objective.fitted, "pads")
