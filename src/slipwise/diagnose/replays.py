"""Free replays of a held-out run: the measurement, the model before and the model after, for the viewer."""

import numpy as np

from slipwise.campaign import measured_states
from slipwise.compare.system_level import replayed_model
from slipwise.diagnose.result import Diagnosis
from slipwise.fit.base import BaseFit
from slipwise.model import Model
from slipwise.record import Record
from slipwise.replay import DT, replay
from slipwise.system import measured_motion


def replays(found: Diagnosis) -> tuple[Record, list[tuple[str, Record]]]:
    """Replay the first held-out run (or the first run) from its measured table motion.

    Gauges are left out: the viewer shows what the rig does.

    Returns:
        The measured record, and label and record of the base model and, if anything was named, of the final one.

    Raises:
        InputError: the table's motion was not recorded.
    """
    campaign = found.final.campaign
    run = next((r for r in campaign.runs if r.role == "holdout"), campaign.runs[0])
    states = measured_states(run, campaign)
    motion = measured_motion(states)
    models = [("base model", found.search.base)]
    if found.final is not found.search.base:
        models.append((f"with {' and '.join(found.search.best.names)}", found.final))
    dt = simulation_step(states.dt)
    return states.record, [
        (label, replay(_mechanics(fit), motion, dt=dt, output_dt=states.dt).record) for label, fit in models
    ]


def simulation_step(sampling: float) -> float:
    """Give the step of a simulation, the usual one at most, of which the step of a record is a multiple, both [s]."""
    # a step that was read from a file's times is off by rounding
    return sampling / float(np.ceil(sampling / DT * (1.0 - 1e-9)))


def _mechanics(fit: BaseFit) -> Model:
    model, _ = replayed_model(fit)
    gauges = [u.label for u in model.on_port("gauge")]
    return model.without(*gauges)
