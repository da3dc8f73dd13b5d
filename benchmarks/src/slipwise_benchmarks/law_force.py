"""Where a law outside the catalogue acts: on a pad's bound of friction, or on the girder."""

import math

from numba import njit

from slipwise_benchmarks.law_shape import law_value
from slipwise_benchmarks.law_states import direction, follow

#: In order of the numbers that the loop knows them by, from 1; "one pad" multiplies mu of some pads.
PORTS: tuple[str, ...] = ("adds to mu", "multiplies mu", "girder", "buffer", "load")


@njit(cache=True)
def law_bound(p, share, bound, m, vx, speed, place, load, acceleration, driver, step):
    """Bound of a pad that has a `share` of the law [N]; `m` is its memory, `acceleration` that of its slip."""
    follow(m, vx, load, p.law_time, step)
    if p.law_port > 2:
        return bound
    value = share * law_value(p, m, vx, speed, place, load, acceleration, driver)
    return bound + load * value if p.law_port == 1 else bound * (1.0 + value)


@njit(cache=True)
def middle_force(p, g, w, a, step, m, driver, load):
    """Force that no pad carries [N]: against the girder's slip, or upwards; `load` is that of a pad on average."""
    vx = w[0] - p.height * w[4] + p.centre_y * w[5]
    vy = w[1] + p.height * w[3] - p.centre_x * w[5]
    place = g[0] - p.height * g[4] + p.centre_y * g[5]
    follow(m, vx, load, p.law_time, step)
    force = law_value(p, m, vx, math.sqrt(vx * vx + vy * vy), place, load, a[0] - p.height * a[4], driver)
    return force * direction(vx) if p.law_signed else force
