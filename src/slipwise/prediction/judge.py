"""The verb: read another program's model back from its output, and say what a campaign shows of it."""

import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign, as_campaign
from slipwise.comparison.component_level import NAMES
from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.result import Diagnosis
from slipwise.effects import Effect, base_effects
from slipwise.errors import InputError
from slipwise.estimation.base_fit import BaseFit, fit_base
from slipwise.estimation.intervals import Interval, compute_intervals
from slipwise.estimation.objective import Objective
from slipwise.evidence.acceptance import LEAST
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.model import Model
from slipwise.model.file import as_model
from slipwise.noise.level import is_at_floor
from slipwise.prediction.compare_runs import compare_runs
from slipwise.prediction.friction_families import (
    ReadLaw,
    Sliding,
    collect_sliding,
    fit_families,
    plainest_law,
)
from slipwise.prediction.law_model import model_of_law
from slipwise.prediction.predicted_campaign import load_predicted
from slipwise.prediction.result import RUNGS, ComparedNumber, ComparedRun, PredictionReport
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import Prepared

#: Numbers of a rig that another program states too.
_STATED = ("rig.mass", "rig.centre_height", "rig.buffer_stiffness", "rig.pitch_frequency")
#: Loads that change by less than this share of themselves do not vary [1]; so do those of a model that change by less
#: than this share of what was measured.
_VARIES, _OF_MEASURED = 0.01, 0.2


@one_thread_algebra()
def judge_prediction(
    campaign: Campaign | Path | str,
    predicted: Path | str,
    model: Model | Path | str | None = None,
    *,
    own: Iterable[Effect] = (),
    system: bool = False,
    found: Diagnosis | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> PredictionReport:
    """Say what a campaign shows of the model by which another program predicted it.

    The law of friction is read from the predicted forces, everything else by a diagnosis of the prediction as if the
    campaign's gauges had recorded it. Then the measured campaign is diagnosed, and both are held against each other.

    Args:
        campaign: or its folder.
        predicted: folder with a file for each run, and a campaign.toml where columns need one.
        model: where the diagnosis of the measured campaign starts, see `diagnose`.
        own: effects beside those of the catalogue, for that diagnosis.
        system: replay, in that diagnosis.
        found: that diagnosis, where it was made already: a campaign says the same of all who predicted it.
        progress: called with what is being done and the share done.

    Raises:
        InputError: the prediction cannot be read, the slip of the rig is prescribed, or the campaign lacks what every
            fit needs.
    """
    began = time.perf_counter()
    tell = progress or (lambda words, share: None)
    tell("reading", 0.0)
    measured = as_campaign(campaign)
    if not measured.specimen.free:
        raise InputError(
            f"{measured.name}: the slip of rig {measured.rig!r} is prescribed, so there is no motion to predict"
        )
    given = load_predicted(predicted, measured)
    areas = dict(zip(measured.specimen.pads, measured.specimen.pad_areas, strict=True))
    samples = collect_sliding(given.exact.runs, areas)
    law = plainest_law(fit_families(samples))
    structure = model_of_law(law, measured.specimen, float(samples.rest.mean()))
    read = diagnose(
        given.recorded, structure, progress=lambda words, share: tell(f"their model: {words}", 0.45 * share)
    )
    prepared = prepare(measured)
    start = None if model is None else as_model(model)
    found = found or diagnose(
        prepared, start, own=own, system=system,
        progress=lambda words, share: tell(f"the campaign: {words}", 0.45 + 0.45 * share),
    )  # fmt: skip
    tell("their model on the measured states", 0.92)
    theirs = {**read.final.solution.values}
    base = _fit_their_model(prepared, read, structure)
    runs = compare_runs(measured, given.exact, prepared.uncut)
    own_law = _law_of_campaign(found)
    lacks = _lacks(law, own_law, runs, read, found)
    numbers = _numbers(theirs, found, law, own_law, samples)
    tell("done", 1.0)
    return PredictionReport(
        campaign=measured.name,
        law=law,
        effects=_physical(read),
        loads=_loads(law, runs),
        lacks=lacks,
        surplus=tuple(name for name in _physical(read) if name not in (*found.added, *found.verdict.minor)),
        numbers=numbers,
        runs=runs,
        errors=_errors(base, theirs, found),
        beyond=_beyond(base, law, lacks, found),
        notes=given.notes,
        read=read,
        found=found,
        seconds=time.perf_counter() - began,
    )


def _physical(found: Diagnosis) -> tuple[str, ...]:
    """Return the effects that were added and are no fault of a gauge."""
    gauges = {t.effect.name for t in found.search.final.terms if t.effect.port == "gauge"}
    return tuple(name for name in found.added if name not in gauges)


def _fit_their_model(prepared: Prepared, read: Diagnosis, structure: Model) -> BaseFit:
    """Fit the model that was read back to the measured campaign: its law, and the effects that it holds."""
    known = _physical(read)
    fitted = [u for u in read.model.uses if u.effect.name in known]
    model = Model(structure.specimen, (*structure.uses, *fitted))
    return fit_base(prepared.campaign, prepared.on_rig(model), prepared.invalid, prepared.start)


def _errors(base: BaseFit, theirs: Mapping[str, float], found: Diagnosis) -> dict[str, dict[str, float]]:
    """Return the error of every relation, held out where runs are, with their numbers, with fitted ones, completed."""
    mine = {f.key for f in base.free if _is_of_model(f.key)}
    as_it_is = {**base.solution.values, **{key: theirs[key] for key in mine if key in theirs}}
    rungs = (
        _levels(base.objective, as_it_is),
        _levels(base.objective, base.solution.values),
        {relation: after for relation, (_, after) in found.relations.items()},
    )
    return dict(zip(RUNGS, rungs, strict=True))


def _is_of_model(key: str) -> bool:
    """Return whether a number is a program's to state: no lag of a gauge's card, and no stick of a few micrometres."""
    return key in (*_STATED, "rig.shear_strength") or not key.startswith("rig.")


def _levels(objective: Objective, values: Mapping[str, float]) -> dict[str, float]:
    left = objective.residuals(values)
    runs = objective.held_out or objective.fitted
    return {r: left.level(r, runs) for r in objective.relations if left.count(r, runs)}


def _law_of_campaign(found: Diagnosis) -> ReadLaw:
    """Return the law of friction that the measured campaign shows: the pads' model, at its own states."""
    objective, values = found.final.objective, found.final.solution.values
    predicted = objective.residuals(values).pad_forces
    area = objective.specimen.pad_area
    parts = []
    for place in objective.fitted:
        run = objective.run(place)
        speed, force = np.abs(run.states.velocity[:, :1]), np.abs(predicted[place])
        kept = run.judged["pads"].reshape(len(run.time), -1).any(axis=1) & ~run.states.near_reversal & ~run.states.stuck
        load = run.load
        rest = np.broadcast_to(np.median(load[: max(len(load) // 50, 1)], axis=0), load.shape)
        columns = [np.broadcast_to(speed, load.shape), load, rest, np.full(load.shape, area), force]
        parts.append([column[kept].ravel() for column in columns])
    joined = [np.concatenate(column) for column in zip(*parts, strict=True)]
    return plainest_law(fit_families(Sliding(*joined)))


def _lacks(
    law: ReadLaw, measured: ReadLaw, runs: tuple[ComparedRun, ...], read: Diagnosis, found: Diagnosis
) -> dict[str, str]:
    """Return what the model lacks, each with the reason."""
    out: dict[str, str] = {}
    one, other = law.family, measured.family
    if other.follows_load and not one.follows_load:
        out["friction that follows the load"] = (
            "its friction sees a constant load, that of the test the load of the moment"
        )
    if _are_constant(runs):
        out["loads that vary"] = "its pads carry nearly the same all the time, those of the test do not"
    if other.with_speed and not one.with_speed:
        out["speed dependence"] = "its friction is the same at all speeds, that of the test grows with speed"
    if other.with_pressure and not one.with_pressure and one.follows_load:
        out["pressure dependence"] = (
            "its coefficient is the same at all pressures, that of the test falls with pressure"
        )
    named = found.verdict.effects if found.verdict.kind in ("named", "ambiguous", "unknown") else ()
    for name in named:
        if name in _physical(found) and name not in _physical(read):
            out[name] = "the campaign shows it, the prediction does not"
    return out


def _are_constant(runs: tuple[ComparedRun, ...]) -> bool:
    changes = np.array([run.load_change for run in runs if np.isfinite(run.load_change).all()])
    if not len(changes):
        return False
    measured, predicted = changes.max(axis=0)
    return bool(measured > _VARIES and predicted < max(_OF_MEASURED * measured, 0.1 * _VARIES))


def _loads(law: ReadLaw, runs: tuple[ComparedRun, ...]) -> str:
    changes = [run.load_change for run in runs if np.isfinite(run.load_change).all()]
    if not changes:
        return "The prediction has no loads of pads."
    measured, predicted = (max(pair[k] for pair in changes) for k in (0, 1))
    follows = "friction follows the load" if law.family.follows_load else "friction sees a constant load"
    if predicted < _VARIES:
        follows = "whether friction would follow them nobody can see"
    return f"Its loads change by {100 * predicted:.3g} % (rms), those of the test by {100 * measured:.3g} %; {follows}."


def _numbers(
    theirs: Mapping[str, float], found: Diagnosis, law: ReadLaw, measured: ReadLaw, samples: Sliding
) -> tuple[ComparedNumber, ...]:
    """Return the numbers that both have, and friction at the test's typical speed and the load at rest."""
    base = found.final
    intervals: dict[str, Interval] = {entry.key: entry for entry in compute_intervals(base).entries}
    out = [_friction(law, measured, samples, base.campaign.materiality.channel)]
    same_law, laws = law.family.name == measured.family.name, {effect.name for effect in base_effects("law")}
    for key, entry in intervals.items():
        of_law = key.partition(".")[0] in laws
        if key not in theirs or not _is_of_model(key) or (of_law and not same_law) or key == "rig.shear_strength":
            continue
        costs = _costs(base, key, theirs[key])
        outside = not entry.low <= theirs[key] <= entry.high
        ends = (entry.low, entry.high) if np.isfinite([entry.low, entry.high]).all() else (None, None)
        off = bool(outside and ends[0] is not None and costs > LEAST.everywhere and not of_law)
        out.append(ComparedNumber(key, theirs[key], entry.value, *ends, entry.unit, costs, off))
    return tuple(out)


def _costs(base: BaseFit, key: str, value: float) -> float:
    """Return the mean squared residual that another value of a number adds where it adds most [noise variance]."""
    objective = base.objective
    before = base.solution.residuals
    after = objective.residuals({**base.solution.values, key: value}, fitted_only=True)
    runs = objective.fitted
    return max(
        (after.mean_square(r, runs) - before.mean_square(r, runs) for r in before.relations if before.count(r, runs)),
        default=0.0,
    )


def _friction(law: ReadLaw, measured: ReadLaw, samples: Sliding, limit: float) -> ComparedNumber:
    """Return the coefficient of friction of both, mean over the samples of the prediction."""
    mine, own = (
        float(np.mean(one.family.law(samples, list(one.numbers.values())) / samples.load)) for one in (law, measured)
    )
    return ComparedNumber("friction", mine, own, None, None, "1", 0.0, abs(mine / own - 1.0) > limit)


def _beyond(base: BaseFit, law: ReadLaw, lacks: Mapping[str, str], found: Diagnosis) -> tuple[str, ...]:
    """Say what no number of the model mends, and what the campaign itself leaves open."""
    out = []
    left = {r: e for r, e in _levels(base.objective, base.solution.values).items() if not is_at_floor(e)}
    if left and lacks:
        worst = ", ".join(
            f"{NAMES[name][0]} {error:.2g}" for name, error in sorted(left.items(), key=lambda pair: -pair[1])
        )
        out.append(f"With the best numbers that it can have, it still errs, in noise floors, by: {worst}.")
    if law.is_foreign:
        out.append(
            f"Its law of friction is none of those that are known here: the nearest leaves {100 * law.left:.0f} %."
        )
    if found.verdict.kind == "unknown" or found.verdict.leftover == "unknown":
        out.append(f"What the catalogue does not explain either: {found.left_over}.")
    return tuple(out)
