"""Drivers that no channel and no state tells: time of day, chance, and bodies beside the rig."""

import math

import numpy as np
from numba import njit

from slipwise_benchmarks.law_states import STATES

#: In order of the numbers that the loop knows them by, after those of the states.
DRIVERS: tuple[str, ...] = ("time_of_day", "random_process", "separate_body", "swinging_body")
MEMORY = 3
_WAVES = 6
_TIME_OF_DAY, _RANDOM, _BODY, _SWINGING = (len(STATES) + number for number in range(1, len(DRIVERS) + 1))
#: Square of vertical acceleration that keeps the separate body at 1 [m^2/s^4], and what swings the other one to 1 [m].
_WARMING, _SWING = 1.0, 5.0e-3


def fresh_driver() -> np.ndarray:
    """Give the memory (3,) of bodies beside the rig, cold and at rest: warmth, place and speed."""
    return np.zeros(MEMORY)


@njit(cache=True)
def hidden_driver(p, m, time, az, step):
    """Value of the driver at this instant, of the order of 1.

    Time of day: a sine of period `law_scale` of the clock. Random process: six sines of periods that have no common
    multiple, from `law_scale` down, with phases that `law_phase` decides. Separate body: warmed by the table's vertical
    acceleration squared, cooled within `law_time`. Swinging body: an oscillator of frequency 1/`law_time`, shaken by
    the table's vertical acceleration.
    """
    clock = time + p.clock
    if p.law_state == _TIME_OF_DAY:
        return math.sin(2.0 * math.pi * clock / p.law_scale)
    if p.law_state == _RANDOM:
        total = 0.0
        for wave in range(_WAVES):
            turns = clock / p.law_scale * math.sqrt(1.0 + 1.7 * wave) + 7.31 * math.sin(12.9898 * wave + p.law_phase)
            total += math.sin(2.0 * math.pi * turns)
        return total / math.sqrt(0.5 * _WAVES)
    if p.law_state == _BODY:
        m[0] += step * (az * az / _WARMING - m[0]) / p.law_time
        return m[0]
    if p.law_state == _SWINGING:
        swing = 2.0 * math.pi / p.law_time
        m[2] += step * (-az - 0.2 * swing * m[2] - swing * swing * m[1])
        m[1] += step * m[2]
        return m[1] / _SWING
    return 0.0
