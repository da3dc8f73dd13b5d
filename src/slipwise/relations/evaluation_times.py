"""The states of the pads at the instants at which their laws are evaluated."""

from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.relations.run_data import FitRun, interpolate_finely
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class Instants:
    """States of one run at the instants at which the laws are evaluated: f = fine (n - 1) + 1 for n samples.

    Attributes:
        time: (f,) [s].
        load: (f, p) [N].
        velocity: (f, p, 2) [m/s].
        slip: (f, p, 2) [m].
    """

    time: Array
    load: Array
    velocity: Array
    slip: Array


#: Error of a cubic through four neighbours in the middle between two samples, over the fourth difference [1].
_ERROR_OF_CUBIC = 3.0 / 128.0


def evaluate_states_at_instants(
    run: FitRun, velocity: Array, slip: Array, lost: Array | None = None, place_errors: float = 0.0
) -> Instants:
    """Refine the states of a run.

    Args:
        run: its loads and times, and where it is at rest.
        velocity: (n, p, 2) of each pad, or (n, 1, 2) where all move alike [m/s].
        slip: (n, p, 2) of each pad, or (n, 1, 2) [m].
        lost: (f, p) or (f, 1) what the logger's filter took from the velocity, see `estimate_lost_velocity` [m/s].
        place_errors: number of errors of interpolation that are added to the slip along x between samples [1].
    """
    time = np.linspace(run.time[0], run.time[-1], run.fine * (len(run.time) - 1) + 1)
    fine = interpolate_finely(velocity, run.fine)
    if lost is not None:
        fine[:, :, 0] += lost
    still = np.repeat(run.states.at_rest, run.fine)[: len(time)]
    fine[still & np.roll(still, 1 - run.fine)] = 0.0
    every = (*run.fine_load.shape, 2)  # views: a long record's states of pads that move alike are kept once
    between = interpolate_finely(slip, run.fine)
    if place_errors and run.states.position_error:
        between[:, :, 0] += place_errors * _compute_errors_between_samples(run)[:, None]
    fine, slip = (np.broadcast_to(x, every) for x in (fine, between))
    return Instants(time, run.fine_load, fine, slip)


def _compute_errors_between_samples(run: FitRun) -> Array:
    """Return by how much the interpolated slip may err at every instant (f,) [m]; nothing at the samples themselves."""
    fourth = np.zeros(len(run.slip))
    fourth[2:-2] = np.abs(np.diff(run.slip, 4))
    share = np.arange(run.fine) / run.fine
    of_step = _ERROR_OF_CUBIC * np.maximum(fourth[:-1], fourth[1:])[:, None] * (4.0 * share * (1.0 - share))
    return np.append(of_step.ravel(), 0.0)
