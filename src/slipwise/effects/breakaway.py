"""Breakaway: friction is higher while the slip has hardly begun.

    mu += dmu [1 + b log10(1 + t_rest / t_0)] exp[-(V / v_s)^q],        t_0 = 10 ms

At rest the two faces creep into each other: more real area, stronger bonds. The first slip breaks the bonds, and above
a few times v_s nothing is left of the rise. It comes back at every reversal, for there the slip is slow again.

The age of the contact t_rest follows the ageing law, dt_rest/dt = 1 - V t_rest / L: it grows with time and is used up
by slip over L = 0.1 mm. For sheet PTFE ageing is all but absent (b ~ 0): 20 months of rest did as half an hour.

Valid: dmu 0.01 to 0.08, v_s 1 to 20 mm/s. Friction falls with speed here, so stick-slip becomes possible.
Source: Bondonet & Filiatrault (1997), a high first value above 1 Hz; Mokha et al. (1991) for the rest; the form is
Stribeck's as in LuGre models; L and t_0 assumed.
"""

from math import exp, log10

import numpy as np

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.params import Parameter

CONTACT_LENGTH = 1e-4
YOUNG = 0.01


def shear(
    shear: float, true_pressure: float, speed: float, memory: np.ndarray,
    rise: float, decay: float, shape: float, ageing: float,
) -> float:  # fmt: skip
    """Raise the shear strength [Pa] by the breakaway's share of the real pressure."""
    age = 1.0 + ageing * log10(1.0 + memory[0] / YOUNG)
    return shear + rise * age * exp(-((speed / decay) ** shape)) * true_pressure


def advance(speed: float, dt: float, memory: np.ndarray) -> None:
    """Let the contact grow older; exact while the speed is constant."""
    used = speed * dt / CONTACT_LENGTH
    if used < 1e-9:
        memory[0] += dt
    else:
        memory[0] = CONTACT_LENGTH / speed + (memory[0] - CONTACT_LENGTH / speed) * exp(-used)


def rest(memory: np.ndarray, seconds: float) -> None:
    """Let the contact grow older through a pause."""
    memory[0] += seconds


EFFECT = Effect(
    port="shear",
    component="pad friction",
    equation="mu += dmu [1 + b log10(1 + t/10 ms)] exp[-(V/v_s)^q]",
    parameters=(
        Parameter("rise", "1", 0.05, 0.0, 0.2, 0.0, "0.01 to 0.08 for PTFE on steel, assumed", "dmu: extra at rest"),
        Parameter("decay", "m/s", 0.02, 0.5e-3, 0.1, None, "1 to 20 mm/s, assumed", "v_s: speed of its end", "mm/s"),
        Parameter("shape", "1", 2.0, 0.5, 4.0, None, "assumed: 2 is Gaussian, 1 exponential", "q: shape over speed"),
        Parameter("ageing", "1", 0.0, 0.0, 1.0, None, "Mokha et al. (1991): none for PTFE", "b: growth per decade"),
    ),
    moves=RESPONSE,
    signature="odd in velocity, only below about 3 v_s: force spikes at first slip and after each reversal",
    confused_with={
        "rate_and_state": "constant slow speeds: a straight line over log V is rate_and_state",
        "run_in": "repeat at once: run-in stays gone, breakaway is back at every reversal",
        "key_clearance": "spikes of the key sit at a place, those of breakaway at zero speed",
    },
    memory=("age",),
)  # fmt: skip
