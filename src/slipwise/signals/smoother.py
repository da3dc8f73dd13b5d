"""The filter and smoother of `fused`, compiled: state [x, v, b], one measurement of position and one of velocity.

Source: Rauch, Tung, Striebel (1965), AIAA Journal 3:1445-1450.
"""

import numpy as np

from slipwise.jobs.machine_code import kept


@kept()
def _predict(x, p, dt, ramp, half, drive, walk):  # pragma: no cover
    """Carry state and covariance over one step, in place."""
    x[0] += dt * x[1] - 0.5 * dt * dt * x[2] + half
    x[1] += ramp - dt * x[2]
    f01, f02, f12 = dt, -0.5 * dt * dt, -dt
    # F P
    for j in range(3):
        p[0, j] += f01 * p[1, j] + f02 * p[2, j]
        p[1, j] += f12 * p[2, j]
    # (F P) F'
    for i in range(3):
        p[i, 0] += f01 * p[i, 1] + f02 * p[i, 2]
        p[i, 1] += f12 * p[i, 2]
    t2, t3 = dt * dt, dt * dt * dt
    p[0, 0] += drive * t3 / 3.0 + walk * t3 * t2 / 20.0
    p[0, 1] += drive * t2 / 2.0 + walk * t2 * t2 / 8.0
    p[1, 0] += drive * t2 / 2.0 + walk * t2 * t2 / 8.0
    p[1, 1] += drive * dt + walk * t3 / 3.0
    p[0, 2] -= walk * t3 / 6.0
    p[2, 0] -= walk * t3 / 6.0
    p[1, 2] -= walk * t2 / 2.0
    p[2, 1] -= walk * t2 / 2.0
    p[2, 2] += walk * dt


@kept()
def _correct(x, p, row, measured, variance):  # pragma: no cover
    """Take one measurement of state `row` in, in place; give its minus twice log likelihood."""
    if np.isnan(measured):
        return 0.0
    expected = p[row, row] + variance
    surprise = measured - x[row]
    gain = p[:, row] / expected
    across = p[row, :].copy()
    for i in range(3):
        x[i] += gain[i] * surprise
        for j in range(3):
            p[i, j] -= gain[i] * across[j]
    return np.log(expected) + surprise * surprise / expected


@kept()
def unlikelihood(steps, ramp, half, place, gauge, speed, drive, walk, first, jumps):  # pragma: no cover
    """Return minus log likelihood of the measurements."""
    x = np.zeros(3)
    p = np.diag(first)
    total = 0.0
    for k in range(place.shape[0]):
        if k > 0:
            _predict(x, p, steps[k - 1], ramp[k - 1], half[k - 1], drive, walk)
            p[1, 1] += jumps[k - 1]
        cost = _correct(x, p, 0, place[k, 0], gauge) + _correct(x, p, 1, place[k, 1], speed)
        # the first samples only find the state
        if k > 3:
            total += cost
    return 0.5 * total


@kept()
def smooth(steps, ramp, half, place, gauge, speed, drive, walk, first, jumps):  # pragma: no cover
    """Filter forward and smooth backward; give the states (n, 3), the variances of position and velocity (n, 2)."""
    n = place.shape[0]
    before, after = np.zeros((n, 3)), np.zeros((n, 3))
    spread_before, spread_after = np.zeros((n, 3, 3)), np.zeros((n, 3, 3))
    x = np.zeros(3)
    p = np.diag(first)
    for k in range(n):
        if k > 0:
            _predict(x, p, steps[k - 1], ramp[k - 1], half[k - 1], drive, walk)
            p[1, 1] += jumps[k - 1]
        before[k], spread_before[k] = x, p
        _correct(x, p, 0, place[k, 0], gauge)
        _correct(x, p, 1, place[k, 1], speed)
        after[k], spread_after[k] = x, p
    variances = np.empty((n, 2))
    variances[n - 1, 0], variances[n - 1, 1] = p[0, 0], p[1, 1]
    later = p.copy()
    for k in range(n - 2, -1, -1):
        dt = steps[k]
        across = spread_after[k].copy()
        for i in range(3):
            across[i, 0] += dt * across[i, 1] - 0.5 * dt * dt * across[i, 2]
            across[i, 1] -= dt * across[i, 2]
        # C = P F' (P-)^-1
        c = np.linalg.solve(spread_before[k + 1].T, across.T).T
        after[k] += c @ (after[k + 1] - before[k + 1])
        later = spread_after[k] + c @ (later - spread_before[k + 1]) @ c.T
        variances[k, 0], variances[k, 1] = later[0, 0], later[1, 1]
    return after, variances
