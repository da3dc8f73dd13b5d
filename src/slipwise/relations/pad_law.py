"""Pads' forces as a logger would have written them: the law at every instant, then the logger's filter."""

from collections.abc import Sequence
from math import sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, next_fast_len, rfft, rfftfreq

from slipwise.arrays import Array
from slipwise.jobs.machine_code import kept
from slipwise.relations.evaluation_times import Instants
from slipwise.relations.run_data import FitRun
from slipwise.signals.filters import LowPass, folded, response
from slipwise.simulation.predict import PadForces, Predictor

#: Samples by which a force is carried on at both ends before it is filtered.
_BEYOND = 64


#: Steps per instant in which the stick of the pads is followed.
_STICK_STEPS = 6


@kept()
def _stick(along, step, length, lag, parts, share):  # pragma: no cover - compiled
    """Follow an elastic-plastic stick of some micrometres; fills the mean of its share around each instant."""
    count, pads = along.shape
    for pad in range(pads):
        z = 0.0
        for i in range(count):
            before = 0.5 * (along[max(i - 1, 0), pad] + along[i, pad])
            after = 0.5 * (along[i, pad] + along[min(i + 1, count - 1), pad])
            side = length if along[i, pad] > 0.0 else -length
            if z == side and before * side > 0.0 and after * side > 0.0:  # it slides on the way it did
                share[i, pad] = side / length
                continue
            total = 0.0
            for j in range(parts):
                at = (j + 0.5) / parts
                if at < 0.5:
                    speed = before + (along[i, pad] - before) * 2.0 * at
                else:
                    speed = along[i, pad] + (after - along[i, pad]) * (2.0 * at - 1.0)
                old = z
                z = min(max(z + speed * step / parts, -length), length)
                total += min(max(0.5 * (old + z) + lag * speed, -length), length)
            share[i, pad] = total / (parts * length)


@kept()
def _smoothed_reversal(force, bound, velocity, share, out):  # pragma: no cover - compiled
    """Put the share of a stick in the place of the sharp reversal of a bound that acts along the motion."""
    for i in range(bound.shape[0]):
        for pad in range(bound.shape[1]):
            along, across = velocity[i, pad, 0], velocity[i, pad, 1]
            speed = sqrt(along * along + across * across)
            share_along = abs(along) / speed if speed > 0.0 else 1.0
            sharp = along / speed if speed > 0.0 else 0.0
            out[i, pad] = force[i, pad, 0] + bound[i, pad] * (share[i, pad] * share_along - sharp)


def compute_stick_share(state: Instants, stick_length: float, stick_damping: float) -> Array:
    """Return mean share of the bound that acts along x, half an instant before to half an instant after, (f, p) [1].

    A spring and a damper side by side, (z + t_d dz/dt) / u, and no more than the bound.

    Args:
        state: of the pads.
        stick_length: u, slip over which a pad's friction reverses [m]: micrometres, the shear of pad and cell.
        stick_damping: t_d [s].
    """
    along = np.ascontiguousarray(state.velocity[:, :, 0])
    followed = along[:, :1].copy() if bool(np.all(along == along[:, :1])) else along
    share = np.zeros_like(followed)
    _stick(followed, state.time[1] - state.time[0], stick_length, stick_damping, _STICK_STEPS, share)
    return np.broadcast_to(share, along.shape)


def drive_law(
    law: Predictor, runs: Sequence[FitRun], states: Sequence[Instants], motions: Sequence[Array] | None
) -> list[PadForces]:
    """Return force (f, p, 2) and bound (f, p) of every pad at the instants [N], of one run after another.

    Args:
        law: a model's laws, nothing slid yet; their memory goes on from run to run.
        runs: in the order in which they were made.
        states: of the pads, per run.
        motions: per run motion of the rig at the instants (f, 3), where the law asks for it.
    """
    out = []
    for i, (run, state) in enumerate(zip(runs, states, strict=True)):
        law.rest(run.rest_before)
        if not law.model.specimen.free:  # a slider's actuator may have left it bent either way
            force = np.stack([run.force[0], np.zeros(len(run.pads))], axis=1)
            law.begin(state.load[0], state.velocity[0], state.slip[0], force)
        motion = motions[i] if motions is not None else None
        out.append(law.pads(state.time, state.load, state.velocity, state.slip, run.pads, motion))
    return out


def sum_forces_along(found: PadForces, state: Instants, share: Array | None) -> Array:
    """Return the force of every pad along x at the instants, (f, p) [N].

    Args:
        found: of the law.
        state: of the pads, for which the law was evaluated.
        share: of the bound that acts, see `compute_stick_share`; None for a law that knows itself how a pad sticks.
    """
    if share is None:
        return found.force[:, :, 0]
    out = np.empty(found.bound.shape)
    _smoothed_reversal(found.force, found.bound, np.ascontiguousarray(state.velocity), share, out)
    return out


def estimate_lost_velocity(force: Array, run: FitRun, compliance: Array, by: LowPass | None) -> Array:
    """Return what the logger's filter takes from the pads' velocity where friction reverses, (f, p) [m/s].

    dv_i/dt = -sum_j C_ij F_j + (what has no kinks), so the kinks of v that the filter H rounds off are those of F's
    integral: v - H v = -(1 - H) C F / (i w). Without them a reversal seems to come up to half a millisecond off.

    Args:
        force: (f, p) at the instants [N].
        run: whose filter.
        compliance: C (p, p), acceleration of pad i for a force on pad j: 1/m, and y_i y_j / I where the girder yaws.
        by: the filter where the campaign does not know it.
    """
    filtered = run.filtered or by
    if filtered is None:
        return np.zeros(force.shape)
    push = force @ compliance.T
    step = run.dt / run.fine
    size = int(next_fast_len(len(push) + 2 * _BEYOND) or 0)
    before, after = np.repeat(push[:1], _BEYOND, axis=0), np.repeat(push[-1:], size - len(push) - _BEYOND, axis=0)
    frequency = rfftfreq(size, step)
    missing = 1.0 - np.abs(response(filtered, np.asarray(frequency, dtype=np.float64)))
    turn = 2j * np.pi * np.where(frequency > 0.0, frequency, 1.0)
    spectrum = np.asarray(rfft(np.concatenate([before, push, after]), axis=0)) * (missing / turn)[:, None]
    return -np.asarray(irfft(spectrum, size, axis=0))[_BEYOND : _BEYOND + len(push)]


_GAINS: dict[tuple[int, float, LowPass, bool, int], NDArray[np.inexact]] = {}


def log_force(force: Array, run: FitRun, by: LowPass | None, *, averaged: bool, delay: float = 0.0) -> Array:
    """Filter a force given at the instants (f, p) as the logger did and keep the samples (n, p).

    The states lag as much as the force does, so only the gain of a filter counts, but for what the samples fold.

    Args:
        force: (f, p) [N].
        run: whose samples and filter.
        by: the filter where the campaign does not know it.
        averaged: each instant stands for the mean from half an instant before to half an instant after; the droop
            sin(x)/x of that mean is taken out again.
        delay: of the force behind the states [s].
    """
    filtered = run.filtered or by
    if filtered is None and delay == 0.0:
        return force[:: run.fine]
    size = int(next_fast_len(len(force) + 2 * _BEYOND) or 0)
    step = run.dt / run.fine
    gain = _gain(size, step, filtered, averaged, run.fine) if filtered else np.ones(size // 2 + 1)
    if delay != 0.0:
        gain = gain * np.exp(-2j * np.pi * delay * rfftfreq(size, step))
    before, after = np.repeat(force[:1], _BEYOND, axis=0), np.repeat(force[-1:], size - len(force) - _BEYOND, axis=0)
    spectrum = np.asarray(rfft(np.concatenate([before, force, after]), axis=0)) * gain[:, None]
    return np.asarray(irfft(spectrum, size, axis=0))[_BEYOND : _BEYOND + len(force) : run.fine]


def _gain(size: int, step: float, by: LowPass, averaged: bool, fine: int) -> NDArray[np.inexact]:
    key = (size, round(step, 9), by, averaged, fine)
    if key not in _GAINS:
        if len(_GAINS) > 64:
            _GAINS.clear()
        frequency = np.asarray(rfftfreq(size, step), dtype=np.float64)
        gain = folded(by, frequency, 1.0 / (step * fine)) if by.phase == "aligned" else np.abs(response(by, frequency))
        _GAINS[key] = gain / np.sinc(frequency * step) if averaged else gain
    return _GAINS[key]
