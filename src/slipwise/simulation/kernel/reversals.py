"""Dry friction that turns round, or gives way, within a step.

MuJoCo lets friction be one force for a whole step. Where a row of it slides at the rate v at the step's start and would
slide at v' < 0 < v at its end if friction kept its sense, the rate is zero after

    t = dt v / (v - v'),    from then on friction has the other sense, or holds where it can,

so that its mean over the step is b (2 t/dt - 1). The solver stops the girder instead: the rate is then in error by a
share of b dt/m, which nothing takes back where nothing restores. After it has solved a step, forces, accelerations and
their readings are therefore changed to those of the mean; rates follow when MuJoCo integrates. Rates stand half a step
before positions, and a rate that bends within a step is not its mean: where the acceleration changes by D at a time s
after the step's middle, the position is moved by D s^2 / 2.

Where a row sticks, the acceleration e under all the friction that it may carry grows from below zero (friction holds)
to above it (it slides). Where it passes zero within the step, the rate at its end is (e + e' dt/2)^2 / (2 e') and not
e dt, e' being its rate of change.

All is linear in the forces: how degrees of freedom, rows and readings respond to one newton of each row of friction is
worked out once, at rest (see `steps.py`).

Source: the events of an integration from event to event, located by straight lines within a step; its error is of the
order of dt^2, as that of the integrator between events.
"""

from math import isnan

import numpy as np

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.dispatch import Dispatch
from slipwise.simulation.kernel.friction_rows import REST, learn_rate_dependence
from slipwise.simulation.kernel.places import (
    ACCELERATIONS,
    BEND,
    BOUND,
    CHANGE,
    DT,
    END_RATE,
    EXCESS,
    FORCE,
    FRICTION_ROW,
    LAST_VELOCITY,
    LATE,
    MAX_DOFS,
    N_ACCELERATIONS,
    N_ARMS,
    N_DOFS,
    N_PADS,
    OVER_REST,
    PAD_JACOBIAN,
    PAD_TENDON,
    RATE_SHARE,
    RESPONSES,
    ROW_BOUND,
    SENSE,
    TRIAL,
)

#: Share of what a row may carry from which on it counts as carrying all of it [1]: the solver's own error.
_ALL = 1.0 - 1e-9
#: Least share of what a row may carry that it must have carried in the step before to have slid as it does now [1]: the
#: girder lands, or friction that holds next to nothing turns from one direction to another.
_ALIKE = 0.5
#: Least share of its pad's friction at which a row matters [1]: across the motion it carries next to nothing.
_LEAST = 1e-6


@compilable
def turn_friction(
    effects: Dispatch, u: Array, ten_velocity: Array, friction_force: Array, qacc: Array, qpos: Array,
    constraint_force: Array, sensordata: Array,
) -> None:  # fmt: skip
    """Let friction that turns round or gives way within the step act as long as it does.

    Args:
        effects: the chosen effects.
        u: the law's numbers; the sense of every row in them goes on.
        ten_velocity: rates of MuJoCo's tendons at the step's start [m/s].
        friction_force: of the constraint rows, on the girder [N]; changed.
        qacc: accelerations of the degrees of freedom [m/s^2, rad/s^2]; changed.
        qpos: their positions [m, rad]; changed.
        constraint_force: generalised forces of all constraints [N, N m]; changed.
        sensordata: MuJoCo's readings; the accelerations among them are changed.
    """
    if u[RESPONSES] <= 0.0:
        return
    turns, near = False, False
    for row in range(2 * int(u[N_PADS])):
        z = _place(effects, row)
        bound, force = u[z + ROW_BOUND], -friction_force[int(u[z + FRICTION_ROW])]
        sense = u[z + SENSE]
        if sense != 0.0:
            rate = sense * ten_velocity[int(u[z + PAD_TENDON])]
            if rate < REST or sense * u[z + FORCE] < _ALIKE * bound:
                sense = u[z + SENSE] = 0.0
        if sense != 0.0:
            turns = turns or sense * force < _ALL * bound
        elif abs(force) < _ALIKE * bound or bound <= _LEAST * u[z - row % 2 + BOUND]:
            u[z + EXCESS] = np.nan
        else:
            near = True
    if not turns and not near:
        return
    _start_changes(effects, u, ten_velocity, friction_force, qacc)
    if turns:
        _turn_round(effects, u, ten_velocity)
    else:
        _give_way(effects, u, ten_velocity, friction_force)
    _apply_changes(effects, u, friction_force, qacc, qpos, constraint_force, sensordata)


@compilable
def _place(effects: Dispatch, row: int) -> int:
    """Return the place in `u` of a row: of its pad's block, plus its axis."""
    return effects.first_pad + row // 2 * effects.pad_block + row % 2


@compilable
def _start_changes(effects: Dispatch, u: Array, ten_velocity: Array, friction_force: Array, qacc: Array) -> None:
    """Find each row's rate at the step's end as solved, and what its friction lacks to all that it may carry."""
    for pad in range(int(u[N_PADS])):
        learn_rate_dependence(u, effects.first_pad + pad * effects.pad_block)
    for row in range(2 * int(u[N_PADS])):
        z = _place(effects, row)
        j = z - row % 2 + PAD_JACOBIAN + row % 2 * MAX_DOFS
        acceleration = 0.0
        for dof in range(int(u[N_ARMS])):
            acceleration += u[j + dof] * qacc[dof]
        u[z + END_RATE] = ten_velocity[int(u[z + PAD_TENDON])] + u[DT] * acceleration
        force = -friction_force[int(u[z + FRICTION_ROW])]
        sense = u[z + SENSE]
        if sense == 0.0:
            sense = 1.0 if force > 0.0 else -1.0
        before = u[z + ROW_BOUND]
        if u[z + SENSE] != 0.0:
            before = _carried(u, z, row % 2, 0.5 * u[z + SENSE] * ten_velocity[int(u[z + PAD_TENDON])])
        u[z + CHANGE] = sense * before - force
        u[z + TRIAL] = 0.0
        u[z + LATE] = np.nan
        u[z + BEND] = 0.0


@compilable
def _turn_round(effects: Dispatch, u: Array, ten_velocity: Array) -> None:
    """Split the step of rows that stop sliding at the event: they slide back from there on, or stick as solved.

    Sets the changes of all rows and the senses that they end with.
    """
    dt, n_rows = u[DT], 2 * int(u[N_PADS])
    for row in range(n_rows):
        z = _place(effects, row)
        u[z + EXCESS] = np.nan
        if u[z + SENSE] == 0.0:
            u[z + CHANGE] = 0.0
    for row in range(n_rows):  # as if friction kept its sense to the end of the step
        z = _place(effects, row)
        sense = u[z + SENSE]
        end = sense * (u[z + END_RATE] + dt * _response(effects, u, row, CHANGE))
        if end < 0.0:
            start = sense * ten_velocity[int(u[z + PAD_TENDON])]
            u[z + LATE] = dt * (start / (start - end) - 0.5)
            u[z + END_RATE] = 0.0
            u[z + EXCESS] = end
    for _ in range(
        2
    ):  # and as if it had the other sense from the event on: at a rate that is found by the second round
        for row in range(n_rows):
            z = _place(effects, row)
            if not isnan(u[z + LATE]):
                before = _carried(u, z, row % 2, 0.5 * u[z + SENSE] * ten_velocity[int(u[z + PAD_TENDON])])
                after = _carried(u, z, row % 2, max(-0.5 * u[z + END_RATE], 0.0))
                u[z + TRIAL] = -u[z + SENSE] * (before + after) * (0.5 - u[z + LATE] / dt)
        for row in range(n_rows):
            z = _place(effects, row)
            if not isnan(u[z + LATE]):
                u[z + END_RATE] = u[z + EXCESS] + dt * u[z + SENSE] * _response(effects, u, row, TRIAL)
    for row in range(n_rows):
        z = _place(effects, row)
        late, sense, most = u[z + LATE], u[z + SENSE], 2.0 * u[z + ROW_BOUND]
        if isnan(late):
            continue
        if u[z + END_RATE] < 0.0:
            # The rate of the step before that leads on to the rates after the event: the law asks for it.
            start = ten_velocity[int(u[z + PAD_TENDON])]
            back = u[z + EXCESS] - sense * start + (u[z + END_RATE] - u[z + EXCESS]) / (0.5 - late / dt)
            u[z + LAST_VELOCITY] = sense * (u[z + END_RATE] - back)
            u[z + CHANGE] += u[z + TRIAL]
            u[z + SENSE] = -sense
            bend = -sense * most
        else:
            bend = -u[z + CHANGE] * dt / max(0.5 * dt - late, 1e-3 * dt)
            bend = min(max(bend, -most), most)
            u[z + CHANGE] = 0.0
            u[z + SENSE] = 0.0
        u[z + EXCESS] = np.nan
        u[z + BEND] = 0.5 * bend * late * late


@compilable
def _carried(u: Array, z: int, axis: int, rate: float) -> float:
    """Return what a row may carry at a small slip rate [m/s], at `z` its pad's block plus its axis."""
    pad = z - axis
    return u[z + ROW_BOUND] / u[pad + OVER_REST] * (1.0 + u[pad + RATE_SHARE] * rate)


@compilable
def _give_way(effects: Dispatch, u: Array, ten_velocity: Array, friction_force: Array) -> None:
    """Let rows that stick begin to slide when friction cannot hold them any more.

    Sets the changes of all rows and the senses that they end with.
    """
    dt, n_rows = u[DT], 2 * int(u[N_PADS])
    for row in range(n_rows):
        z = _place(effects, row)
        if u[z + SENSE] == 0.0 and u[z + ROW_BOUND] > _LEAST * u[z - row % 2 + BOUND]:
            force = -friction_force[int(u[z + FRICTION_ROW])]
            u[z + TRIAL] = u[z + ROW_BOUND] if force > 0.0 else -u[z + ROW_BOUND]
        else:
            u[z + CHANGE] = 0.0
    for row in range(n_rows):
        z = _place(effects, row)
        if u[z + TRIAL] == 0.0:
            continue
        sense = 1.0 if u[z + TRIAL] > 0.0 else -1.0
        end = u[z + END_RATE] + dt * _response(effects, u, row, CHANGE)
        now = sense * (end - ten_velocity[int(u[z + PAD_TENDON])]) / dt
        grown = now - u[z + EXCESS]  # nan where nothing is known of the step before
        u[z + EXCESS] = now
        alike = abs(u[z + FORCE]) >= _ALIKE * u[z + ROW_BOUND] and u[z + FORCE] * u[z + TRIAL] > 0.0
        if alike and grown > 0.0 and abs(now) < 0.5 * grown:
            rate = dt * (0.5 * (now + 0.5 * grown) ** 2 / grown - max(now, 0.0))
            whole = dt * sense * _response(effects, u, row, TRIAL)
            u[z + LATE] = max(rate / whole, -1.0) if whole < 0.0 else 0.0
        elif abs(u[z + CHANGE]) <= (1.0 - _ALL) * u[z + ROW_BOUND]:
            u[z + LATE] = 0.0
    for row in range(n_rows):
        z = _place(effects, row)
        if not isnan(u[z + LATE]):
            u[z + CHANGE] = u[z + LATE] * u[z + TRIAL]
            u[z + SENSE] = 1.0 if u[z + TRIAL] > 0.0 else -1.0
            u[z + EXCESS] = np.nan
        elif u[z + TRIAL] != 0.0:
            u[z + CHANGE] = 0.0


@compilable
def _response(effects: Dispatch, u: Array, row: int, forces: int) -> float:
    """Return the acceleration [m/s^2] of a row's slip under the forces that stand at a place of every pad's block."""
    n_rows, n_dofs = 2 * int(u[N_PADS]), int(u[N_DOFS])
    size = n_dofs + n_rows + int(u[N_ACCELERATIONS])
    at = int(u[RESPONSES]) + n_dofs + row
    acceleration = 0.0
    for other in range(n_rows):
        z = _place(effects, other)
        acceleration += u[at + other * size] * u[z + forces]
    return acceleration


@compilable
def _apply_changes(
    effects: Dispatch, u: Array, friction_force: Array, qacc: Array, qpos: Array, constraint_force: Array,
    sensordata: Array,
) -> None:  # fmt: skip
    """Change forces, accelerations, their readings and positions by what the rows' mean forces change."""
    n_rows, n_dofs, n_readings = 2 * int(u[N_PADS]), int(u[N_DOFS]), int(u[N_ACCELERATIONS])
    first = int(u[ACCELERATIONS])
    for row in range(n_rows):
        z = _place(effects, row)
        change, bend = u[z + CHANGE], u[z + BEND]
        if change == 0.0 and bend == 0.0:
            continue
        friction_force[int(u[z + FRICTION_ROW])] -= change
        at = int(u[RESPONSES]) + row * (n_dofs + n_rows + n_readings)
        for dof in range(n_dofs):
            qacc[dof] += u[at + dof] * change
            qpos[dof] += u[at + dof] * bend
        at += n_dofs + n_rows
        for i in range(n_readings):
            sensordata[first + i] += u[at + i] * change
        # Where joints are damped, MuJoCo integrates from the forces and not from the accelerations.
        j = z - row % 2 + PAD_JACOBIAN + row % 2 * MAX_DOFS
        for dof in range(int(u[N_ARMS])):
            constraint_force[dof] -= u[j + dof] * change
