"""What hidden effects make of a pad's friction bound, and the memories they keep."""

import math

from numba import njit

from slipwise_benchmarks.parts import FACTOR, MASS, PATCH

RATE_SPEED = 0.1  # speed at which rate_and_state changes nothing in the steady state [m/s]
RATE_CUTOFF = 2.0e-4  # below it the direct effect levels off [m/s]


@njit(cache=True)
def grow_older(form, age, speed, length, step):
    """Age of the contact [s]: ageing law (form 2: slip law), exact over a step of constant speed."""
    passed = speed * step / length
    if passed < 1.0e-9:
        return age + step
    steady = length / speed
    if form == 2:
        return steady * (age / steady) ** math.exp(-passed)
    return steady + (age - steady) * math.exp(-passed)


@njit(cache=True)
def pressure_factor(p, mass, load):
    """Other dependence on pressure: 1 power, 2 quadratic, 3 tanh; all 1 at the rest pressure of a pad's `mass`."""
    ratio = max(load / (mass * 9.80665), 0.02)
    if p.pressure_form == 1:
        return ratio**p.pressure_size
    if p.pressure_form == 2:
        return 1.0 + p.pressure_size * (ratio - 1.0) ** 2
    return 1.0 + p.pressure_size * math.tanh(2.0 * (ratio - 1.0))


@njit(cache=True)
def heat_factor(p, heat):
    """1 first order, 3 three bodies: exponential in stored work; 2 half-space: kT of Kumar (2015) from 20 degrees C."""
    if p.heat_form != 2:
        return math.exp(-p.heat * heat / (1300.0 * p.pad_size))
    return 0.789 * (0.7 ** ((20.0 + p.heat * heat) / 50.0) + 0.4) / 0.99968


@njit(cache=True)
def bodies_heat(stored):
    """Work [J] that counts of what three bodies store (3,): face, sheet and plate."""
    return 0.5 * stored[0] + 0.3 * stored[1] + 0.2 * stored[2]


@njit(cache=True)
def warm_bodies(p, stored, work, step):
    """Let work [W] into three bodies that lose it in a fifth of `heat_time`, in that time and in five times that."""
    stored[0] += step * (work - 5.0 * stored[0] / p.heat_time)
    stored[1] += step * (work - stored[1] / p.heat_time)
    stored[2] += step * (work - 0.2 * stored[2] / p.heat_time)


@njit(cache=True)
def wear_factor(p, distance):
    """1 exponential, 2 hyperbolic, 3 a small power: a transfer film that settles with slid distance."""
    if p.wear_form == 1:
        return 1.0 + p.wear * math.exp(-distance / p.wear_length)
    if p.wear_form == 3:
        return 1.0 + p.wear / (1.0 + distance / p.wear_length) ** 0.3
    return 1.0 + p.wear / (1.0 + distance / p.wear_length) ** 1.5


@njit(cache=True)
def patch_factor(p, depth, place):
    """1 Gaussian, 2 raised cosine, 3 plateau with soft edges; `depth` is that of this pad."""
    off = (place - p.patch_place) / p.patch_width
    if p.patch_form == 1:
        shape = math.exp(-off * off)
    elif p.patch_form == 2:
        shape = 0.5 * (1.0 + math.cos(math.pi * off)) if abs(off) < 1.0 else 0.0
    else:
        shape = 0.5 * (math.tanh(4.0 * (off + 1.0)) - math.tanh(4.0 * (off - 1.0)))
    return 1.0 + depth * shape


@njit(cache=True)
def breakaway_force(p, load, speed, age):
    """1 Gaussian in speed, 2 exponential, 3 Gaussian that grows with the contact's age."""
    ratio = speed / p.breakaway_speed
    if p.breakaway_form == 2:
        return load * p.breakaway * math.exp(-ratio)
    peak = load * p.breakaway * math.exp(-ratio * ratio)
    if p.breakaway_form == 3:
        peak *= 1.0 + p.breakaway_ageing * math.log10(1.0 + age / 0.01)
    return peak


@njit(cache=True)
def unknown_bound(p, bound, load, lagged_bound, load_rate, vx, speed, place, acceleration, time):
    """Laws outside the catalogue that act on the pads.

    1 washboard, 2 acceleration, 3 slow modulation by the clock, 4 load rate, 5 cubic drag, 6 away from the
    centre, 9 contact area that follows the load late.
    """
    form, size, scale = p.unknown_form, p.unknown_size, p.unknown_scale
    forward = math.tanh(vx / 2.0e-3)
    if form == 1:
        return bound * (1.0 + size * math.sin(2.0 * math.pi * place / scale + p.unknown_place))
    if form == 2:
        return bound + load * size * math.tanh(acceleration * forward / scale)
    if form == 3:
        return bound * (1.0 + size * math.sin(2.0 * math.pi * (time + p.clock) / scale))
    if form == 4:
        return bound * (1.0 + size * math.tanh(load_rate / scale))
    if form == 5:
        return bound + load * size * (speed / scale) ** 3
    if form == 6:
        return bound * (1.0 + size * math.tanh(place / scale) * forward)
    if form == 9:
        return bound + size * (lagged_bound - bound)
    return bound


@njit(cache=True)
def hidden_bound(p, pad, bound, load, speed, place, age, heat, distance):
    """Bound of a pad, whose row of `parts` is given, with every catalogue effect that is switched on [N]."""
    if p.pressure_form:
        bound *= pressure_factor(p, pad[MASS], load)
    if p.breakaway_form:
        bound += breakaway_force(p, load, speed, age)
    if p.rate_form:
        direct = math.log((speed + RATE_CUTOFF) / RATE_SPEED)
        bound += load * (p.rate_direct * direct + p.rate_evolution * math.log(age * RATE_SPEED / p.age_length + 1.0e-3))
    if p.heat_form:
        bound *= heat_factor(p, heat)
    if p.wear_form:
        bound *= wear_factor(p, distance)
    if p.patch_form:
        bound *= patch_factor(p, pad[PATCH], place)
    return bound * pad[FACTOR]
