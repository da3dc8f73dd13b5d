"""Frictional heating: the sliding face gets hot and slippery.

    q = F V / A, less c of it while |x| > sqrt(A)/2
    T = 20 C + g int q(t - u) K(u) du / (e sqrt(pi)),    K(u) = exp(-u/t_c) / sqrt(u)
    mu *= [0.7^(T/50) + b] / [0.7^(20/50) + b],    b = 0.4                                          (T in degC)

All friction work becomes heat. Most of it enters the steel, a half-space whose surface warms as sqrt(t) under a
constant flux and forgets a burst as 1/sqrt(t): fast at first, then for very long. The middle of the plate is heated
only while the pad covers it (c = 1), the pad's own face always (c = 0). e = k_s / sqrt(D) is the effusivity of
stainless steel, g the share of heat that matters.

1/sqrt(u) = (1/sqrt(pi)) int e^(y/2) exp(-u e^y) dy is summed by the trapezoidal rule over eight relaxation times from
20 ms to 4.6 h, which is within 1 % for 10 ms to 50 min; what is faster acts at once, what is slower joins the last. No
plate is endless: `cooling` is the time in which it loses its heat to what holds it.

`lump` blends in a body of one temperature, K = 3.16 exp(-u/t_c) / sqrt(t_c): the pad itself, which is always covered.
A half-space without losses would give the same rise after t_c of constant flux.

Valid: up to about 250 degC (PTFE melts at 327 degC).
Source: Kumar, Whittaker, Constantinou (2015) and OpenSees FPBearingPTV for the law of T, the gate and D = 4.44e-6 m2/s,
k_s = 18 W/(m K); Carslaw & Jaeger for the kernel: constant q gives 2 q sqrt(D t/pi)/k_s; `lump` and `cooling` assumed.
"""

from math import exp, expm1, log, pi, sqrt

import numpy as np

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis
from slipwise.params import Parameter

RATIO, FIRST, TERMS = 7.0, 0.02, 8
DENSITY = log(RATIO) / sqrt(pi)
TAIL = 1.0 / (1.0 - RATIO**-0.5)
PER_FLUX = sqrt(4.44e-6 / pi) / 18.0
LUMP = 2.0 / (1.0 - exp(-1.0))
PER_DEGREE, COLD = log(0.7) / 50.0, 0.7 ** (20.0 / 50.0)
SHARES = tuple(DENSITY / sqrt(FIRST * RATIO**i) * (TAIL if i == TERMS - 1 else 1.0) for i in range(TERMS))
#: Places in memory of what a step keeps and takes in, and of the step and the time of cooling for which that holds.
KEPT, TAKEN, STEP = 10, 11 + TERMS, 12 + 2 * TERMS


def shear(shear: float, memory: np.ndarray, remains: float) -> float:
    """Lower the shear strength [Pa] by what the temperature does."""
    return shear * ((COLD * exp(PER_DEGREE * memory[9]) + remains) / (COLD + remains))


def advance(
    friction: float, speed: float, apparent_area: float, slip_x: float, slip_y: float, dt: float,
    memory: np.ndarray, share: float, lump: float, cooling: float, cover: float, remains: float,
) -> None:  # fmt: skip
    """Let heat flow in and away; exact while the flux is constant."""
    if abs(dt - memory[STEP]) > 1e-9 * dt or cooling != memory[STEP + 1]:  # instants differ in their last digits
        time = FIRST
        for i in range(TERMS + 1):
            lasting = 1.0 / (1.0 / time + 1.0 / cooling) if i < TERMS else cooling
            memory[KEPT + i] = exp(-dt / lasting)
            memory[TAKEN + i] = -lasting * expm1(-dt / lasting)
            time *= RATIO
        memory[STEP], memory[STEP + 1] = dt, cooling
    work = friction * speed / apparent_area
    flux = work if slip_x * slip_x + slip_y * slip_y < 0.25 * apparent_area else work * (1.0 - cover)
    rise = DENSITY * sqrt(FIRST / RATIO) * TAIL * flux
    for i in range(TERMS):
        memory[i] = memory[i] * memory[KEPT + i] + flux * memory[TAKEN + i]
        rise += SHARES[i] * memory[i]
    memory[8] = memory[8] * memory[KEPT + TERMS] + work * memory[TAKEN + TERMS]
    memory[9] = share * PER_FLUX * ((1.0 - lump) * rise + lump * LUMP / sqrt(cooling) * memory[8])


def rest(
    memory: np.ndarray, seconds: float, share: float, lump: float, cooling: float, cover: float, remains: float
) -> None:
    """Cool down through a pause."""
    advance(0.0, 0.0, 1.0, 0.0, 0.0, seconds, memory, share, lump, cooling, cover, remains)


EFFECT = Effect(
    contract=1,
    port="shear",
    parameters=(
        Parameter("share", "1", 1.0, 0.0, 4.0, 0.0, "OpenSees FPBearingPTV: all heat into the steel", "g: of the heat"),
        Parameter("lump", "1", 0.0, 0.0, 1.0, None, "Kumar et al. (2015): half-space", "0 half-space, 1 one body"),
        Parameter("cooling", "s", 600.0, 1.0, 3600.0, None, "assumed", "t_c: time in which heat is lost"),
        Parameter("cover", "1", 1.0, 0.0, 1.0, None, "OpenSees FPBearingPTV: 1", "c: flux lacking where uncovered"),
        Parameter("remains", "1", 0.4, 0.0, 2.0, None, "Kumar et al. (2015)", "b: what stays however hot it gets"),
    ),
    memory=(*(f"heat_{i}" for i in range(TERMS)), "body", "temperature_rise",
        *(f"{what}_{i}" for what in ("kept", "taken") for i in range(TERMS + 1)), "step", "cooling"),
    diagnosis=ForDiagnosis(
        component="pad friction",
        equation="mu *= k(T), T from the flux F V/A through 1/sqrt(t)",
        moves=RESPONSE,
        signature="odd; grows with dissipated energy, fades in a pause as 1/sqrt(t); the most loaded pad is hottest",
        confused_with={
            "run_in": "repeat at once and after a long rest: heat is gone by then, run-in is not undone",
            "channel_drift": "a drift of a cell is even in velocity",
        },
    ),
)  # fmt: skip
