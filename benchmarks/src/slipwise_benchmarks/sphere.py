"""A pad that slides on a sphere: how it rises, how its normal leans, and what that makes of its forces.

The pad's spring acts along the normal, friction in the tangent plane, where it opposes the velocity there. What a load
cell under the plate reads is upright and along the table.
"""

import math

from numba import njit


@njit(cache=True)
def sphere(curvature, x, y):
    """Rise of the face over its middle [m], its slope along x and y [1], and the cosine of the normal's lean."""
    root = math.sqrt(1.0 - curvature * curvature * (x * x + y * y))
    rise = curvature * (x * x + y * y) / (1.0 + root)
    return rise, curvature * x / root, curvature * y / root, root


@njit(cache=True)
def stretch(slope_x, slope_y, vx, vy):
    """Speed in the tangent plane over its part along the table [1]; 1 at rest."""
    along = vx * vx + vy * vy
    if along == 0.0:
        return 1.0
    up = slope_x * vx + slope_y * vy
    return math.sqrt(1.0 + up * up / along)


@njit(cache=True)
def along_table(press, slope_x, slope_y, cosine, fx, fy):
    """Forces on the plate [N], upright and along x and y: of a normal force, and of friction of parts fx and fy."""
    upright = press * cosine - slope_x * fx - slope_y * fy
    return upright, fx + press * cosine * slope_x, fy + press * cosine * slope_y
