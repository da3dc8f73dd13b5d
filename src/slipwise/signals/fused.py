"""Position and velocity from a displacement gauge and accelerometers together: a Rauch-Tung-Striebel smoother.

State [x, v, b]: dx/dt = v, dv/dt = a - b, db/dt = white noise. x is measured with white noise, a (relative
acceleration) with white noise per sample, b is the bias of the accelerometers. Without accelerometers a = 0, and b,
now minus the acceleration itself, wanders faster; where an actuator changes its speed at once, v may jump. A recorded
velocity is a second measurement.

Source: Rauch, Tung, Striebel (1965), AIAA Journal 3:1445-1450. Speed decides everything near a reversal: differentiated
slip errs by 1-7 mm/s, this by 0.15 mm/s for noise of 0.02 mm and 0.036 m/s^2 at 500 Hz.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize

from slipwise.arrays import Array
from slipwise.errors import InputError
from slipwise.signals.noise import white_level
from slipwise.signals.sampled_jumps import squared_jumps
from slipwise.signals.smoother import smooth, unlikelihood

#: A bias wanders by about this in one second [m/s^2].
_BIAS_WALK = 3e-4
#: Spread of the first state: wide against everything a rig does (position [m], velocity [m/s], bias [m/s^2]).
_FIRST = (1.0, 3.0, 0.5)
#: Least noise of gauges, of one that never moves too: position [m], velocity [m/s], acceleration [m/s^2].
_STILL = (1e-9, 1e-8, 1e-6)
#: Span of a motion that is taken where a gauge shows none: a filter that expects none at all is singular [m].
_ONE_STROKE = 1e-3
#: Without accelerometers b is the acceleration itself.
_FIRST_ACCELERATION = 300.0
#: Jumps of the speed at most, samples about the strongest acceleration in which one is looked for, and by how much it
#: must make the measurements likelier [nats].
_MOST_JUMPS, _NEAR_JUMP, _SURE_JUMP = 8, 60, 20.0
#: Samples used to find the noise levels; more tell nothing new.
_SEARCH = 20000


@dataclass(frozen=True)
class Fused:
    """What the smoother gives.

    Attributes:
        position: (n,) [m].
        velocity: (n,) [m/s].
        acceleration: (n,) relative, without the bias [m/s^2]; from the slip alone where no accelerometer was given.
        bias: (n,) of the accelerometers [m/s^2]; 0 without them.
        velocity_error: standard deviation that the smoother expects of its own velocity, in the middle [m/s].
        velocity_errors: (n,) as `velocity_error`, where it differs from sample to sample; else None.
        position_error: standard deviation of one sample's position [m]; 0 with accelerometers, for an error of their
            position is the same over many samples, and a law feels ways, not places.
    """

    position: Array
    velocity: Array
    acceleration: Array
    bias: Array
    velocity_error: float
    velocity_errors: Array | None = None
    position_error: float = 0.0


def fuse(
    time: Array,
    position: Array,
    acceleration: Array | None = None,
    velocity: Array | None = None,
    levels: tuple[float, float] | None = None,
    *,
    may_jump: bool = False,
    undersampled: bool = False,
) -> Fused:
    """Fuse a displacement gauge with accelerometers, or smooth it alone.

    Noise levels that are not known are those under which the smoother's own one-step predictions are most likely
    (maximum likelihood), starting from the top of each channel's spectrum.

    Args:
        time: (n,) strictly rising [s]; steps may differ.
        position: (n,) [m]; NaN where a sample is missing.
        acceleration: (n,) of the same motion [m/s^2], without NaN; None when there is none.
        velocity: (n,) recorded velocity [m/s], NaN where missing; None when there is none.
        levels: noise of one sample of position [m] and acceleration [m/s^2], as if it were white; None: not known. A
            recorded velocity, or no acceleration, leaves more to be known, and they are not used.
        undersampled: whether the acceleration was sampled without a filter, so that nobody knows at which instant of a
            step it jumped: speed may then be wrong by J dt/sqrt(12) after a jump J.
        may_jump: whether the speed may change at once, as an actuator's does; looked for where only the gauge is known.

    Raises:
        InputError: fewer than 8 samples, or an acceleration with gaps.
    """
    if np.count_nonzero(np.isfinite(position)) < 8:
        raise InputError(f"{len(position)} samples of a position are too few for a velocity; give at least 8")
    if acceleration is not None and not np.isfinite(acceleration).all():
        raise InputError("an acceleration with missing samples cannot be integrated: fill or cut them first")
    steps = np.diff(time)
    ramp, half = _increments(time, acceleration)
    place = np.stack([position, np.full(len(time), np.nan) if velocity is None else velocity], axis=1)
    centre = float(np.nanmedian(position))
    place[:, 0] -= centre
    dt = float(np.median(steps))
    first = _start_levels(place, acceleration, dt)
    if levels is not None and acceleration is not None and velocity is None:
        found = np.maximum([levels[0], first[1], levels[1]], _STILL)
    else:
        found = _likeliest(steps, ramp, half, place, first, accelerometers=acceleration is not None)
    variances = _variances(found, dt, accelerometers=acceleration is not None)
    jumps = np.zeros(len(steps))
    if may_jump and acceleration is None and velocity is None:
        found, variances, jumps = _with_jumps(steps, ramp, half, place, found)
    if undersampled and acceleration is not None:
        jumps = squared_jumps(acceleration, float(found[2])) * steps**2 / 12.0
    state, spreads = smooth(steps, ramp, half, place, *variances, jumps)
    spread = spreads[:, 1]
    with_bias = state[:, 2] if acceleration is not None else np.zeros(len(time))
    relative = -state[:, 2] if acceleration is None else acceleration - state[:, 2]
    return Fused(
        position=state[:, 0] + centre,
        velocity=state[:, 1],
        acceleration=relative,
        bias=with_bias,
        velocity_error=float(np.sqrt(np.median(spread) if undersampled else spread[len(time) // 2])),
        velocity_errors=np.sqrt(spread) if undersampled and jumps.any() else None,
        position_error=float(np.sqrt(spreads[len(time) // 2, 0])) if acceleration is None else 0.0,
    )


def fuse_scaled(time: Array, position: Array, velocity: Array | None, seconds: float, metres: float) -> Fused:
    """Smooth the gauge of an actuator, in units of a test whose times and lengths are of another size.

    Args:
        time: as `fuse`.
        position: as `fuse`.
        velocity: as `fuse`.
        seconds: how many times longer things take than on the reference rig [1].
        metres: how many times longer its ways are [1].
    """
    speed = metres / seconds
    found = fuse(
        time / seconds, position / metres, velocity=None if velocity is None else velocity / speed, may_jump=True
    )
    return Fused(
        position=found.position * metres,
        velocity=found.velocity * speed,
        acceleration=found.acceleration * speed / seconds,
        bias=found.bias * speed / seconds,
        velocity_error=found.velocity_error * speed,
        position_error=found.position_error * metres,
    )


def _increments(time: Array, acceleration: Array | None) -> tuple[Array, Array]:
    """Return each step's gain of velocity and of position from a known acceleration, by its spline's integrals."""
    if acceleration is None:
        return np.zeros(len(time) - 1), np.zeros(len(time) - 1)
    spline = CubicSpline(time, acceleration)
    once, twice = spline.antiderivative(1)(time), spline.antiderivative(2)(time)
    return np.diff(once), np.diff(twice) - once[:-1] * np.diff(time)


def _start_levels(place: Array, acceleration: Array | None, dt: float) -> Array:
    """Guess (position noise, velocity noise, driving noise) from the tops of the spectra."""
    span = float(np.nanmax(place[:, 0]) - np.nanmin(place[:, 0]))
    span = span if span > _STILL[0] else _ONE_STROKE
    gauge = max(white_level(place[:, 0]), 1e-6 * span, _STILL[0])
    speed = white_level(place[:, 1])
    if acceleration is not None:
        return np.array([gauge, max(speed, _STILL[1]), max(white_level(acceleration), _STILL[2])])
    # jerk of a motion that crosses its span in a quarter of a second
    return np.array([gauge, max(speed, 1e-3 * span / dt, _STILL[1]), max(span, gauge) * 1e3])


def _variances(levels: Array, dt: float, accelerometers: bool) -> tuple[float, float, float, float, Array]:
    """Return the variances of position and velocity, the densities of drive and bias walk, and the first spread."""
    gauge, speed, drive = levels
    if accelerometers:
        return gauge**2, speed**2, drive**2 * dt, _BIAS_WALK**2, np.square(_FIRST)
    return gauge**2, speed**2, 0.0, drive**2, np.square((*_FIRST[:2], _FIRST_ACCELERATION))


def _likeliest(
    steps: Array,
    ramp: Array,
    half: Array,
    place: Array,
    first: Array,
    *,
    accelerometers: bool,
    jumps: Array | None = None,
) -> NDArray[np.float64]:
    """Search the noise levels of largest likelihood, over their logarithms."""
    part = slice(0, _SEARCH)
    dt = float(np.median(steps))
    free = [0, 2] if np.isnan(place[:, 1]).all() else [0, 1, 2]

    none = np.zeros(len(steps)) if jumps is None else jumps

    def unlikely(logs: Array) -> float:
        levels = first.copy()
        levels[free] *= np.exp(np.clip(logs, -7.0, 7.0))
        variances = _variances(levels, dt, accelerometers)
        penalty = 0.5 * float(np.sum(np.square(logs))) / 3.0**2
        return unlikelihood(steps[part], ramp[part], half[part], place[: _SEARCH + 1], *variances, none[part]) + penalty

    start = np.zeros(len(free))
    spread = np.vstack([start, *(0.7 * np.eye(len(free)))])
    options = {"xatol": 0.02, "fatol": 0.1, "maxiter": 80, "initial_simplex": spread}
    found = minimize(unlikely, start, method="Nelder-Mead", options=options)
    levels = first.copy()
    levels[free] *= np.exp(np.clip(found.x, -7.0, 7.0))
    return levels


def _with_jumps(
    steps: Array, ramp: Array, half: Array, place: Array, plain: Array
) -> tuple[Array, tuple[float, float, float, float, Array], Array]:
    """Let the speed jump where that makes the measurements much likelier; gives levels, variances, jumps [m^2/s^2].

    An actuator that is told another speed changes it within a sample or two; noise levels of the whole record would
    smear that over a second.

    Args:
        steps: (n - 1,) [s].
        ramp: as `_increments`.
        half: as `_increments`.
        place: (n, 2) what was measured.
        plain: noise levels without any jump.
    """
    dt, levels = float(np.median(steps)), plain
    jumps = np.zeros(len(steps))
    variances = _variances(levels, dt, accelerometers=False)
    for _ in range(_MOST_JUMPS):
        state, _ = smooth(steps, ramp, half, place, *variances, jumps)
        here = unlikelihood(steps, ramp, half, place, *variances, jumps)
        strongest = int(np.argmax(np.where(np.append(jumps, 0.0) > 0.0, 0.0, np.abs(state[:, 2]))))
        size = float(np.ptp(state[:, 1])) ** 2
        best, where = here, -1
        for at in range(max(strongest - _NEAR_JUMP, 0), min(strongest + _NEAR_JUMP, len(steps))):
            tried = jumps.copy()
            tried[at] = size
            cost = unlikelihood(steps, ramp, half, place, *variances, tried)
            if cost < best:
                best, where = cost, at
        if where < 0 or here - best < _SURE_JUMP:
            break
        jumps[where] = size
        levels = _likeliest(steps, ramp, half, place, levels, accelerometers=False, jumps=jumps)
        variances = _variances(levels, dt, accelerometers=False)
    else:  # a motion that never stops to jump is better smoothed everywhere alike
        return plain, _variances(plain, dt, accelerometers=False), np.zeros(len(steps))
    return levels, variances, jumps
