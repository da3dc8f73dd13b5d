"""Which law of friction another program's output follows: families of laws, from plain to rich, fitted to its forces.

    one coefficient             F = mu N
    speed                       F = [f_max - (f_max - f_min) exp(-a V)] N
    speed and pressure          F = A s' [1 - exp(-n V)] [1 - exp(-k P)] + alpha N

and the first two with the load at rest N_0 in place of N, as elements have it to which a constant load is given. A
calculation has no noise, so the plainest law that leaves next to nothing is the one that was calculated with.

Source: Constantinou, Mokha, Reinhorn (1990), Journal of Structural Engineering 116(2), for the law of speed; paper,
eq. (7), for that of speed and pressure.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from slipwise.arrays import Array
from slipwise.campaign import Run
from slipwise.errors import InputError
from slipwise.short_repr import short_repr

#: Friction is looked at where a pad slides faster than this share of the run's largest speed, and is pressed by more
#: than this share of its load at rest [1].
_SLIDING, _PRESSED = 0.02, 0.1
#: A plainer law is taken where it leaves less than this share of the rms of friction, or less than so many times what
#: the richest one leaves [1].
_EXACT, _AS_GOOD = 0.01, 1.3
#: A law that leaves more than this share is not the one that was calculated with [1].
_FOREIGN = 0.05
#: Samples that are fitted at most: a calculation without noise needs no more.
_SAMPLES = 6000


@short_repr
@dataclass(frozen=True)
class Sliding:
    """Samples of sliding pads.

    Attributes:
        speed: (n,) [m/s].
        load: (n,) at the sample [N].
        rest: (n,) the same pad's load at rest [N].
        area: (n,) of the pad [m^2].
        force: (n,) friction, positive [N].
    """

    speed: Array
    load: Array
    rest: Array
    area: Array
    force: Array


@short_repr
@dataclass(frozen=True)
class Family:
    """A family of laws.

    Attributes:
        name: short.
        words: as the end of "friction is ...".
        with_speed: whether friction depends on speed.
        follows_load: whether friction follows the load of the moment.
        with_pressure: whether its coefficient depends on pressure.
        numbers: name -> (unit, where a fit begins); all positive.
        law: friction of samples, for the numbers in order.
    """

    name: str
    words: str
    with_speed: bool
    follows_load: bool
    with_pressure: bool
    numbers: Mapping[str, tuple[str, float]]
    law: Callable[[Sliding, Sequence[float]], Array]


@short_repr
@dataclass(frozen=True)
class ReadLaw:
    """A family fitted to samples.

    Attributes:
        family: which.
        numbers: name -> value [SI].
        left: what it leaves, as a share of the rms of friction [1].
    """

    family: Family
    numbers: Mapping[str, float]
    left: float

    @property
    def is_foreign(self) -> bool:
        """Whether no family is the law that was calculated with."""
        return self.left > _FOREIGN


def _with_speed(load: Array, speed: Array, numbers: Sequence[float]) -> Array:
    fast, added, rate = numbers
    return load * (fast + added - added * np.exp(-rate * speed))


_SPEED = {"slow": ("1", 0.05), "added": ("1", 0.05), "rate": ("s/m", 30.0)}
#: From plain to rich.
FAMILIES: tuple[Family, ...] = (
    Family(
        "coulomb", "one coefficient of friction times the load of the moment", False, True, False,
        {"coefficient": ("1", 0.1)}, lambda s, p: p[0] * s.load,
    ),
    Family(
        "coulomb at constant load", "one friction force: the coefficient times a constant load", False, False, False,
        {"coefficient": ("1", 0.1)}, lambda s, p: p[0] * s.rest,
    ),
    Family(
        "speed", "a coefficient that grows with speed, times the load of the moment", True, True, False,
        _SPEED, lambda s, p: _with_speed(s.load, s.speed, p),
    ),
    Family(
        "speed at constant load", "a coefficient that grows with speed, times a constant load", True, False, False,
        _SPEED, lambda s, p: _with_speed(s.rest, s.speed, p),
    ),
    Family(
        "speed and pressure", "a coefficient that grows with speed and falls with pressure", True, True, True,
        {"strength": ("Pa", 1.4e6), "rate": ("s/m", 20.0), "saturation": ("1/Pa", 1e-7), "slow": ("1", 0.05)},
        lambda s, p: s.area * p[0] * -np.expm1(-p[1] * s.speed) * -np.expm1(-p[2] * s.load / s.area) + p[3] * s.load,
    ),
)  # fmt: skip


def collect_sliding(runs: Sequence[Run], areas: Mapping[str, float]) -> Sliding:
    """Collect the samples of sliding pads of runs.

    Args:
        runs: with slip_x, and force and load of at least one pad.
        areas: of every pad [m^2].

    Raises:
        InputError: no run has what a law can be read from.
    """
    parts: list[list[Array]] = []
    for run in runs:
        record = run.record
        pads = [pad for pad in areas if record.has_all("slip_x", f"pad_{pad}_N", f"pad_{pad}_Fx")]
        if not pads:
            continue
        velocity = np.gradient(record["slip_x"], record.time)
        # a reversal lies between samples, where neither speed nor force is that of sliding
        steady = (np.sign(np.roll(velocity, 1)) == np.sign(velocity)) & (
            np.sign(np.roll(velocity, -1)) == np.sign(velocity)
        )
        fast = steady & (np.abs(velocity) > _SLIDING * np.abs(velocity).max())
        for pad in pads:
            load, force = record[f"pad_{pad}_N"], record[f"pad_{pad}_Fx"] * np.sign(velocity)
            rest = float(np.median(load[: max(len(load) // 50, 1)]))
            kept = fast & (load > _PRESSED * rest)
            sizes = np.full(int(kept.sum()), rest), np.full(int(kept.sum()), areas[pad])
            parts.append([np.abs(velocity[kept]), load[kept], *sizes, force[kept]])
    if not parts or not sum(len(part[0]) for part in parts):
        raise InputError(
            "no law of friction can be read: no run has slip_x with the load and the friction of a pad that slides"
        )
    joined = [np.concatenate(column) for column in zip(*parts, strict=True)]
    thin = max(1, len(joined[0]) // _SAMPLES)
    return Sliding(*(column[::thin] for column in joined))


def fit_family(family: Family, samples: Sliding) -> ReadLaw:
    """Fit a family's numbers to samples by least squares."""
    size = float(np.sqrt(np.mean(samples.force**2)))
    start = np.array([value for _, value in family.numbers.values()])

    def left(logs: Array) -> Array:
        return (family.law(samples, list(np.exp(logs))) - samples.force) / size

    found = least_squares(left, np.log(start), bounds=(np.log(start) - 12.0, np.log(start) + 12.0))
    values = dict(zip(family.numbers, map(float, np.exp(found.x)), strict=True))
    return ReadLaw(family, values, float(np.sqrt(np.mean(found.fun**2))))


def fit_families(samples: Sliding) -> dict[str, ReadLaw]:
    """Fit every family, name -> fitted."""
    return {family.name: fit_family(family, samples) for family in FAMILIES}


def plainest_law(fitted: Mapping[str, ReadLaw]) -> ReadLaw:
    """Return the plainest law that explains the samples as well as the richest one; the best where none explains."""
    least = min(law.left for law in fitted.values())
    return next(law for law in fitted.values() if law.left <= max(_EXACT, _AS_GOOD * least))
