"""Friction of one pad: the bound of eq. (7) with true pressure, and a stick that is stiff but not rigid."""

import math

from numba import njit


@njit(cache=True)
def base_bound(p, apparent, load, speed):
    """Give the bound of a pad by the base law [N], from its area [m^2], load [N] and speed of slip [m/s]."""
    pressure = load / apparent
    area = apparent * (1.0 - math.exp(-p.k * pressure))
    return p.s1 * (1.0 - math.exp(-p.n * speed)) * area + p.alpha * load


@njit(cache=True)
def stick_stiffness(p, apparent, mass, length):
    """Tangential stiffness [N/m] of a pad that reaches the fast friction of its share of `mass` after `length`."""
    return base_bound(p, apparent, mass * 9.80665, 10.0) / length


@njit(cache=True)
def slide(zx, zy, vx, vy, bound, asymmetry, stiffness, damping, step):
    """Stiff elastic-plastic stick with a dashpot, brought back to the friction circle.

    Trial force K (z + v dt) + c v; beyond the bound it is shortened to it, so that sliding friction lies along v
    and has no viscous part. A memory of constant stiffness does not creep when the load swings in stick.

    Returns:
        fx, fy [N] and the new elastic displacement zx, zy [m].
    """
    zx += vx * step
    zy += vy * step
    fx = stiffness * zx + damping * vx
    fy = stiffness * zy + damping * vy
    force = math.sqrt(fx * fx + fy * fy)
    if force > 0.0:
        bound *= 1.0 + asymmetry * fx / force
    if force > bound:
        fx *= bound / force
        fy *= bound / force
    elastic = stiffness * math.sqrt(zx * zx + zy * zy)
    if elastic > bound:
        zx *= bound / elastic
        zy *= bound / elastic
    return fx, fy, zx, zy


@njit(cache=True)
def preslide(form, zx, zy, vx, vy, bound, asymmetry, length, damping, step):
    """Hidden pre-sliding: friction = bound times the filled share of a length u_y.

    Forms: 1 Dahl, dz/dt = v - |v| z/u_y, taken implicitly so that no step overshoots; 2 elastic-plastic, z cut at
    u_y; both with a little viscous damping below it. (Form 3 is `slide` with a soft stick, 4 is `bristle`.)
    """
    speed = math.sqrt(vx * vx + vy * vy)
    zx += vx * step
    zy += vy * step
    if form == 1:
        shrink = 1.0 / (1.0 + speed * step / length)
    else:
        filled = math.sqrt(zx * zx + zy * zy) / length
        shrink = 1.0 / filled if filled > 1.0 else 1.0
    zx *= shrink
    zy *= shrink
    filled = math.sqrt(zx * zx + zy * zy) / length
    direction = zx / (length * filled) if filled > 0.0 else 0.0
    force = bound * (1.0 + asymmetry * direction) / length
    open_share = 1.0 - filled if filled < 1.0 else 0.0
    return force * zx + damping * vx * open_share, force * zy + damping * vy * open_share, zx, zy


@njit(cache=True)
def bristle(zx, zy, vx, vy, bound, asymmetry, length, lag, step):
    """LuGre: F = bound (z + t_d dz/dt)/u, dz/dt = v - |v| z/u, z taken implicitly; F may overshoot the bound.

    Source: Canudas de Wit et al. (1995), without the viscous term.
    """
    shrink = 1.0 / (1.0 + math.sqrt(vx * vx + vy * vy) * step / length)
    new_x, new_y = (zx + vx * step) * shrink, (zy + vy * step) * shrink
    bent_x = new_x + lag * (new_x - zx) / step
    bent_y = new_y + lag * (new_y - zy) / step
    force = bound * (1.0 + asymmetry * new_x / length) / length
    return force * bent_x, force * bent_y, new_x, new_y
