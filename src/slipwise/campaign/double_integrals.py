"""Which acceleration, or difference of two, a displacement is the double integral of; and whether it was computed so.

    d = s * double integral of (a_i - a_j)      or of a_i alone, which is a motion in space

compared as accelerations, in the frequencies in which the displacement stands above the noise of all gauges. One that
was measured has a noise of its own: where the motion is a few millionths of a metre it no longer follows the
accelerations. One that does follow them there was computed from them, and says nothing that they do not.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.campaign.level_spectra import FEWEST, averaged_power, noise_power, spectrum

#: A displacement belongs to an acceleration where they agree so well [1].
AGREE = 0.95
#: Motion that is this part of the displacement's own size is below what a displacement gauge resolves [1]: from, to.
_FINE = (1e-3, 2e-4)
#: A displacement that still agrees so well with its accelerations there was computed from them [1], on so many lines.
_COMPUTED, _FEWEST_LINES = 0.97, 8
#: Power of a displacement above its noise, and that of the accelerations, from which a frequency counts [1].
_ABOVE = 10.0
#: What of a motion's rate lies below the frequencies that count, and what of the accelerations up to their end [1].
_SLOWEST, _FASTEST = 0.02, 0.98


@dataclass(frozen=True)
class Source:
    """What a displacement is the double integral of.

    Attributes:
        plus: number of the acceleration.
        minus: number of the one that is taken away; None where the displacement is one in space.
        scale: displacement over double integral [1]; below zero where it stands turned round.
        agreement: correlation with it, its sign left out [1].
    """

    plus: int
    minus: int | None
    scale: float
    agreement: float

    def seen_from(self, reference: int) -> "Source":
        """Return the same with `reference` as the acceleration that is taken away, where it is one of the two."""
        return (
            Source(self.minus, self.plus, -self.scale, self.agreement)
            if self.plus == reference and self.minus is not None
            else self
        )


@dataclass(frozen=True)
class Fineness:
    """How far down a displacement follows its accelerations.

    Attributes:
        computed: whether it does so below what a gauge resolves.
        size: of the motion at which that was asked, rms [m].
        above: frequency from which on the motion is as small [Hz].
        agreement: correlation there [1].
    """

    computed: bool
    size: float
    above: float
    agreement: float


def find_sources(displacement: Array, accelerations: Array, dt: float) -> list[Source]:
    """Return how well a displacement is the double integral of each acceleration and of each difference of two.

    Args:
        displacement: (samples,), in any unit.
        accelerations: (n, samples) [m/s^2].
        dt: step [s].

    Returns:
        The best first, however well it agrees (see `AGREE`); none where the displacement shows no motion.
    """
    if len(displacement) < FEWEST or np.ptp(displacement) == 0.0:
        return []
    bend, turning = _bent(displacement, dt)
    power = averaged_power(bend)
    counts = turning > 0.0
    counts[1:] &= power[1:] / turning[1:] ** 4 > _ABOVE * noise_power(power[1:] / turning[1:] ** 4)
    every = spectrum(accelerations)
    moved = np.stack([averaged_power(one) for one in every])
    counts &= power > _ABOVE * float(np.median([noise_power(one) for one in moved]))
    counts &= _carries(power, np.asarray(moved.mean(axis=0), dtype=np.float64))
    if np.count_nonzero(counts) < _FEWEST_LINES:
        return []
    weight = 1.0 / np.sqrt(power[counts])
    own, others = bend[counts] * weight, every[:, counts] * weight
    whole = np.real(others.conj() @ others.T)
    along = np.real(others.conj() @ own)
    size = float(np.sqrt(np.real(np.vdot(own, own))))
    found = [Source(i, None, *_agreement(float(along[i]), float(whole[i, i]), size)) for i in range(len(others))]
    for i, j in combinations(range(len(others)), 2):
        drift = float(whole[i, i] + whole[j, j] - 2.0 * whole[i, j])
        found.append(Source(i, j, *_agreement(float(along[i] - along[j]), drift, size)))
    return sorted(found, key=lambda one: -one.agreement)


def judge_fineness(displacement: Array, acceleration: Array, dt: float) -> Fineness | None:
    """Tell whether a displacement was computed from an acceleration or was measured by a gauge of its own.

    Args:
        displacement: (samples,) [m].
        acceleration: (samples,) whose double integral it is [m/s^2].
        dt: step [s].

    Returns:
        None where the record shows no motion as small as that.
    """
    bend, turning = _bent(displacement, dt)
    moved = spectrum(acceleration)[1:] / turning[1:] ** 2
    beyond = np.sqrt(2.0 * np.cumsum(np.abs(moved[::-1]) ** 2)[::-1]) / len(displacement)
    size = float(np.std(displacement))
    fine = (beyond < _FINE[0] * size) & (beyond > _FINE[1] * size)
    if np.count_nonzero(fine) < _FEWEST_LINES:
        return None
    one, other = bend[1:][fine], spectrum(acceleration)[1:][fine]
    products = [float(np.real(np.vdot(a, b))) for a, b in ((one, other), (one, one), (other, other))]
    agreement = products[0] / max(float(np.sqrt(products[1] * products[2])), 1e-300)
    first = int(np.flatnonzero(fine)[0])
    return Fineness(
        abs(agreement) > _COMPUTED, float(beyond[first]), float(turning[1:][first]) / (2.0 * np.pi), agreement
    )


def _bent(displacement: Array, dt: float) -> tuple[NDArray[np.complex128], Array]:
    """Return the spectrum (m,) of a displacement's second derivative, and its circular frequencies [rad/s].

    Differences are taken before the ends are faded: what fading spills of slow motion would hide what is fast.
    """
    turning = np.asarray(2.0 * np.pi * np.fft.rfftfreq(len(displacement), dt), dtype=np.float64)
    inner = np.diff(displacement, 2)
    second = np.concatenate([inner[:1], inner, inner[-1:]]) / dt**2
    return spectrum(second) / np.sinc(0.5 * turning * dt / np.pi) ** 2, turning


def _carries(bent: Array, moved: Array) -> NDArray[np.bool_]:
    """Tell the frequencies that hold nearly all of a motion's rate from below, and of its accelerations from above.

    Below them accelerations drift, above them rounding and noise are what is compared.
    """
    line = np.arange(1, len(bent))
    below, above = np.cumsum(bent[1:] / line**2), np.cumsum(moved[1:])
    return np.concatenate([[False], (below > _SLOWEST * below[-1]) & (above < _FASTEST * above[-1])])


def _agreement(along: float, own: float, size: float) -> tuple[float, float]:
    """Return scale and correlation [1] of a signal with another, by their inner products."""
    own = max(own, 1e-300)
    return along / own, abs(along) / max(float(np.sqrt(own)) * size, 1e-300)
