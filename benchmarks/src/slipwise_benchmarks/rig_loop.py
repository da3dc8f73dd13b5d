"""The step loop: a rigid girder on penalty pads and buffers, six degrees of freedom.

Coordinates are the centre of gravity (x, y, z) relative to the table and small rotations (roll about +x, pitch about
+y: nose down at +x, yaw about +z). Pads stand on the table, so weight moves over them as the girder slips (P-delta).
Semi-implicit Euler: forces from the state, then speeds, then places.

Trap: numba's cache watches this file only; after editing one of the laws delete `__pycache__`.
"""

import math

import numpy as np
from numba import njit

from slipwise_benchmarks.law_drivers import hidden_driver
from slipwise_benchmarks.law_force import middle_force
from slipwise_benchmarks.rig_buffers import buffer_forces
from slipwise_benchmarks.rig_pads import MIDDLE, PER_PAD, pad_forces, stick_table
from slipwise_benchmarks.rig_storeys import FELT, frame_forces, frame_mass, sway
from slipwise_benchmarks.settings import GRAVITY

GIRDER = 6  # places in the state: x, y, z, roll, pitch, yaw


@njit(cache=True)
def run(
    p, pads, buffers, storeys, start, table, table_step, step, settle, steps, every, pad_memory, buffer_memory,
    heat_rates, heat_weights, law, body, floors, out,
):  # fmt: skip
    """Integrate from rest and fill `out` with one row every `every` steps.

    Args:
        p: `Settings` without what each pad has of its own.
        pads: (n, 11) rows of `slipwise_benchmarks.parts`.
        buffers: (m, 6) rows of `slipwise_benchmarks.parts`.
        storeys: (s, 4) rows of `slipwise_benchmarks.parts`.
        start: (6,) static place of the girder.
        table: (n, 3) accelerations of the table [m/s^2], read linearly between samples.
        table_step: their interval [s].
        step: of the integration [s].
        settle: steps at rest before the first row.
        steps: steps with motion.
        every: steps for a row.
        pad_memory: (n, k), changed in place.
        buffer_memory: (m, 4), changed in place.
        heat_rates: decay rates of the half-space kernel [1/s].
        heat_weights: its weights [K m^2/J].
        law: (n + 1, k) memories of a law outside the catalogue: pads, and the middle.
        body: (k,) memory of a body beside the rig that drives such a law.
        floors: (s, 6) memory of the storeys.
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
    count = pads.shape[0]
    carried = frame_mass(storeys)
    felt_z = 0.0
    felt, turns = np.zeros(2), np.zeros(2)
    first_floor = MIDDLE + PER_PAD * count + 2 * buffers.shape[0]
    sticks = stick_table(p, pads)
    keys = MIDDLE + PER_PAD * count
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
        pad_forces(
            p, pads, sticks, g, w, a, s * step, step, pad_memory, heat_rates, heat_weights, law, driver, row, total
        )
        force = middle_force(p, g, w, a, step, law[count], driver, total[2] / count) if p.law_port > 2 else 0.0
        buffer_forces(p, buffers, g, w, step, buffer_memory, force if p.law_port == 4 else 0.0, keys, row, total)
        if p.law_port == 3:
            total[0] -= force
        elif p.law_port == 5:
            total[2] += force
        if carried > 0.0:
            frame_forces(storeys, floors, p.height, felt_z, total)
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
        felt_z = (total[2] + p.bending_mass * (bend_pull - GRAVITY)) / (p.mass - p.bending_mass + carried) - GRAVITY
        a[0] = felt_x + GRAVITY * tip - ax - p.height * tip_a
        a[1] = felt_y - ay
        a[2] = felt_z - az + g[0] * tip_a
        for j in range(3):
            a[3 + j] = total[3 + j] / inertia[j]
        turn = a[4]
        if carried > 0.0:
            felt[0], felt[1], turns[0], turns[1] = felt_x, felt_y, a[3], turn
            sway(storeys, floors, p.height, felt, turns, step)
            for i in range(storeys.shape[0]):
                row[first_floor + 2 * i] = floors[i, FELT]
                row[first_floor + 2 * i + 1] = floors[i, FELT + 1]
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
