"""Breakaway: friction is higher while the slip has hardly begun.

    mu += dmu (1 + b z) exp[-(V / v_s)^q],        dz/dt = (1 - z) / t_r - V z / L

At rest the two faces creep into each other: more real area, stronger bonds. The first slip breaks the bonds, and above
a few times v_s nothing is left of the rise. It comes back at every reversal, for there the slip is slow again.

z is the age of the contact, 0 fresh and 1 rested: it comes back with rest in t_r and is used up by slip over L, so that
the first slip after a rest is harder than a reversal. For sheet PTFE the growth ends soon: 20 months of rest did as
half an hour.

Valid: dmu 0.01 to 0.08, v_s 1 to 20 mm/s. Friction falls with speed here, so stick-slip becomes possible.
Source: Bondonet & Filiatrault (1997), a high first value above 1 Hz; Mokha et al. (1991) for the rest; the form is
Stribeck's as in LuGre models, its age that of Dieterich's ageing law with an end; t_r and L assumed.
"""

from math import exp

import numpy as np

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.params import Parameter


def shear(
    shear: float, true_pressure: float, speed: float, memory: np.ndarray,
    rise: float, decay: float, shape: float, ageing: float,
) -> float:  # fmt: skip
    """Raise the shear strength [Pa] by the breakaway's share of the real pressure."""
    return shear + rise * (1.0 + ageing * memory[0]) * exp(-((speed / decay) ** shape)) * true_pressure


def advance(speed: float, dt: float, memory: np.ndarray, time: float, length: float) -> None:
    """Let the contact grow older; exact while the speed is constant."""
    rate = 1.0 / time + speed / length
    end = 1.0 / (time * rate)
    memory[0] = end + (memory[0] - end) * exp(-rate * dt)


def rest(memory: np.ndarray, seconds: float, time: float) -> None:
    """Let the contact grow older through a pause."""
    memory[0] = 1.0 - (1.0 - memory[0]) * exp(-seconds / time)


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter("rise", "1", 0.05, 0.0, 0.2, 0.0, "0.01 to 0.08 for PTFE on steel, assumed", "dmu: extra at rest"),
        Parameter("decay", "m/s", 0.02, 0.5e-3, 0.1, None, "1 to 20 mm/s, assumed", "v_s: speed of its end", "mm/s"),
        Parameter("shape", "1", 2.0, 0.5, 4.0, None, "assumed: 2 is Gaussian, 1 exponential", "q: shape over speed"),
        Parameter("ageing", "1", 0.0, 0.0, 10.0, None, "assumed: 0 to 3", "b: growth by rest"),
        Parameter("time", "s", 0.5, 5e-3, 50.0, None, "assumed", "t_r: of rest in which it grows"),
        Parameter("length", "m", 1e-3, 1e-5, 0.1, None, "assumed", "L: of slip that uses it up", "mm"),
    ),
    memory=("age",),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu += dmu (1 + b z) exp[-(V/v_s)^q],  dz/dt = (1 - z)/t_r - V z/L",
        moves=RESPONSE,
        signature="odd in velocity, only below about 3 v_s: force spikes at first slip and after each reversal",
        confused_with={
            "rate_and_state": "constant slow speeds: a straight line over log V is rate_and_state",
            "run_in": "repeat at once: run-in stays gone, breakaway is back at every reversal",
            "key_clearance": "spikes of the key sit at a place, those of breakaway at zero speed",
        },
    ),
    rare=Rare(adds=True),
)  # fmt: skip
