"""The buffers of the step loop, with their keys, and what no pad and no key passes on."""

from numba import njit

from slipwise_benchmarks.buffer_law import (
    damping_force,
    dashpot_speed,
    elastic_force,
    hysteresis_rate,
    impact_force,
    key_share,
    rubbing_force,
    through_gap,
)
from slipwise_benchmarks.parts import ACROSS, ALONG, BUFFER_X, BUFFER_Y, BUFFER_Z, SIDE


@njit(cache=True)
def buffer_forces(p, buffers, g, w, step, mem, more, at, row, total):
    """Add the buffers and their keys, and `more` [N] at all together; each has its share of what hides in them.

    buffers: (m, 6) rows of `parts`. mem: (m, 4): loop share, largest excursion, key's way, dashpot's speed.
    at: column of the first one's force in `row`.
    """
    count = buffers.shape[0]
    for j in range(count):
        buffer, share = buffers[j], 1.0 / count
        rz = buffer[BUFFER_Z] + p.buffer_height - p.height
        from_x, from_y = buffer[BUFFER_X] - p.centre_x, buffer[BUFFER_Y] - p.centre_y
        rx = from_x - g[0]
        ry = from_y - g[1]
        x = g[0] + rz * g[4] - from_y * g[5]
        y = g[1] - rz * g[3] + from_x * g[5]
        vx = w[0] + rz * w[4] - ry * w[5]
        vy = w[1] - rz * w[3] + rx * w[5]
        unlike = 1.0 + buffer[SIDE] * p.mismatch
        push = through_gap(x, p.clearance)
        m = mem[j]
        m[3] = dashpot_speed(p, m[3], vx, step) if p.buffer_damping_form == 3 else vx
        fx = elastic_force(p, buffer[ALONG] * unlike, push, m[1]) + impact_force(p, push, x, vx)
        fx += damping_force(p, m[3], share)
        if p.hysteresis_form:
            m[0] += step * hysteresis_rate(p, m[0], vx)
            fx += share * p.hysteresis_force * m[0]
        fx += share * more
        if p.unknown_form == 8:
            # a bar beside each, on the line of the buffers, so that the girder does not turn
            total[0] -= share * rubbing_force(p, x, vx)
        m[1] = max(m[1], abs(push))
        fy = buffer[ACROSS] * unlike * y + damping_force(p, vy, share)
        fz = 0.0
        if p.key_form:
            upward = w[2] + ry * w[3] - rx * w[4]
            rub, m[2] = key_share(p, upward, m[2], step)
            fz = -p.key_friction * abs(fx) * rub
        row[at + 2 * j] = fx
        row[at + 2 * j + 1] = fy
        total[0] -= fx
        total[1] -= fy
        total[2] += fz
        total[3] += ry * fz + rz * fy
        total[4] += -rz * fx - rx * fz
        total[5] += -rx * fy + ry * fx
