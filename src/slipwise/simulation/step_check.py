"""Whether a motion is long enough, and a step fine enough, for a replay that can be relied on.

Two things are asked. The energy balance closes within a hundredth of the input: it does not where a motion has a few
steps only, or a step hardly resolves it. And friction changes evenly with speed over the speeds of one step: where it
turns round, straight lines through them stand for the law (see `kernel.reversals`). What they leave out changes the
slip rate by at most about

    4 |mu(dv/2) - (mu(0) + mu(dv))/2| g dt,        dv: largest change of the slip rate in a step,

measured against integrations from event to event of laws with 20 to 1000 s/m, at 2 and 6.7 Hz
(tests/physics/test_symmetric_motion.py).
"""

import warnings

import numpy as np

from slipwise.errors import SlipwiseWarning
from slipwise.model import Model
from slipwise.simulation.kernel import ENGINES, fill, kernel
from slipwise.simulation.kernel.pads import STICK_SPEED
from slipwise.simulation.predict import user_effects
from slipwise.simulation.result import Replay

#: Largest share of the input that the energy balance may lack [1].
_ENERGY = 0.01
#: Largest error of the slip rate by one reversal, as a share of its peak [1], and what a law leaves out at most.
_RATE, _OVER = 0.005, 4.0
#: Shares of the step that are tried in search of one that would do [1].
_FINER = 0.5 ** np.arange(1, 11)


def warn_of_coarse_step(model: Model, answer: Replay, title: str) -> None:
    """Warn where a replay cannot be relied on for the sake of its motion's length or its step, with what would do.

    Args:
        model: that was shaken.
        answer: what came of it.
        title: of the motion.
    """
    lacks = answer.energy_error
    if lacks is not None and abs(lacks) > _ENERGY:
        finer = answer.dt * _ENERGY / abs(lacks)
        _warn(
            f"{title}: the energy balance of the replay lacks {abs(lacks):.1%} of the input, over {answer.steps} steps "
            f"of {answer.dt * 1e3:g} ms: the motion is too short or too coarse for them. Give a longer one, or a step "
            f"of {_rounded(finer) * 1e3:g} ms (--step)"
        )
    if (finer := _step_of_law(model, answer)) is not None:
        _warn(
            f"{title}: friction changes more over the speeds of one step ({answer.dt * 1e3:g} ms) than a replay can "
            f"follow where sliding turns round; a step of {finer * 1e3:g} ms would do (--step)"
        )


def _step_of_law(model: Model, answer: Replay) -> float | None:
    """Return a step [s] at which reversals follow the law, None where that of the replay does."""
    record = answer.record
    if not model.specimen.free or len(record.time) < 2:
        return None
    rates = np.stack([record["slip_vx"], record["slip_vy"]])
    fastest = float(np.abs(rates).max())
    changes = float(np.abs(np.diff(rates, axis=1)).max()) * answer.dt / record.dt
    for share in (1.0, *_FINER):
        if _left_out(model, share * changes) * share * answer.dt <= _RATE * fastest:
            return None if share == 1.0 else _rounded(share * answer.dt)
    return _rounded(float(_FINER[-1]) * answer.dt)


def _left_out(model: Model, change: float) -> float:
    """Return the deceleration [m/s^2] that straight lines over a change of slip rate [m/s] may be wrong by."""
    law = kernel(ENGINES[1], user_effects(model))  # three calls are not worth compiling the law by itself
    numbers, specimen = fill(law.layout, model, 1.0), model.built_specimen()
    z, load = law.layout.first_pad, specimen.weight / len(specimen.pads)
    low = 2.0 * STICK_SPEED  # below it a pad may count as sticking
    start, middle, end = (
        law.functions["pad_bound"](numbers, z, load, low + share * change, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0) / load
        for share in (0.0, 0.5, 1.0)
    )
    return _OVER * abs(middle - 0.5 * (start + end)) * specimen.gravity


def _rounded(step: float) -> float:
    """Round a step [s] down to one digit."""
    digit = 10.0 ** np.floor(np.log10(step))
    return float(np.floor(step / digit * (1.0 + 1e-9)) * digit)


def _warn(words: str) -> None:
    warnings.warn(words, SlipwiseWarning, stacklevel=4)
