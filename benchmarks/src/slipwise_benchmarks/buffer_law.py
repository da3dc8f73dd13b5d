"""Force of one rubber buffer and of its shear key, with what may hide in them."""

import math

from numba import njit


@njit(cache=True)
def through_gap(x, clearance):
    """Displacement of the rubber [m] when the key has to cross `clearance` on either side first."""
    if x > clearance:
        return x - clearance
    if x < -clearance:
        return x + clearance
    return 0.0


@njit(cache=True)
def elastic_force(p, stiffness, x, largest):
    """Spring [N]: hardening k x (1 + g (|x|/xh)^p), and softening after the largest excursion so far.

    Softening forms: 1 exponential in the largest excursion, 2 linear up to twice the length.
    """
    force = stiffness * x
    if p.hardening != 0.0:
        force *= 1.0 + p.hardening * (abs(x) / p.hardening_length) ** p.hardening_power
    if p.softening_form == 1:
        force *= 1.0 + p.softening * math.exp(-largest / p.softening_length)
    elif p.softening_form == 2:
        force *= 1.0 + p.softening * max(0.0, 1.0 - 0.5 * largest / p.softening_length)
    return force


@njit(cache=True)
def damping_force(p, v, share):
    """A buffer's share of the damping [N]: 1 linear, 2 a power 0.6 of speed, equal to the linear one at 0.2 m/s.

    Form 3, Zener's rubber, takes the speed of its dashpot instead of that of the buffer.
    """
    if p.buffer_damping_form == 1 or p.buffer_damping_form == 3:
        return share * p.buffer_damping * v
    if p.buffer_damping_form == 2:
        return share * p.buffer_damping * 0.2 * v / (0.2**0.6 * (v * v + 1.0e-6) ** 0.2)
    return 0.0


@njit(cache=True)
def dashpot_speed(p, speed, v, step):
    """Speed [m/s] of the dashpot in series with a spring: it follows that of the buffer within `buffer_relaxation`."""
    return speed + (v - speed) * step / p.buffer_relaxation


@njit(cache=True)
def hysteresis_rate(p, z, v):
    """Growth of the loop's share z: 1 Bouc-Wen with exponent 1, 2 with exponent 2 (beta 0.9, gamma 0.1)."""
    if p.hysteresis_form == 1:
        return (v - abs(v) * z) / p.hysteresis_length
    return (v - (0.9 * abs(v) * z * abs(z) + 0.1 * v * z * z)) / p.hysteresis_length


@njit(cache=True)
def impact_force(p, push, x, v):
    """Dashpot of the closing key [N]: acts while the gap is closed and never pulls."""
    if p.key_impact == 0.0 or push == 0.0:
        return 0.0
    force = p.key_impact * math.sqrt(abs(push)) * v
    if push > 0.0:
        return max(force, 0.0)
    return min(force, 0.0)


@njit(cache=True)
def key_share(p, w, z, step):
    """Share of the key's friction that opposes upward motion w: 1 by speed, 2 by a short elastic way.

    Returns:
        the share (-1..1) and the new elastic displacement [m].
    """
    if p.key_form == 1:
        return math.tanh(w / p.key_scale), 0.0
    z = min(max(z + w * step, -p.key_scale), p.key_scale)
    return z / p.key_scale, z


@njit(cache=True)
def rubbing_force(p, x, v):
    """Rub of the girder's side against a bar, only where slip is within 3 mm of a place [N]."""
    off = (x - p.unknown_place) / 3.0e-3
    return p.unknown_size * math.exp(-(off**4)) * math.tanh(v / p.unknown_scale)
