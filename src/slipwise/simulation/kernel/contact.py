"""The normal load of a pad: a spring and a damper that cannot pull.

    N = max(k d + c d', 0) while the compression d is above zero, else 0

Positions stand at the step's instant, velocities half a step before it: the load that acts during a step is that of the
instant at its middle. Where the pad touches or leaves within the step, its mean over the step is taken, so that an
impact gives the impulse that it should whatever the step.
"""

from math import sqrt

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.places import (
    COMPRESSION,
    COMPRESSION_RATE,
    DT,
    LOAD,
    N_DOFS,
    N_PADS,
    PAD_DAMPING,
    PAD_STIFFNESS,
    RATE_AGE,
    RISE,
    RISE_RATE,
)  # fmt: skip

#: Reference acceleration [m/s^2] that keeps a contact of MuJoCo's from acting: the law's load takes its place.
INACTIVE = -1e9


@compilable
def begin_step(u: Array, pads: int, size: int, applied: Array) -> None:
    """Start a step without loads and without generalised forces.

    Args:
        u: the law's numbers.
        pads: place in it of the first pad's block.
        size: of a pad's block.
        applied: generalised forces [N, N m].
    """
    for pad in range(int(u[N_PADS])):
        u[pads + pad * size + LOAD] = 0.0
    for dof in range(int(u[N_DOFS])):
        applied[dof] = 0.0


@compilable
def apply_pad_load(u: Array, z: int, compression: float, rate: float, push: Array, applied: Array) -> None:
    """Find the load of a pad in this step and let it press on the girder.

    Args:
        u: the law's numbers; load, compression and its rate in them are set.
        z: place in it of the pad's block.
        compression: of the pad's spring under a flat face, negative where it does not touch [m]; what the face rises
            at the slip comes to it.
        rate: of it, half a step ago [m/s].
        push: (n_dofs,) rate of the gap over the rate of each degree of freedom.
        applied: generalised forces [N, N m]; added to.
    """
    dt = u[DT]
    compression += u[z + RISE]
    rate += u[z + RISE_RATE]
    acceleration = (rate - u[z + COMPRESSION_RATE]) / u[RATE_AGE]
    u[z + COMPRESSION] = compression
    u[z + COMPRESSION_RATE] = rate
    load = mean_load(
        u[z + PAD_STIFFNESS], u[z + PAD_DAMPING], compression, rate + 0.5 * dt * acceleration, acceleration, dt
    )
    u[z + LOAD] = load
    if load > 0.0:
        for dof in range(int(u[N_DOFS])):
            applied[dof] += push[dof] * load


@compilable
def mean_load(
    stiffness: float, damping: float, compression: float, rate: float, acceleration: float, dt: float
) -> float:
    """Return the mean load [N] over the dt about an instant at which compression, rate and acceleration are known.

    Compression and load are parabolas in time; the load counts where both are above zero.
    """
    half = 0.5 * dt
    reach = half * abs(rate) + 0.5 * half * half * abs(acceleration)
    if compression < -reach:
        return 0.0
    load = stiffness * compression + damping * rate
    slope = stiffness * rate + damping * acceleration
    curvature = 0.5 * stiffness * acceleration
    if compression > reach and load > stiffness * reach + half * damping * abs(acceleration):
        return load
    touching = roots(compression, rate, 0.5 * acceleration, half)
    bearing = roots(load, slope, curvature, half)
    impulse = 0.0
    start = -half
    while start < half:
        end = half
        for root in (touching[0], touching[1], bearing[0], bearing[1]):
            if start < root < end:
                end = root
        middle = 0.5 * (start + end)
        at_middle = load + middle * (slope + curvature * middle)
        if at_middle > 0.0 and compression + middle * (rate + 0.5 * acceleration * middle) > 0.0:
            at_ends = 2.0 * load + slope * (start + end) + curvature * (start * start + end * end)
            impulse += (end - start) / 6.0 * (at_ends + 4.0 * at_middle)
        start = end
    return impulse / dt


@compilable
def roots(constant: float, slope: float, curvature: float, none: float) -> tuple[float, float]:
    """Return where constant + slope s + curvature s^2 is zero; `none` for a root that there is not."""
    under = slope * slope - 4.0 * curvature * constant
    if under < 0.0:
        return none, none
    q = -0.5 * (slope + (sqrt(under) if slope >= 0.0 else -sqrt(under)))
    return (q / curvature if curvature != 0.0 else none), (constant / q if q != 0.0 else none)
