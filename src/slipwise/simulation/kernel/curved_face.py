"""A pad whose sliding face is a bowl (R > 0) or a crown: a pendulum.

    rise = R - sqrt(R^2 - r^2),  g = (x, y) / sqrt(R^2 - r^2),  r^2 = x^2 + y^2,  1/R = 1/R_rated + effects
    (F_x, F_y) = N g + T + g (g . T),      P cos = N + T . g,      |T| sqrt(1 + (e . g)^2) <= mu P

N is what the load cell carries, upright; P acts normal to the face, friction along it: T is its horizontal part, e its
direction, g the slope of the face, cos = 1/sqrt(1 + g^2). Along one line this is F = N (g + mu) / (1 - mu g).

The pad's spring stands upright under the face, so the girder rises by what the face does. Beyond 0.9 R the face goes on
as a cone. The law's speed is the one along the table.

Source: equilibrium of a slider on a sphere; Zayas, Low, Mahin (1990), A simple pendulum technique for achieving seismic
isolation, Earthquake Spectra 6(2), which has it for small slopes: F = N x/R + mu N.
"""

from math import sqrt

from slipwise.arrays import Array
from slipwise.simulation.kernel.compilable import compilable
from slipwise.simulation.kernel.dispatch import Dispatch
from slipwise.simulation.kernel.pads import pad_bound
from slipwise.simulation.kernel.places import (
    ALONG,
    CURVATURE,
    N_PADS,
    NORMAL,
    PAD_TENDON,
    RISE,
    RISE_RATE,
    SLOPE,
)

#: Share of the radius up to which a face is a sphere [1].
_SPHERE = 0.9
#: Rounds in which normal force and friction are made to agree; each leaves at most mu g of the error before.
_ROUNDS = 2
#: Least share of the normal force that friction may leave to the cell [1]: a slope on which it does not wedge.
_LEAST = 0.1


@compilable
def set_faces(effects: Dispatch, u: Array, ten_length: Array, ten_velocity: Array) -> None:
    """Find rise, its rate and the slope of every pad's face at its slip.

    Args:
        effects: the chosen effects.
        u: the law's numbers; set in them.
        ten_length: of MuJoCo's tendons: slip [m].
        ten_velocity: their rates [m/s].
    """
    for pad in range(int(u[N_PADS])):
        z = effects.first_pad + pad * effects.pad_block
        tendon_x, tendon_y = int(u[z + PAD_TENDON]), int(u[z + PAD_TENDON + 1])
        set_face(effects, u, z, ten_length[tendon_x], ten_length[tendon_y])
        u[z + RISE_RATE] = u[z + SLOPE] * ten_velocity[tendon_x] + u[z + SLOPE + 1] * ten_velocity[tendon_y]


@compilable
def set_face(effects: Dispatch, u: Array, z: int, slip_x: float, slip_y: float) -> None:
    """Find rise [m] and slope [1] of the face of the pad at `z` at a slip [m]; set in `u`."""
    curvature = effects.face(u, z, u[z + CURVATURE])
    away = sqrt(slip_x * slip_x + slip_y * slip_y)
    sine = min(abs(curvature) * away, _SPHERE)
    cosine = sqrt(1.0 - sine * sine)
    rise = 0.0
    if curvature != 0.0:  # (1 - cos) / k without the difference of two numbers that are nearly one
        rise = sine * sine / (1.0 + cosine) / curvature
        rise += (away - sine / abs(curvature)) * sine / cosine * (1.0 if curvature > 0.0 else -1.0)
    steep = curvature / cosine
    if abs(curvature) * away > _SPHERE:
        steep = (sine if curvature > 0.0 else -sine) / cosine / away
    u[z + RISE] = rise
    u[z + SLOPE] = steep * slip_x
    u[z + SLOPE + 1] = steep * slip_y


@compilable
def normal_force(u: Array, z: int, load: float, along_x: float, along_y: float) -> float:
    """Return P [N] from the cell's load and the horizontal part T of friction [N]; never below zero."""
    if load <= 0.0:
        return 0.0
    slope_x, slope_y = u[z + SLOPE], u[z + SLOPE + 1]
    upright = load + along_x * slope_x + along_y * slope_y
    return max(upright, 0.0) * sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)


@compilable
def sliding_bound(
    effects: Dispatch, u: Array, z: int, load: float, toward_x: float, toward_y: float, velocity_x: float,
    velocity_y: float, slip_x: float, slip_y: float, side_x: float, side_y: float, time: float, dt: float,
) -> tuple[float, float]:  # fmt: skip
    """Return friction along the face, mu P, and its horizontal part |T| [N] if it acts along the unit vector `toward`.

    The normal force P, which friction itself raises or lowers, is set in `u`. Other arguments as `pad_bound`.
    """
    climb = toward_x * u[z + SLOPE] + toward_y * u[z + SLOPE + 1]
    longer = sqrt(1.0 + climb * climb)
    leaning = sqrt(1.0 + u[z + SLOPE] * u[z + SLOPE] + u[z + SLOPE + 1] * u[z + SLOPE + 1])
    normal = load * leaning
    for _ in range(_ROUNDS):
        bound = pad_bound(
            effects, u, z, normal, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time, dt
        )  # fmt: skip
        lifted = bound / normal * leaning / longer * climb if normal > 0.0 else 0.0
        normal = load * leaning / max(1.0 - lifted, _LEAST)
    bound = pad_bound(effects, u, z, normal, velocity_x, velocity_y, slip_x, slip_y, side_x, side_y, time, dt)
    u[z + NORMAL] = normal
    return bound, bound / longer


@compilable
def onto_table(u: Array, z: int, along_x: float, along_y: float) -> tuple[float, float]:
    """Return what friction on the face pushes along the table, T + g (g . T) [N]."""
    slope_x, slope_y = u[z + SLOPE], u[z + SLOPE + 1]
    climb = slope_x * along_x + slope_y * along_y
    return along_x + slope_x * climb, along_y + slope_y * climb


@compilable
def along_face(u: Array, z: int, force_x: float, force_y: float) -> float:
    """Return the size of the friction along the face [N] that pushes so along the table [N]: `onto_table` undone."""
    force = sqrt(force_x * force_x + force_y * force_y)
    if force == 0.0:
        return 0.0
    climb = (force_x * u[z + SLOPE] + force_y * u[z + SLOPE + 1]) / force
    return force / sqrt(1.0 + climb * climb)


@compilable
def keep_along(u: Array, z: int, along_x: float, along_y: float) -> None:
    """Remember the horizontal part of an explicit friction [N] for the normal force of the instant that follows."""
    u[z + ALONG] = along_x
    u[z + ALONG + 1] = along_y
