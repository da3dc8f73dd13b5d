"""Rate and state: friction follows the logarithm of speed, and of the contact's age.

    mu += a ln[(V + V_c) / V_0] + b phi,        phi = ln(V_0 theta / D_c),        dtheta/dt = 1 - V theta / D_c

A jump of speed raises friction at once by a ln(V2/V1) (the direct effect); then, while the contacts of the old speed
are replaced over the distance D_c, it falls by b ln(V2/V1). Steady sliding gives a straight line (a - b) ln(V/V_0).
V_0 is where the steady law changes nothing; below V_c the direct effect levels off.

`slip` blends in Ruina's slip law, dphi/dt = -(V/D_c) (phi + ln(V/V_0)): contacts then age only as they slide. Both
laws are one near steady sliding; after a jump of many times the speed the slip law forgets over D_c, whichever way.

Valid: a, b up to 0.02 for polymers; D_c 1 to 100 um. Logarithms hold over decades, not at zero speed.
Source: Dieterich (1979), ageing law; Ruina (1983), slip law; Tapia et al. (2024) fit 11 polymers on steel in log V
from 1 to 300 mm/s; values for PTFE assumed.
"""

from math import exp, log

import numpy as np

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Rare
from slipwise.params import Parameter


def shear(
    shear: float,
    true_pressure: float,
    speed: float,
    memory: np.ndarray,
    direct: float,
    state: float,
    cutoff: float,
    reference: float,
) -> float:
    """Add the two logarithms' share of the real pressure to the shear strength [Pa]."""
    return shear + (direct * log((speed + cutoff) / reference) + state * memory[0]) * true_pressure


def advance(speed: float, dt: float, memory: np.ndarray, length: float, slip: float, reference: float) -> None:
    """Let the contacts age and be replaced; each law is exact while the speed is constant."""
    ratio, used = exp(memory[0]), speed * dt / length
    if used < 1e-9:
        memory[0] = log(ratio + (1.0 - slip) * reference * dt / length)
        return
    steady = reference / speed
    aged, line = log(steady + (ratio - steady) * exp(-(1.0 - slip) * used)), log(steady)
    memory[0] = line + (aged - line) * exp(-slip * used)


def rest(memory: np.ndarray, seconds: float, length: float, slip: float, reference: float) -> None:
    """Let the contacts age through a pause."""
    memory[0] = log(exp(memory[0]) + (1.0 - slip) * reference * seconds / length)


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter("direct", "1", 0.01, -0.03, 0.03, 0.0, "0.005 to 0.02, assumed for PTFE", "a: direct effect"),
        Parameter("state", "1", 0.005, -0.03, 0.03, 0.0, "0.005 to 0.02, assumed for PTFE", "b: of the age"),
        Parameter("length", "m", 20e-6, 1e-6, 1e-3, None, "1 to 100 um, assumed", "D_c: of renewal", "um"),
        Parameter("slip", "1", 0.0, 0.0, 1.0, None, "Dieterich's ageing law", "0 ageing law, 1 slip law"),
        Parameter("cutoff", "m/s", 1e-4, 1e-6, 1e-2, None, "assumed", "V_c: end of the direct effect", "mm/s"),
        Parameter("reference", "m/s", 0.1, 1e-3, 1.0, None, "a choice, assumed: mean speed of the rig", "V_0", "mm/s"),
    ),
    memory=("log_age",),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu += a ln[(V + V_c)/V_0] + b ln(V_0 theta/D_c)",
        moves=RESPONSE,
        signature="odd; F/N is a straight line over log V; an overshoot at each jump of speed",
        confused_with={
            "shear_rate": "constant speeds over three decades: an exponential saturates, a logarithm does not",
            "breakaway": "breakaway is nothing above 3 v_s; rate and state goes on",
        },
    ),
    rare=Rare(adds=True),
)  # fmt: skip
