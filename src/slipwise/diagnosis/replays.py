"""Free replays of models before and after: for the viewer, and their errors."""

import dataclasses
from collections.abc import Callable, Collection, Sequence

import numpy as np

from slipwise.campaign import measured_states
from slipwise.comparison.measured_replay import choose_simulation_step, get_measured_motion
from slipwise.comparison.system_level import SEED, build_replayed_model, compare_system_level
from slipwise.estimation.base_fit import BaseFit
from slipwise.jobs.parallel import on_every_core
from slipwise.model import Model
from slipwise.record import Record
from slipwise.simulation.replay import replay


def replays(base: BaseFit, final: BaseFit, added: Sequence[str]) -> tuple[Record, list[tuple[str, Record]]]:
    """Replay the first held-out run (or the first run) from its measured table motion.

    Gauges are left out: the viewer shows what the rig does.

    Args:
        base: the fit before.
        final: the fit after.
        added: names of what it has beside the base's.

    Returns:
        The measured record, and label and record of the base model and, if anything was named, of the final one.

    Raises:
        InputError: the table's motion was not recorded.
    """
    campaign = final.campaign
    run = next((r for r in campaign.runs if r.role == "holdout"), campaign.runs[0])
    states = measured_states(run, campaign)
    motion = get_measured_motion(states)
    models = [("base model", base)]
    if added:
        models.append((f"with {' and '.join(added)}", final))

    def shake(model: Model) -> Record:
        dt = choose_simulation_step(states.dt, model.built_specimen())
        shaken = replay(model, motion, dt=dt, output_dt=states.dt).record
        since = states.record.time[0] - shaken.time[0]  # a record that was cut out of a longer one begins late
        return dataclasses.replace(shaken, time=shaken.time + since)

    return states.record, [(label, shake(_mechanics(fit))) for label, fit in models]


def replayed_errors(
    fits: Sequence[BaseFit], roles: Collection[str], progress: Callable[[float], None] | None = None
) -> list[float]:
    """Return error of the replay of every fit over slip and pad forces, in floors; NaN without a run of these roles.

    Args:
        fits: whose models are replayed.
        roles: of the runs that count: "fit", "repeat", "holdout".
        progress: called with the share done.

    Raises:
        InputError: the table's motion was not recorded.
    """

    def error_of(place: int) -> float:
        level = compare_system_level(fits[place], np.random.default_rng(SEED))
        counted = [e for e in level.errors if e.role in roles and (e.channel == "slip_x" or "_Fx" in e.channel)]
        return float(np.sqrt(np.mean([e.error**2 for e in counted]))) if counted else float("nan")

    out: list[float] = []
    for error in on_every_core(error_of, len(fits)):
        out.append(error)
        if progress:
            progress(len(out) / len(fits))
    return out


def _mechanics(fit: BaseFit) -> Model:
    model, _ = build_replayed_model(fit)
    gauges = [u.label for u in model.on_port("gauge")]
    return model.without(*gauges)
