"""Laws of another form than those of the clean bench, of families that the catalogue has.

Keys are "family:form". Each function takes a generator, a scale (1: medium) and the base settings, and gives the
changed settings and the form in words.
"""

import numpy as np

from slipwise_benchmarks.hidden_pad import Change
from slipwise_benchmarks.settings import Settings


def lugre(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """A bristle that is damped, with 0.5 to 4 ms: friction overshoots its bound after a reversal."""
    lag = float(np.exp(rng.uniform(np.log(5.0e-4), np.log(4.0e-3))))
    change = {"presliding_form": 4, "presliding_length": 1.5e-4 * scale, "presliding_lag": lag}
    return change, "LuGre with damping"


def power_wear(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """A film that goes on wearing as a small power of the slid distance."""
    rise = float(rng.choice([-1.0, 1.0])) * min(0.14 * scale, 0.5)
    return {"wear_form": 3, "wear": rise, "wear_length": rng.uniform(0.02, 0.2)}, "power 0.3 of distance"


def three_bodies(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Face, sheet and plate warm one after the other: three time constants, each five times the one before."""
    change = {"heat_form": 3, "heat": 0.25 * scale, "heat_time": rng.uniform(3.0, 15.0)}
    return change, "three time constants"


def zener(rng: np.random.Generator, scale: float, base: Settings) -> Change:
    """Rubber of Zener: a dashpot behind a spring, whose damping falls off above some hertz."""
    damping = 2.0 * 0.03 * scale * np.sqrt(base.buffer_stiffness * base.mass)
    relaxation = float(np.exp(rng.uniform(np.log(5.0e-3), np.log(6.0e-2))))
    change = {"buffer_damping_form": 3, "buffer_damping": damping, "buffer_relaxation": relaxation}
    return change, "Zener"


OTHER_FORMS = {
    "presliding:lugre": lugre,
    "run_in:power": power_wear,
    "heating:bodies": three_bodies,
    "buffer_damping:zener": zener,
}
