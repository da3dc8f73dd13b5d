"""States that drive a law outside the catalogue: what a pad, or the middle of the pads, remembers of its way.

A reversal is told when the slip goes the other way at `REVERSAL_SPEED`, and is then dated back to when the velocity
changed its sign: a girder that shivers in its stick has not turned round. Rest between runs wipes all of it out.
"""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

#: In order of the numbers that the loop knows them by, from 1.
STATES: tuple[str, ...] = (
    *("speed", "slip", "load", "speed_rate", "load_rate", "lagged_load", "time_since_reversal"),
    *("distance_since_reversal", "last_peak_speed", "last_stroke", "heat", "outward"),
)
#: State -> its unit.
UNITS: dict[str, str] = {
    "speed": "m/s",
    "slip": "m",
    "load": "N",
    "speed_rate": "m/s^2",
    "load_rate": "N/s",
    "lagged_load": "N",
    "time_since_reversal": "s",
    "distance_since_reversal": "m",
    "last_peak_speed": "m/s",
    "last_stroke": "m",
    "heat": "J/m^2",
    "outward": "1",
}
#: Those with a time constant of their own, `law_time`.
LAGGED = ("load_rate", "lagged_load", "heat")
#: Speed at which a slip the other way counts as a reversal [m/s].
REVERSAL_SPEED = 3.0e-3
#: Speed and slip over which a sign goes from -1 to +1 [m/s, m].
_TURN, _CENTRE = 2.0e-3, 2.0e-4
_REST = 1800.0
DIRECTION, SINCE, WAY, PEAK, LAST_PEAK, LAST_STROKE, SIGN, NEW_SINCE, NEW_WAY, LAGGED_LOAD, HEAT, POWER = range(12)


def fresh_memory(load: float, pads: int = 4) -> NDArray[np.float64]:
    """Give the memories (pads + 1, 12) of the pads and of the middle after a long rest under `load` [N] each."""
    memory = np.zeros((pads + 1, 12))
    memory[:, SINCE] = memory[:, NEW_SINCE] = _REST
    memory[:, LAGGED_LOAD] = load
    return memory


@njit(cache=True)
def follow(m, vx, load, time, step):
    """Bring one memory to this instant; `time` is the constant of lag and cooling [s]."""
    sign = 1.0 if vx > 0.0 else -1.0
    way = abs(vx) * step
    m[SINCE] += step
    m[WAY] += way
    m[NEW_SINCE] += step
    m[NEW_WAY] += way
    if sign != m[SIGN]:
        m[SIGN] = sign
        m[NEW_SINCE] = 0.0
        m[NEW_WAY] = 0.0
    if sign != m[DIRECTION] and abs(vx) > REVERSAL_SPEED:
        m[LAST_PEAK] = m[PEAK]
        m[LAST_STROKE] = m[WAY] - m[NEW_WAY]
        m[DIRECTION] = sign
        m[SINCE] = m[NEW_SINCE]
        m[WAY] = m[NEW_WAY]
        m[PEAK] = 0.0
    m[PEAK] = max(m[PEAK], abs(vx))
    m[LAGGED_LOAD] += (load - m[LAGGED_LOAD]) * min(step / time, 1.0)
    m[HEAT] += step * (m[POWER] - m[HEAT] / time)


@njit(cache=True)
def direction(vx):
    """Sign of the slip velocity, soft at rest."""
    return math.tanh(vx / _TURN)


@njit(cache=True)
def state(which, m, vx, speed, place, load, acceleration, time, driver):
    """Value of state number `which` in SI units; `acceleration` is that of the slip; a driver stands behind all."""
    if which == 1:
        return speed
    if which == 2:
        return place
    if which == 3:
        return load
    if which == 4:
        return acceleration * direction(vx)
    if which == 5:
        return (load - m[LAGGED_LOAD]) / time
    if which == 6:
        return m[LAGGED_LOAD]
    if which == 7:
        return m[SINCE]
    if which == 8:
        return m[WAY]
    if which == 9:
        return m[LAST_PEAK]
    if which == 10:
        return m[LAST_STROKE]
    if which == 11:
        return m[HEAT]
    if which == 12:
        return math.tanh(place / _CENTRE) * direction(vx)
    return driver
