"""The step loop: a rigid girder on four penalty pads and two buffers, six degrees of freedom.

Coordinates are the centre of gravity (x, y, z) relative to the table and small rotations (roll about +x, pitch about
+y: nose down at +x, yaw about +z). Pads stand on the table, so weight moves over them as the girder slips (P-delta).
Semi-implicit Euler: forces from the state, then speeds, then places. A shadow of each pad follows the base law with
the pad's load and the slip of the pads' middle (of the pad, where yaw is recorded): what hides is known exactly.

Trap: numba's cache watches this file only; after editing one of the laws delete `__pycache__`.
"""

import math

import numpy as np
from numba import njit

from bench.buffer_law import (
    damping_force,
    dashpot_speed,
    elastic_force,
    hysteresis_rate,
    impact_force,
    key_share,
    rubbing_force,
    through_gap,
)
from bench.law_drivers import hidden_driver
from bench.law_force import law_bound, middle_force
from bench.law_states import POWER
from bench.pad_hidden import bodies_heat, grow_older, hidden_bound, unknown_bound, warm_bodies
from bench.pad_law import base_bound, bristle, preslide, slide, stick_stiffness
from bench.settings import GRAVITY, PAD_SIGN_X, PAD_SIGN_Y

GIRDER = 6  # places in the state: x, y, z, roll, pitch, yaw
MIDDLE = 17  # columns before the pads
PER_PAD = 6  # N, Fx, Fy, slip speed in x, base law's Fx and Fy


@njit(cache=True)
def pad_forces(p, g, w, a, time, step, mem, heat_rates, heat_weights, law, driver, row, total):
    """Add the forces of the four pads to `total` (force x, y, z; moment x, y, z about the centre of gravity).

    g, w, a: (6,) places, speeds, and accelerations of the step before. mem: (4, n) memories of the pads:
    0-1 stick, 2-3 shadow's stick, 4 age, 5 heat, 6 slid distance, 7 lagged bound, 8.. heat of half-space or bodies.
    law, driver: memories and driver of a law outside the catalogue.
    """
    stiff = stick_stiffness(p, p.stick_length)
    damp = 2.0 * p.stick_damping * math.sqrt(stiff * 0.25 * p.mass)
    soft = stick_stiffness(p, p.presliding_length)
    soft_damp = 0.1 * math.sqrt(soft * 0.25 * p.mass)
    middle_vx = w[0] - p.height * w[4] + p.centre_y * w[5]
    middle_vy = w[1] + p.height * w[3] - p.centre_x * w[5]
    middle_speed = math.sqrt(middle_vx * middle_vx + middle_vy * middle_vy)
    for i in range(4):
        rx = 0.5 * p.spacing_x * PAD_SIGN_X[i] - p.centre_x - g[0]
        ry = 0.5 * p.spacing_y * PAD_SIGN_Y[i] - p.centre_y - g[1]
        vx = w[0] - p.height * w[4] - ry * w[5]
        vy = w[1] + p.height * w[3] + rx * w[5]
        speed = math.sqrt(vx * vx + vy * vy)
        place = g[0] - p.height * g[4] - ry * g[5]
        closing = -(w[2] + ry * w[3] - rx * w[4])
        squeeze = p.seating[i] - (g[2] + ry * g[3] - rx * g[4])
        load = p.pad_stiffness * squeeze + p.pad_damping * closing
        if squeeze <= 0.0 or load < 0.0:
            load = 0.0
        m = mem[i]
        if p.yaw_known:
            middle_vx, middle_vy, middle_speed = vx, vy, speed
        shadow = base_bound(p, load, middle_speed)
        sx, sy, m[2], m[3] = slide(m[2], m[3], middle_vx, middle_vy, shadow, 0.0, stiff, damp, step)
        bound = base_bound(p, load, speed)
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
            load_rate = p.pad_stiffness * closing
            bound = unknown_bound(p, bound, load, m[7], load_rate, vx, speed, place, a[0], time)
        bound = hidden_bound(p, i, bound, load, speed, place, m[4], heat, m[6])
        if p.law_port:
            turning = a[0] - p.height * a[4] - ry * a[5]
            bound = law_bound(p, i, bound, law[i], vx, speed, place, load, turning, driver, step)
        bound = max(bound, 0.002 * load)
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
        work = abs(fx * vx + fy * vy)
        law[i, POWER] = work / p.pad_area
        m[6] += speed * step
        if p.heat_form == 1:
            m[5] += step * (work - m[5] / p.heat_time)
        elif p.heat_form == 2:
            for j in range(heat_rates.size):
                m[8 + j] += step * (work / p.pad_area - m[8 + j] * heat_rates[j])
        elif p.heat_form == 3:
            warm_bodies(p, m[8:11], work, step)
        fx += load * (p.tilt + p.curvature * place)
        fy += load * p.curvature * (g[1] + p.height * g[3] + rx * g[5])
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


@njit(cache=True)
def buffer_forces(p, g, w, step, mem, more, row, total):
    """Add the buffers and their keys, and `more` [N] at both together.

    mem: (2, 4): loop share, largest excursion, key's way, dashpot's speed.
    """
    rz = p.buffer_height - p.height
    for j in range(2):
        side = 1.0 - 2.0 * j
        rx = -p.centre_x - g[0]
        ry = side * p.buffer_place - p.centre_y - g[1]
        x = g[0] + rz * g[4] - (side * p.buffer_place - p.centre_y) * g[5]
        y = g[1] - rz * g[3]
        vx = w[0] + rz * w[4] - ry * w[5]
        vy = w[1] - rz * w[3]
        stiffness = 0.5 * p.buffer_stiffness * (1.0 + side * p.mismatch)
        push = through_gap(x, p.clearance)
        m = mem[j]
        m[3] = dashpot_speed(p, m[3], vx, step) if p.buffer_damping_form == 3 else vx
        fx = elastic_force(p, stiffness, push, m[1]) + impact_force(p, push, x, vx) + damping_force(p, m[3])
        if p.hysteresis_form:
            m[0] += step * hysteresis_rate(p, m[0], vx)
            fx += 0.5 * p.hysteresis_force * m[0]
        fx += 0.5 * more
        if p.unknown_form == 8:
            # one bar on each side, on the line of the buffers, so that the girder does not turn
            total[0] -= 0.5 * rubbing_force(p, x, vx)
        m[1] = max(m[1], abs(push))
        fy = stiffness * y + damping_force(p, vy)
        fz = 0.0
        if p.key_form:
            upward = w[2] + ry * w[3] - rx * w[4]
            share, m[2] = key_share(p, upward, m[2], step)
            fz = -p.key_friction * abs(fx) * share
        row[MIDDLE + 4 * PER_PAD + 2 * j] = fx
        row[MIDDLE + 4 * PER_PAD + 2 * j + 1] = fy
        total[0] -= fx
        total[1] -= fy
        total[2] += fz
        total[3] += ry * fz + rz * fy
        total[4] += -rz * fx - rx * fz
        total[5] += -rx * fy + ry * fx


@njit(cache=True)
def run(
    p, start, table, table_step, step, settle, steps, every, pads, buffers, heat_rates, heat_weights, law, body, out
):
    """Integrate from rest and fill `out` with one row every `every` steps.

    Args:
        p: `Settings`.
        start: (6,) static place of the girder.
        table: (n, 3) accelerations of the table [m/s^2], read linearly between samples.
        table_step: their interval [s].
        step: of the integration [s].
        settle: steps at rest before the first row.
        steps: steps with motion.
        every: steps for a row.
        pads: (4, n) memories, changed in place.
        buffers: (2, 4) memories, changed in place.
        heat_rates: decay rates of the half-space kernel [1/s].
        heat_weights: its weights [K m^2/J].
        law: (5, n) memories of a law outside the catalogue: pads, and the middle.
        body: (n,) memory of a body beside the rig that drives such a law.
        out: (rows, columns).
    """
    g = start.copy()
    w = np.zeros(GIRDER)
    a = np.zeros(GIRDER)
    total = np.zeros(GIRDER)
    row = np.zeros(out.shape[1])
    inertia = (p.inertia_roll, p.inertia_pitch, p.inertia_yaw)
    bend, bend_v, swing, swing_v, tip, tip_v = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    bend_w = 2.0 * math.pi * p.bending_frequency
    tip_w = 2.0 * math.pi * p.pitch_frequency
    swing_mass = p.unknown_size if p.unknown_form == 7 else 0.0
    swing_w = 2.0 * math.pi * p.unknown_scale
    rows = 0
    for s in range(-settle, steps):
        ax, ay, az = 0.0, 0.0, 0.0
        if s >= 0:
            at = s * step / table_step
            i = int(at)
            if i + 1 < table.shape[0]:
                f = at - i
                ax = table[i, 0] + f * (table[i + 1, 0] - table[i, 0])
                ay = table[i, 1] + f * (table[i + 1, 1] - table[i, 1])
                az = table[i, 2] + f * (table[i + 1, 2] - table[i, 2])
        total[:] = 0.0
        driver = hidden_driver(p, body, s * step, az, step) if p.law_port else 0.0
        pad_forces(p, g, w, a, s * step, step, pads, heat_rates, heat_weights, law, driver, row, total)
        force = middle_force(p, g, w, a, step, law[4], driver, 0.25 * total[2]) if p.law_port > 2 else 0.0
        buffer_forces(p, g, w, step, buffers, force if p.law_port == 4 else 0.0, row, total)
        if p.law_port == 3:
            total[0] -= force
        elif p.law_port == 5:
            total[2] += force
        tip_a = 0.0
        if p.pitch_form and s >= 0:
            drive = ax if p.pitch_form == 1 else row[3]
            tip_a = tip_w * tip_w * (p.pitch_per_acceleration * drive - tip) - 0.7 * tip_w * tip_v
        if p.drag_form == 1:
            total[0] -= p.drag * w[0]
            total[1] -= p.drag * w[1]
        elif p.drag_form == 2:
            total[0] -= p.drag * abs(w[0]) * w[0] / 0.2
            total[1] -= p.drag * abs(w[1]) * w[1] / 0.2
        bend_pull = 2.0 * p.bending_damping * bend_w * bend_v + bend_w * bend_w * bend
        swing_pull = 0.03 * swing_w * swing_v + swing_w * swing_w * swing
        # accelerometers feel what contacts do, weight excluded, also on a table that tips
        felt_x = (total[0] + swing_mass * swing_pull) / (p.mass - swing_mass)
        felt_y = total[1] / p.mass
        felt_z = (total[2] + p.bending_mass * (bend_pull - GRAVITY)) / (p.mass - p.bending_mass) - GRAVITY
        a[0] = felt_x + GRAVITY * tip - ax - p.height * tip_a
        a[1] = felt_y - ay
        a[2] = felt_z - az + g[0] * tip_a
        for j in range(3):
            a[3 + j] = total[3 + j] / inertia[j]
        turn = a[4]
        a[4] -= tip_a
        bend_a = -(felt_z) - bend_pull
        row[0] = ax - GRAVITY * tip
        row[1] = ay
        row[2] = az
        row[3] = felt_x
        row[4] = felt_y
        row[5] = felt_z + p.bending_gauge * bend_a
        row[6] = row[5] - (0.5 * p.spacing_x - p.centre_x) * turn
        row[7] = row[5] + (0.5 * p.spacing_x + p.centre_x) * turn
        row[8] = g[0] - p.height * g[4] + p.centre_y * g[5]
        row[9] = g[1] + p.height * g[3] - p.centre_x * g[5]
        row[10] = w[0] - p.height * w[4] + p.centre_y * w[5]
        row[11] = w[1] + p.height * w[3] - p.centre_x * w[5]
        row[12] = g[5]
        row[13] = g[4]
        row[14] = g[3]
        row[15] = a[4]
        row[16] = a[3]
        if s >= 0 and s % every == 0:
            out[rows] = row
            rows += 1
        for j in range(GIRDER):
            w[j] += step * a[j]
            g[j] += step * w[j]
        if p.bending_mass > 0.0:
            bend_v += step * bend_a
            bend += step * bend_v
        if swing_mass > 0.0:
            swing_v += step * (-felt_x - swing_pull)
            swing += step * swing_v
        if p.pitch_form:
            tip_v += step * tip_a
            tip += step * tip_v
    return rows
