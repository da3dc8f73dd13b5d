"""Pads' forces as a logger would have written them: the law at every instant, then the logger's filter."""

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.fft import irfft, rfft, rfftfreq
from numpy.typing import NDArray
from scipy.fft import next_fast_len

from slipwise.fit.data import FINE, FitRun, refined
from slipwise.model import Model
from slipwise.predict import predictor
from slipwise.signals import LowPass, response

Array = NDArray[np.float64]
#: Samples by which a force is carried on at both ends before it is filtered.
_BEYOND = 64


#: Steps per instant in which the stick of the pads is followed.
_STICK_STEPS = 6


@dataclass(frozen=True)
class Instants:
    """States of one run at the instants at which the laws are evaluated (n f, with f = 2 n - 1).

    Attributes:
        time: (f,) [s].
        load: (f, p) [N].
        velocity: (f, p, 2) [m/s].
        slip: (f, p, 2) [m].
        share: (f, p) mean share of the bound that acts along x, half an instant before to half an instant after [1].
    """

    time: Array
    load: Array
    velocity: Array
    slip: Array
    share: Array


@njit(cache=True)
def _stick(along, step, length, parts, share):  # pragma: no cover - compiled
    """Follow an elastic-plastic stick of some micrometres; fills the mean of z/length around each instant."""
    count, pads = along.shape
    for pad in range(pads):
        z = 0.0
        for i in range(count):
            before = 0.5 * (along[max(i - 1, 0), pad] + along[i, pad])
            after = 0.5 * (along[i, pad] + along[min(i + 1, count - 1), pad])
            total = 0.0
            for j in range(parts):
                at = (j + 0.5) / parts
                if at < 0.5:
                    speed = before + (along[i, pad] - before) * 2.0 * at
                else:
                    speed = along[i, pad] + (after - along[i, pad]) * (2.0 * at - 1.0)
                old = z
                z = min(max(z + speed * step / parts, -length), length)
                total += 0.5 * (old + z)
            share[i, pad] = total / (parts * length)


def instants(run: FitRun, velocity: Array, slip: Array, stick_length: float, lost: Array | None = None) -> Instants:
    """Refine the states of a run.

    Args:
        run: its loads and times.
        velocity: (n, p, 2) of each pad [m/s].
        slip: (n, p, 2) of each pad [m].
        stick_length: slip over which a pad's friction turns round [m]: micrometres, the shear of pad and cell.
        lost: (f,) what the logger's filter took from the velocity, see `lost_velocity` [m/s].
    """
    time = np.linspace(run.time[0], run.time[-1], FINE * (len(run.time) - 1) + 1)
    fine = refined(velocity)
    if lost is not None:
        fine[:, :, 0] += lost[:, None]
    along = np.ascontiguousarray(fine[:, :, 0])
    share = np.zeros_like(along)
    alike = bool(np.all(along == along[:, :1]))
    followed = along[:, :1].copy() if alike else along
    out = np.zeros_like(followed)
    _stick(followed, run.dt / FINE, stick_length, _STICK_STEPS, out)
    share[:] = out
    return Instants(time, np.maximum(refined(run.load), 0.0), fine, refined(slip), share)


@dataclass
class PadLaw:
    """A model's pad laws driven through a campaign's runs, one after another, memory included."""

    model: Model

    def __post_init__(self) -> None:
        """Make the law ready."""
        self._predictor = predictor(self.model)

    def set(self, model: Model) -> None:
        """Take other parameter values of the same effects."""
        self.model = model
        self._predictor.model = model

    def at_instants(self, runs: list[FitRun], states: list[Instants]) -> list[Array]:
        """Give the force of every pad along x at the instants, a list of (f, p) [N]."""
        law = self._predictor
        law.reset()
        bristle = bool(self.model.with_hook("stick"))
        out = []
        for run, state in zip(runs, states, strict=True):
            law.rest(run.rest_before)
            found = law.pads(state.time, state.load, state.velocity, state.slip)
            force = found.force[:, :, 0]
            if not bristle:
                along, across = state.velocity[:, :, 0], state.velocity[:, :, 1]
                speed = np.hypot(along, across)
                sharp = np.divide(along, speed, out=np.zeros_like(along), where=speed > 0.0)
                turned = np.divide(np.abs(along), speed, out=np.ones_like(along), where=speed > 0.0)
                force = force + found.bound * (state.share * turned - sharp)
            out.append(force)
        return out

    def forces(self, runs: list[FitRun], states: list[Instants], by: LowPass | None, late: float = 0.0) -> list[Array]:
        """Give the force of every pad along x as measured, a list of (n, p) [N].

        Args:
            runs: in the order in which they were made.
            states: of each run.
            by: the logger's filter where the campaign does not know it.
            late: by which the friction channels lag behind the others [s].
        """
        averaged = not self.model.with_hook("stick")
        found = zip(self.at_instants(runs, states), runs, strict=True)
        return [as_logged(force, run, by, averaged=averaged, late=late) for force, run in found]


def lost_velocity(force: Array, run: FitRun, mass: float, by: LowPass | None) -> Array:
    """Give what the logger's filter takes from the girder's velocity where friction turns round, (f,) [m/s].

    m dv/dt = -F + (what has no kinks), so the kinks of v that the filter H rounds off are those of F's integral:
    v - H v = -(1 - H) F / (m i w). Without them a reversal seems to come up to half a millisecond off.

    Args:
        force: (f,) sum over the pads at the instants [N].
        run: whose filter.
        mass: of the girder [kg].
        by: the filter where the campaign does not know it.
    """
    filtered = run.filtered or by
    if filtered is None:
        return np.zeros(len(force))
    step = run.dt / FINE
    size = int(next_fast_len(len(force) + 2 * _BEYOND) or 0)
    padded = np.concatenate([np.repeat(force[:1], _BEYOND), force, np.repeat(force[-1:], size - len(force) - _BEYOND)])
    frequency = rfftfreq(size, step)
    missing = 1.0 - np.abs(response(filtered, np.asarray(frequency, dtype=np.float64)))
    turn = 2j * np.pi * np.where(frequency > 0.0, frequency, 1.0)
    return -irfft(rfft(padded) * (missing / turn), size)[_BEYOND : _BEYOND + len(force)] / mass


_GAINS: dict[tuple[int, float, LowPass, bool], Array] = {}


def as_logged(force: Array, run: FitRun, by: LowPass | None, *, averaged: bool, late: float = 0.0) -> Array:
    """Filter a force given at the instants (f, p) as the logger did and keep the samples (n, p).

    The states lag as much as the force does, so only the gain of a filter counts.

    Args:
        force: (f, p) [N].
        run: whose samples and filter.
        by: the filter where the campaign does not know it.
        averaged: each instant stands for the mean from half an instant before to half an instant after; the droop
            sin(x)/x of that mean is taken out again.
        late: by which the force lags behind the states [s].
    """
    filtered = run.filtered or by
    if filtered is None and late == 0.0:
        return force[::FINE]
    size = int(next_fast_len(len(force) + 2 * _BEYOND) or 0)
    step = run.dt / FINE
    gain = _gain(size, step, filtered, averaged) if filtered else np.ones(size // 2 + 1)
    if late != 0.0:
        gain = gain * np.exp(-2j * np.pi * late * rfftfreq(size, step))
    before, after = np.repeat(force[:1], _BEYOND, axis=0), np.repeat(force[-1:], size - len(force) - _BEYOND, axis=0)
    spectrum = rfft(np.concatenate([before, force, after]), axis=0) * gain[:, None]
    return irfft(spectrum, size, axis=0)[_BEYOND : _BEYOND + len(force) : FINE]


def _gain(size: int, step: float, by: LowPass, averaged: bool) -> Array:
    key = (size, round(step, 9), by, averaged)
    if key not in _GAINS:
        if len(_GAINS) > 64:
            _GAINS.clear()
        frequency = rfftfreq(size, step)
        gain = np.abs(response(by, np.asarray(frequency, dtype=np.float64)))
        _GAINS[key] = gain / np.sinc(frequency * step) if averaged else gain
    return _GAINS[key]
