"""A small building on linear isolators, shaken: motions by scipy's exact solution of its linear equations."""

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter, lsim, sosfilt

#: Base and three floors [kg], the isolators and the three storeys under them [N/m], damping in proportion to them [s].
MASSES = np.array([12e3, 8e3, 9e3, 7e3])
STIFFNESSES = np.array([0.4e6, 9e6, 8e6, 7e6])
SHARES = np.array([0.09, 0.004, 0.004, 0.004])
STEP, SAMPLES = 0.005, 4000


@dataclass(frozen=True)
class Shaken:
    """One run, each (n,): absolute accelerations, the table's displacement, and displacements from the table."""

    time: NDArray[np.float64]
    table: NDArray[np.float64]
    levels: NDArray[np.float64]
    table_moved: NDArray[np.float64]
    drifts: NDArray[np.float64]


@cache
def shaken(seed: int) -> Shaken:
    """Return the building's answer to a table that shakes at random; gauges of acceleration have 2 mm/s^2 of noise."""
    rng = np.random.default_rng(seed)
    time = STEP * np.arange(SAMPLES)
    envelope = np.exp(-(((time - 7.0) / 3.0) ** 2))
    white = envelope * rng.standard_normal(SAMPLES)
    table = sosfilt(butter(2, [0.5, 8.0], "bandpass", fs=1.0 / STEP, output="sos"), white)
    table *= 3.0 / np.abs(table).max()
    moved = np.cumsum(np.cumsum(table)) * STEP**2
    moved = np.append(0.0, moved[:-1])  # a sum of sums is a sample early
    moved -= np.polyval(np.polyfit(time, moved, 1), time)
    count = len(MASSES)
    stiffness = np.diag(STIFFNESSES + np.append(STIFFNESSES[1:], 0.0))
    damping = np.diag(SHARES * STIFFNESSES + np.append(SHARES[1:] * STIFFNESSES[1:], 0.0))
    for i in range(1, count):
        stiffness[i, i - 1] = stiffness[i - 1, i] = -STIFFNESSES[i]
        damping[i, i - 1] = damping[i - 1, i] = -SHARES[i] * STIFFNESSES[i]
    over = 1.0 / MASSES[:, None]
    system = np.block([[np.zeros((count, count)), np.eye(count)], [-over * stiffness, -over * damping]])
    driven = np.concatenate([np.zeros((count, 1)), -np.ones((count, 1))])
    _, _, states = lsim((system, driven, np.eye(2 * count), np.zeros((2 * count, 1))), table, time)
    absolute = states @ system[count:].T
    noise = 2e-3 * rng.standard_normal((SAMPLES, count + 1))
    return Shaken(time, table + noise[:, 0], (absolute + noise[:, 1:]).T, moved, states[:, :count].T)


def channels(seed: int) -> dict[str, NDArray[np.float64]]:
    """Return a run by the names of its channels, displacements with 20 um of noise."""
    run, rng = shaken(seed), np.random.default_rng(100 + seed)
    places = ["girder", "storey_1", "storey_2", "storey_3"]

    def gauge(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return values + 2e-5 * rng.standard_normal(len(values))

    return {
        "time": run.time,
        "table_ax": run.table,
        **{f"{place}_ax": values for place, values in zip(places, run.levels, strict=True)},
        "table_dx": gauge(run.table_moved),
        "slip_x": gauge(run.drifts[0]),
        **{f"{place}_dx": gauge(values) for place, values in zip(places[1:], run.drifts[1:], strict=True)},
    }
