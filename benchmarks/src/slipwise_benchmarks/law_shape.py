"""Forms that a law may have over its state, and what the law is at an instant."""

import math

from numba import njit

from slipwise_benchmarks.law_states import DIRECTION, state

#: In order of the numbers that the loop knows them by, from 1.
FORMS: tuple[str, ...] = (*("linear", "square", "power", "tanh", "step", "bump", "lorentz", "exp", "sine", "hinge"),)
#: Form -> its equation; s: state, c: size, s_0: place, w: scale or width.
EQUATIONS: dict[str, str] = {
    "linear": "c s",
    "square": "c s^2",
    "power": "c (|s|/w)^p",
    "tanh": "c tanh(s/w)",
    "step": "c [1 + tanh((s - s_0)/w)]/2",
    "bump": "c exp(-((s - s_0)/w)^2)",
    "lorentz": "c / [1 + ((s - s_0)/w)^2]",
    "exp": "c exp(-s/w)",
    "sine": "c sin(2 pi s/w + phi)",
    "hinge": "c max(s - s_0, 0)",
    "product": "c s r",
}


@njit(cache=True)
def shape(p, s, scale):
    """Value of the form over a state `s`; `scale` is its scale, width or period."""
    size, form = p.law_size, p.law_form
    off = (s - p.law_place) / scale
    if form == 1:
        return size * s
    if form == 2:
        return size * s * s
    if form == 3:
        return size * (abs(s) / scale) ** p.law_exponent
    if form == 4:
        return size * math.tanh(s / scale)
    if form == 5:
        return size * 0.5 * (1.0 + math.tanh(off))
    if form == 6:
        return size * math.exp(-off * off)
    if form == 7:
        return size / (1.0 + off * off)
    if form == 8:
        return size * math.exp(-s / scale)
    if form == 9:
        return size * math.sin(2.0 * math.pi * s / scale + p.law_phase)
    return size * max(s - p.law_place, 0.0)


@njit(cache=True)
def law_value(p, m, vx, speed, place, load, acceleration, driver):
    """The law at this instant, times a second state where it has one; `law_back` is the scale of the way back."""
    s = state(p.law_state, m, vx, speed, place, load, acceleration, p.law_time, driver)
    value = shape(p, s, p.law_back if p.law_back > 0.0 and m[DIRECTION] < 0.0 else p.law_scale)
    if p.law_other:
        value *= state(p.law_other, m, vx, speed, place, load, acceleration, p.law_time, driver)
    return value
