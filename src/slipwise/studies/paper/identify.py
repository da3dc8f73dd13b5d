"""Fits s', n, k, alpha of eq. (7) to loads, speeds and friction of one pad, with intervals.

    min sum [F - |N| mu(N/A, |v|; s', n, k, alpha)]^2 / sigma^2 over samples that slide, parameters as logarithms

Covariance is (J' J)^-1 times the residual's variance; intervals are 95 %. Noise of load and speed is propagated into
the weights, so that samples whose speed says little count little.

Source: paper, below eq. (8), for what is identified; the method is not stated there.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import t as student

from slipwise.arrays import Array

NAMES = ("s'", "n", "k", "alpha")
#: Units in which the fit works: MPa, s/m, 1/MPa, 1.
_SCALE = np.array([1e6, 1.0, 1e-6, 1.0])
#: Slower samples may be sticking [m/s].
SLIDES = 0.01


@dataclass(frozen=True)
class PadData:
    """What was measured at one pad; all (n,).

    Attributes:
        load: [N].
        speed: |v| [m/s].
        friction: |F| [N].
    """

    load: Array
    speed: Array
    friction: Array


@dataclass(frozen=True)
class IdentifiedLaw:
    """Parameters of eq. (7), (4,) in the order s' [Pa], n [s/m], k [1/Pa], alpha [1].

    Attributes:
        values: best fit.
        low: lower end of the 95 % interval.
        high: upper end.
        deviation: standard deviation of the logarithm, i.e. relative [1].
        correlation: (4, 4) of the logarithms [1].
        residual: rms residual over rms friction [1].
        samples: that were used.
    """

    values: Array
    low: Array
    high: Array
    deviation: Array
    correlation: Array
    residual: float
    samples: int


def friction_law(load: Array, speed: Array, area: float, values: Array) -> Array:
    """Return the friction of eq. (7) [N]; loads [N], speeds [m/s], values as in `IdentifiedLaw`.

    Source: paper, eq. (7) with exp(-kP).
    """
    strength, rate, saturation, slow = values
    return area * strength * -np.expm1(-rate * speed) * -np.expm1(-saturation * load / area) + slow * load


def with_noise(data: PadData, load: float, speed: float, friction: float, rng: np.random.Generator) -> PadData:
    """Add white noise of these rms values [N, m/s, N]; independent samples, as after a logger's decimation."""
    size = data.load.shape
    return PadData(
        data.load + load * rng.standard_normal(size),
        np.abs(data.speed + speed * rng.standard_normal(size)),
        data.friction + friction * rng.standard_normal(size),
    )


def identify(
    data: PadData,
    area: float,
    start: Array,
    noise: tuple[float, float, float] = (0.0, 0.0, 1.0),
    fixed: tuple[int, ...] = (),
) -> IdentifiedLaw:
    """Fit the four parameters.

    Args:
        data: of one pad.
        area: apparent, of the pad [m^2].
        start: (4,) first guess, as in `IdentifiedLaw`.
        noise: rms noise of load [N], speed [m/s], friction [N]; only their ratio matters.
        fixed: indices of parameters that keep their start value; their interval is nothing.
    """
    slides = data.speed > SLIDES
    load, speed, friction = data.load[slides], data.speed[slides], data.friction[slides]
    free = [i for i in range(4) if i not in fixed]
    first = np.log(start / _SCALE)

    def law(logs: Array, n: Array, v: Array) -> Array:
        return friction_law(n, v, area, np.exp(logs) * _SCALE)

    by_load = (law(first, load * 1.001, speed) - law(first, load * 0.999, speed)) / (0.002 * load)
    by_speed = (law(first, load, speed * 1.001) - law(first, load, speed * 0.999)) / (0.002 * speed)
    sigma = np.sqrt((by_load * noise[0]) ** 2 + (by_speed * noise[1]) ** 2 + noise[2] ** 2)

    def residual(chosen: Array) -> Array:
        logs = first.copy()
        logs[free] = chosen
        return (friction - law(logs, load, speed)) / sigma

    answer = least_squares(
        residual, first[free], method="trf", x_scale=0.3, bounds=(first[free] - 5.0, first[free] + 5.0)
    )
    degrees = len(load) - len(free)
    variance = 2.0 * answer.cost / degrees
    covariance = np.linalg.pinv(answer.jac.T @ answer.jac) * variance
    own = np.sqrt(np.diag(covariance))
    logs, deviation, correlation = first.copy(), np.zeros(4), np.eye(4)
    logs[free], deviation[free] = answer.x, own
    correlation[np.ix_(free, free)] = covariance / np.outer(own, own)
    values = np.exp(logs) * _SCALE
    width = np.exp(student.ppf(0.975, degrees) * deviation)
    left = friction - law(logs, load, speed)
    return IdentifiedLaw(
        values,
        values / width,
        values * width,
        deviation,
        correlation,
        float(np.sqrt(np.mean(left**2) / np.mean(friction**2))),
        len(load),
    )
