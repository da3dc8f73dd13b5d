"""The verb of this package: replay a table motion on a model."""

from collections.abc import Callable, Sequence
from pathlib import Path

from slipwise.model import Model
from slipwise.model.file import as_model
from slipwise.motion.load import as_motion
from slipwise.motion.resample import resample
from slipwise.motion.table_motion import TableMotion
from slipwise.simulation.simulator import DT, OUTPUT_DT, Memory, Replay, simulate
from slipwise.simulation.step_check import warn_of_coarse_step


def replay(
    model: Model | Path | str,
    motion: TableMotion | str | Path | Sequence[str | Path],
    *,
    dt: float = DT,
    output_dt: float = OUTPUT_DT,
    engine: str = "compiled",
    start: Memory | None = None,
    rest: float = 0.0,
    progress: Callable[[float], None] | None = None,
) -> Replay:
    """Shake a model with a table motion.

    Args:
        model: specimen and effects; or a model.toml; or a rig, which is replayed with the paper's law.
        motion: of the table, or what `load_motion` makes one of; it is resampled to the step without aliasing or
            phase shift.
        dt: step [s].
        output_dt: step of the record [s], a multiple of dt.
        engine: "compiled" or "python" (the same law, to step through with a debugger).
        start: what pads and buffers remember from the run before.
        rest: pause since that run, or since the girder was put on its pads [s].
        progress: called with the fraction done.

    Raises:
        SettingError: settings that cannot go together; the message says what is possible.
        SimulationDiverged: the simulation left every bound; the error holds the record so far.
    """
    model = as_model(model)
    fitted = resample(as_motion(motion), dt)
    answer = simulate(
        model,
        fitted.acceleration,
        dt=dt,
        output_dt=output_dt,
        engine=engine,
        start=start,
        rest=rest,
        provenance={"motion": dict(fitted.about())},
        progress=progress,
    )
    warn_of_coarse_step(model, answer, fitted.title)
    return answer
