"""What an engineer reads off: a run replayed in MuJoCo, and the error of such replays."""

import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from slipwise.comparison.measured_replay import choose_simulation_step, get_measured_motion
from slipwise.comparison.system_level import build_replayed_model, compare_system_level, pool_system_errors
from slipwise.errors import InputError, SettingError
from slipwise.record import Record
from slipwise.selection.importance import compute_memory_before
from slipwise.session.evaluation import Evaluator
from slipwise.session.state import SessionState
from slipwise.short_repr import short_repr
from slipwise.simulation.replay import replay

#: What is read off -> SI unit; of a measurement also, but for the time that no pad's cell can tell.
RESPONSES: dict[str, str] = {"peak_slip": "m", "energy": "J", "largest_load": "N", "uplift": "s"}
#: Of the noise that a replay is given beside [1].
_SEED = 1


@short_repr
@dataclass(frozen=True)
class RunReplay:
    """A run driven by the table's measured motion alone.

    Attributes:
        run: name.
        record: what the model answers, at the instants of the measurement.
        responses: name of `RESPONSES` -> value [SI].
        measured: the same of the measurement, as far as it can be told.
    """

    run: str
    record: Record
    responses: dict[str, float]
    measured: dict[str, float]


def replayed_run(ready: Evaluator) -> str:
    """Return the name of the run that is replayed unless another is named: the first held out, else the last."""
    return next((r.name for r in ready.runs if r.role == "holdout"), ready.runs[-1].name)


def replay_errors(
    ready: Evaluator, state: SessionState, progress: Callable[[float], None] | None = None
) -> dict[str, float]:
    """Return the errors at system level, of held-out runs if there are any: channels -> error in floors.

    Replays restart from the measured slip every second, and their floor has the noise of what they are fed with in it.

    Args:
        ready: the campaign.
        state: whose model.
        progress: called with the share done; what it raises ends the work.

    Raises:
        InputError: the slip is prescribed, or the table's motion was not recorded.
    """
    _check_free(ready)
    errors = compare_system_level(ready.as_fit(state), np.random.default_rng(_SEED), progress).errors
    held = any(e.role == "holdout" for e in errors)
    names = dict.fromkeys(re.sub(r"^pad_[^_]+_", "pad_*_", e.channel) for e in errors)
    found = {name: pool_system_errors(errors, name, held_out=held) for name in names}
    return {name: error for name, error in found.items() if error is not None}


def replay_run(ready: Evaluator, state: SessionState, name: str = "") -> RunReplay:
    """Replay a run, memory carried over from those before.

    Args:
        ready: the campaign.
        state: whose model.
        name: of the run; `replayed_run` if not given.

    Raises:
        SettingError: no such run.
        InputError: the slip is prescribed, or the table's motion was not recorded.
    """
    name = name or replayed_run(ready)
    _check_free(ready)
    fit = ready.as_fit(state)
    model, _ = build_replayed_model(fit)
    names = fit.objective.run_names
    if name not in names:
        raise SettingError(f"no run {name!r}; runs: {', '.join(names)}")
    place = names.index(name)
    run = fit.objective.run(place)
    answer = replay(
        model,
        get_measured_motion(run.states),
        dt=choose_simulation_step(run.dt, model.built_specimen()),
        output_dt=run.dt,
        start=compute_memory_before(model, fit.objective.runs_before(place)),
        rest=run.rest_before,
    )
    responses = {
        "peak_slip": answer.largest_slip,
        "energy": sum(answer.pad_energy.values()),
        "largest_load": max(high for _, high in answer.load_range.values()),
        "uplift": answer.uplift,
    }
    measured = {
        "peak_slip": float(np.max(np.hypot(*run.states.slip.T))),
        "energy": float(np.sum(run.force * run.velocity[:, None]) * run.dt) if run.forces_measured else float("nan"),
        "largest_load": float(np.nanmax(run.load)),
    }
    return RunReplay(run.name, answer.record, responses, measured)


def _check_free(ready: Evaluator) -> None:
    if not ready.model.specimen.free:
        raise InputError("the slip of this rig is prescribed: there is nothing to replay")
