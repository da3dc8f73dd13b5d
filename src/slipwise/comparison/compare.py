"""Hold a model against a campaign: fit its base parameters, tell its error at two levels, and where it lies."""

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign
from slipwise.comparison.cells import correct_for_many_tests, gather, judge_cells
from slipwise.comparison.component_level import compute_component_errors, compute_repeat_errors
from slipwise.comparison.friction_surface import compute_friction_surface
from slipwise.comparison.isolation_layer import describe_isolation_layer
from slipwise.comparison.motion_states import classify_motion_states
from slipwise.comparison.odd_even import split_odd_and_even
from slipwise.comparison.patterns import find_patterns
from slipwise.comparison.result import Comparison
from slipwise.comparison.sentences import describe_places
from slipwise.comparison.system_level import SEED, SystemLevel, compare_system_level
from slipwise.errors import InputError
from slipwise.estimation.base_fit import BaseFit
from slipwise.estimation.intervals import compute_intervals
from slipwise.estimation.prediction_interval import predict_friction
from slipwise.instruments.checks import Checks, check_instruments
from slipwise.jobs.parallel import one_thread_algebra
from slipwise.model import Model
from slipwise.model.file import as_model
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import Prepared, fit_prepared
from slipwise.relations.girder import list_balances
from slipwise.relations.untold_forces import list_untold_forces


@one_thread_algebra()
def compare(
    campaign: Campaign | Path | str | Prepared,
    model: Model | Path | str | None = None,
    *,
    system: bool = True,
    checks: Checks | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> Comparison:
    """Hold a model against a campaign.

    Base parameters are fitted on the runs of role fit and repeat; held-out runs are only looked at.

    Args:
        campaign: or its folder; one that is prepared is not prepared again.
        model: the user's current model, or its model.toml; the paper's law on the campaign's rig when not given.
        system: replay the runs as well.
        checks: the audit of the instruments, where it was made already.
        progress: called with what is being done and the fraction done.

    Raises:
        InputError: the campaign lacks what every comparison needs.
    """
    began = time.perf_counter()
    tell = progress or (lambda words, done: None)
    tell("reading", 0.0)
    prepared = prepare(campaign)
    campaign = prepared.campaign
    start = None if model is None else as_model(model)
    tell("auditing the instruments", 0.05)
    checks = checks or check_instruments(prepared)
    tell("fitting base parameters", 0.25)
    base = fit_prepared(prepared, start, finely=True)
    tell("locating errors", 0.5)
    residuals = {r: list(base.solution.residuals.of(r)) for r in base.objective.relations}
    components = compute_component_errors(base)
    motions = [classify_motion_states(run) for run in base.objective.runs]
    area = base.objective.specimen.pad_area
    samples = {
        r: gather(base.solution.residuals.blocks(r), base.objective.runs, motions, area)
        for r, parts in residuals.items()
        if any(np.any(p) for p in parts)
    }
    cells = correct_for_many_tests(cell for one in samples.values() for cell in judge_cells(one))
    parities = {r: found for r, one in samples.items() if (found := split_odd_and_even(one)) is not None}
    patterns = tuple(pattern for one in samples.values() for pattern in find_patterns(one))
    errors = {r: float(np.sqrt(one.squared.mean())) for r, one in samples.items()}
    found = compute_intervals(base)
    tell("drawing the friction surface", 0.6)
    friction = compute_friction_surface(base, found)
    cannot = _cannot(base)
    level: SystemLevel | None = None
    if system:
        tell("replaying", 0.65)
        try:
            if not campaign.specimen.free:
                raise InputError("the slip of this rig is prescribed: there is nothing to replay")
            rng = np.random.default_rng(SEED)
            level = compare_system_level(base, rng, lambda done: tell("replaying", 0.65 + 0.35 * done))
        except InputError as error:
            cannot.append(f"system level: {error}")
    tell("done", 1.0)
    return Comparison(
        campaign=campaign,
        model=base.objective.model(base.solution.values),
        base=base,
        corrections=prepared.corrections,
        checks=checks,
        residuals=residuals,
        components=components,
        repeats=compute_repeat_errors(base),
        system=level,
        intervals=found,
        surface=friction,
        layer=describe_isolation_layer(base),
        predicted_friction=predict_friction(base),
        cells=cells,
        patterns=patterns,
        parities=parities,
        places=describe_places(cells, patterns, parities, errors),
        cannot=(*cannot, *(f"audit: {words}" for words in checks.cannot)),
        notes=tuple(dict.fromkeys([*campaign.notes, *(level.notes if level else ())])),
        seconds=time.perf_counter() - began,
    )


def _cannot(base: BaseFit) -> list[str]:
    """Say in words what the channels do not allow."""
    objective = base.objective
    out = []
    if not objective.specimen.free:
        out.append("balances of girder, heave, pitch, roll and warp: the slip of this rig is prescribed")
    else:
        absent = [b for b in list_balances(objective.specimen) if b not in objective.relations]
        out += [f"{b} balance: a channel that it needs is missing" for b in absent]
    out += [f"{name}: {reason}" for name, reason in list_untold_forces(objective.measurements)]
    if not objective.held_out:
        out.append("held-out error: no run has the role holdout; errors are those of the fitted runs")
    if not any(run.role == "repeat" for run in objective.runs):
        out.append("floor from repeated runs: no run has the role repeat; the floor is that of the gauges' noise")
    missing = [words for run in objective.runs for words in run.states.missing]
    return [*out, *dict.fromkeys(missing)]
