"""The pads of the step loop: penalty springs on flat or curved plates, friction of the base law and what hides in it.

A shadow of each pad follows the base law with the pad's load and the slip of the pads' middle (of the pad, where yaw is
recorded): what hides is known exactly.
"""

import math

import numpy as np
from numba import njit

from slipwise_benchmarks.law_force import law_bound
from slipwise_benchmarks.law_states import POWER
from slipwise_benchmarks.pad_hidden import bodies_heat, grow_older, hidden_bound, unknown_bound, warm_bodies
from slipwise_benchmarks.pad_law import base_bound, bristle, preslide, slide, stick_stiffness
from slipwise_benchmarks.parts import AREA, CURVATURE, DAMPING, HEIGHT, LAW, MASS, STIFFNESS, X, Y
from slipwise_benchmarks.sphere import along_table, sphere, stretch

MIDDLE = 17  # columns of a row before the pads
PER_PAD = 6  # N, Fx, Fy, slip speed in x, base law's Fx and Fy


@njit(cache=True)
def stick_table(p, pads):
    """Stick of each pad (n, 4): stiffness and damping of the base's, and of a soft one that may hide."""
    sticks = np.zeros((pads.shape[0], 4))
    for i in range(pads.shape[0]):
        apparent, mass = pads[i, AREA], pads[i, MASS]
        stiff = stick_stiffness(p, apparent, mass, p.stick_length)
        soft = stick_stiffness(p, apparent, mass, p.presliding_length)
        sticks[i, 0] = stiff
        sticks[i, 1] = 2.0 * p.stick_damping * math.sqrt(stiff * mass)
        sticks[i, 2] = soft
        sticks[i, 3] = 0.1 * math.sqrt(soft * mass)
    return sticks


@njit(cache=True)
def pad_forces(p, pads, sticks, g, w, a, time, step, mem, heat_rates, heat_weights, law, driver, row, total):
    """Add the forces of the pads to `total` (force x, y, z; moment x, y, z about the centre of gravity).

    pads: (n, 11) rows of `slipwise_benchmarks.parts`. sticks: (n, 4) of `stick_table`.
    g, w, a: (6,) places, speeds, and accelerations of the step before. mem: (n, k) memories of the pads:
    0-1 stick, 2-3 shadow's stick, 4 age, 5 heat, 6 slid distance, 7 lagged bound, 8.. heat of half-space or bodies.
    law, driver: memories and driver of a law outside the catalogue.
    """
    middle_vx = w[0] - p.height * w[4] + p.centre_y * w[5]
    middle_vy = w[1] + p.height * w[3] - p.centre_x * w[5]
    middle_speed = math.sqrt(middle_vx * middle_vx + middle_vy * middle_vy)
    for i in range(pads.shape[0]):
        pad = pads[i]
        stiff, damp, soft, soft_damp = sticks[i, 0], sticks[i, 1], sticks[i, 2], sticks[i, 3]
        rx = pad[X] - p.centre_x - g[0]
        ry = pad[Y] - p.centre_y - g[1]
        vx = w[0] - p.height * w[4] - ry * w[5]
        vy = w[1] + p.height * w[3] + rx * w[5]
        speed = math.sqrt(vx * vx + vy * vy)
        place = g[0] - p.height * g[4] - ry * g[5]
        closing = -(w[2] + ry * w[3] - rx * w[4])
        squeeze = pad[HEIGHT] - (g[2] + ry * g[3] - rx * g[4])
        curvature = pad[CURVATURE] + p.curvature
        slope_x, slope_y, cosine, longer = 0.0, 0.0, 1.0, 1.0
        across = g[1] + p.height * g[3] + rx * g[5]
        if curvature != 0.0:
            rise, slope_x, slope_y, cosine = sphere(curvature, place, across)
            squeeze = (squeeze + rise) * cosine
            closing = (closing + slope_x * vx + slope_y * vy) * cosine
            longer = stretch(slope_x, slope_y, vx, vy)
            speed *= longer
        load = pad[STIFFNESS] * squeeze + pad[DAMPING] * closing
        if squeeze <= 0.0 or load < 0.0:
            load = 0.0
        m = mem[i]
        if p.yaw_known:
            middle_vx, middle_vy, middle_speed = vx, vy, math.sqrt(vx * vx + vy * vy)
        base_x, base_y, base_cosine, base_longer = 0.0, 0.0, 1.0, 1.0
        if pad[CURVATURE] != 0.0:
            _, base_x, base_y, base_cosine = sphere(pad[CURVATURE], place, across)
            base_longer = stretch(base_x, base_y, middle_vx, middle_vy)
        shadow = base_bound(p, pad[AREA], load, middle_speed * base_longer) / base_longer
        sx, sy, m[2], m[3] = slide(m[2], m[3], middle_vx, middle_vy, shadow, 0.0, stiff, damp, step)
        _, sx, sy = along_table(load, base_x, base_y, base_cosine, sx, sy)
        bound = base_bound(p, pad[AREA], load, speed)
        if p.rate_form or p.breakaway_form == 3:
            m[4] = grow_older(p.rate_form, m[4], speed, p.age_length, step)
        heat = m[5]
        if p.heat_form == 2:
            heat = 0.0
            for j in range(heat_rates.size):
                heat += heat_weights[j] * m[8 + j]
        elif p.heat_form == 3:
            heat = bodies_heat(m[8:11])
        if p.unknown_form:
            m[7] += (bound - m[7]) * min(step / max(p.unknown_place, step), 1.0) if p.unknown_form == 9 else 0.0
            load_rate = pad[STIFFNESS] * closing
            bound = unknown_bound(p, bound, load, m[7], load_rate, vx, speed, place, a[0], time)
        bound = hidden_bound(p, pad, bound, load, speed, place, m[4], heat, m[6])
        if p.law_port:
            turning = a[0] - p.height * a[4] - ry * a[5]
            bound = law_bound(p, pad[LAW], bound, law[i], vx, speed, place, load, turning, driver, step)
        bound = max(bound, 0.002 * load) / longer
        if p.presliding_form == 3:
            fx, fy, m[0], m[1] = slide(m[0], m[1], vx, vy, bound, p.asymmetry, soft, soft_damp, step)
        elif p.presliding_form == 4:
            fx, fy, m[0], m[1] = bristle(
                m[0], m[1], vx, vy, bound, p.asymmetry, p.presliding_length, p.presliding_lag, step
            )
        elif p.presliding_form:
            fx, fy, m[0], m[1] = preslide(
                p.presliding_form, m[0], m[1], vx, vy, bound, p.asymmetry, p.presliding_length, soft_damp, step
            )
        else:
            fx, fy, m[0], m[1] = slide(m[0], m[1], vx, vy, bound, p.asymmetry, stiff, damp, step)
        fy *= 1.0 + p.anisotropy
        work = abs(fx * vx + fy * vy + (slope_x * fx + slope_y * fy) * (slope_x * vx + slope_y * vy))
        law[i, POWER] = work / pad[AREA]
        m[6] += speed * step
        if p.heat_form == 1:
            m[5] += step * (work - m[5] / p.heat_time)
        elif p.heat_form == 2:
            for j in range(heat_rates.size):
                m[8 + j] += step * (work / pad[AREA] - m[8 + j] * heat_rates[j])
        elif p.heat_form == 3:
            warm_bodies(p, m[8:11], work, step)
        load, fx, fy = along_table(load, slope_x, slope_y, cosine, fx, fy)
        fx += load * p.tilt
        at = MIDDLE + PER_PAD * i
        row[at] = load
        row[at + 1] = fx
        row[at + 2] = fy
        row[at + 3] = vx
        row[at + 4] = sx
        row[at + 5] = sy
        total[0] -= fx
        total[1] -= fy
        total[2] += load
        total[3] += ry * load - p.height * fy
        total[4] += p.height * fx - rx * load
        total[5] += -rx * fy + ry * fx
