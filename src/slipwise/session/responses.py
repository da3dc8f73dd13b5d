"""What an engineer reads off: the held-out run replayed in MuJoCo, with an effect and without it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.comparison.measured_replay import measured_motion, simulation_step
from slipwise.comparison.system_level import replayed_model
from slipwise.diagnosis.importance import memory_before
from slipwise.errors import InputError
from slipwise.record import Record
from slipwise.session.evaluation import Evaluator
from slipwise.session.state import State
from slipwise.simulation.replay import replay

Array = NDArray[np.float64]
#: What is read off -> SI unit; of a measurement also, but for the time that no pad's cell can tell.
RESPONSES: dict[str, str] = {"peak_slip": "m", "energy": "J", "largest_load": "N", "uplift": "s"}


@dataclass(frozen=True)
class HeldOutReplay:
    """A run that no fit has seen, driven by the table's measured motion alone.

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


def replay_held_out(ready: Evaluator, state: State) -> HeldOutReplay:
    """Replay the first held-out run (the last one where none is held out), memory carried over from those before.

    Raises:
        InputError: the slip is prescribed, or the table's motion was not recorded.
    """
    if not ready.model.specimen.free:
        raise InputError("the slip of this rig is prescribed: there is nothing to replay")
    fit = ready.as_fit(state)
    model, _ = replayed_model(fit)
    runs = fit.problem.runs
    place = (fit.problem.held_out or [len(runs) - 1])[0]
    run = runs[place]
    answer = replay(
        model,
        measured_motion(run.states),
        dt=simulation_step(run.dt),
        output_dt=run.dt,
        start=memory_before(model, runs[:place]),
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
        "energy": float(np.sum(run.force * run.velocity[:, None]) * run.dt),
        "largest_load": float(np.nanmax(run.load)),
    }
    return HeldOutReplay(run.name, answer.record, responses, measured)
