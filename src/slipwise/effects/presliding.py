"""Pre-sliding: before it slips a contact gives way like a spring.

    F = F_b (z + t_d dz/dt) / u,        dz/ds = (1 - z/u)^i along the motion,        |z| <= u = u_0 (F_b / F_0)^q

The asperities of a contact bend, as bristles z, before they let go. After every reversal friction therefore needs a
certain *distance*, a few u, to turn round. A delay of the gauge, which needs a certain *time*, looks alike in one run.

The exponent i is the contact's character: 1 is Dahl's law (approach without end), 0 a bristle that bends elastically
and then slips (elastic-plastic). Motion across relaxes the bristle by exp(-i s/u), and what exceeds u is taken back
towards the middle: the bound is a circle. The update is exact over any step: w = 1 - z/u, w^(1-i) falls by (1-i) s/u.

A length of its own (q = 0) belongs to the surface; a spring of its own, F_0 / u_0 (q = 1), to what is in series with
it, a rubber layer or the cell; a round contact that slips from its rim inwards is between (q = 2/3). F_0 only says
at which force u is u_0.

`spectrum` w makes eight equally stiff bristles of one, of lengths from (1 - w) u to (1 + w) u: they let go one after
another, and a small reversal remembers where it came from. With i = 0 this is Iwan's model, w = 1 his even spectrum.

Valid: u 0.02 to 0.5 mm for bare sheet, 1 to 5 mm with a rubber layer in series.
Source: Dahl (1968), with his exponent; Mindlin (1949) for q = 2/3; Iwan (1966) for the spectrum; Canudas de Wit et al.
(1995), LuGre, for a bristle that is damped, with F = F_b while it slips. Sizes assumed.
"""

from math import exp, sqrt

import numpy as np

from slipwise.effects._effect import RESPONSE, Effect
from slipwise.effects._fields import ForDiagnosis, Limit, Rare
from slipwise.params import Parameter

LEAST, BRISTLES = 1e-3, 8


def stick(
    bound: float, slip_x: float, slip_y: float, time: float, dt: float, memory: np.ndarray,
    length: float, exponent: float, growth: float, damping: float, spectrum: float, rated: float,
) -> tuple[float, float]:  # fmt: skip
    """Bend the bristles by the slip since the instant before; give their force [N]."""
    if growth > 0.0:
        length *= max(bound / rated, LEAST) ** growth
    way_x, way_y = slip_x - memory[0], slip_y - memory[1]
    if abs(time - memory[2] - dt) > 0.5 * dt:  # a new run: its gauge may stand anywhere
        way_x, way_y = 0.0, 0.0
    memory[0], memory[1], memory[2] = slip_x, slip_y, time
    way, power = sqrt(way_x * way_x + way_y * way_y), 1.0 - exponent
    x, y = (way_x / way, way_y / way) if way > 0.0 else (1.0, 0.0)
    bent_x, bent_y, count = 0.0, 0.0, BRISTLES if spectrum > 0.0 else 1
    for k in range(count):
        most, at = length * (1.0 + spectrum * (2 * k + 1 - count) / count), 3 + 2 * k
        before_x, before_y = memory[at], memory[at + 1]
        if way > 0.0:
            along, across = before_x * x + before_y * y, before_y * x - before_x * y
            left, across = max(1.0 - along / most, 0.0), across * exp(-exponent * way / most)
            if power < 0.001:
                along = most * (1.0 - left * exp(-way / most))
            else:  # below zero: what is left of the way, pushed on before the bound takes it back
                ahead = left**power - power * way / most
                along = most * (1.0 - (ahead ** (1.0 / power) if ahead > 0.0 else ahead / power))
            shrink = min(1.0, most / max(sqrt(along * along + across * across), 1e-30))
            memory[at], memory[at + 1] = (along * x - across * y) * shrink, (along * y + across * x) * shrink
            if shrink < 1.0:  # it slips: a bound that falls meanwhile lets the bristle go, and the damper with it
                before_x, before_y = memory[at], memory[at + 1]
        bent_x += (memory[at] + damping * (memory[at] - before_x) / dt) / count
        bent_y += (memory[at + 1] + damping * (memory[at + 1] - before_y) / dt) / count
    stiffness = bound / max(sqrt(bent_x * bent_x + bent_y * bent_y), length)
    return stiffness * bent_x, stiffness * bent_y


def begin(
    memory: np.ndarray, share_x: float, share_y: float, bound: float,
    length: float, growth: float, spectrum: float, rated: float,
) -> None:  # fmt: skip
    """Bend the bristles as far as a force asks for."""
    count = BRISTLES if spectrum > 0.0 else 1
    for k in range(count):
        most = length * max(bound / rated, LEAST) ** growth * (1.0 + spectrum * (2 * k + 1 - count) / count)
        memory[3 + 2 * k], memory[4 + 2 * k] = share_x * most, share_y * most


EFFECT = Effect(
    contract=1, port="stick",
    parameters=(
        Parameter("length", "m", 0.3e-3, 0.0, 5e-3, 0.0, "0.02 to 0.5 mm bare sheet, assumed", "u: bristle", "mm"),
        Parameter("exponent", "1", 1.0, 0.0, 1.0, None, "Dahl (1968): 1", "i: 1 Dahl, 0 elastic-plastic"),
        Parameter("growth", "1", 0.0, 0.0, 1.0, None, "a length of the surface: 0", "q: 1 a spring in series"),
        Parameter("damping", "s", 0.0, 0.0, 0.02, None, "Dahl (1968): none", "t_d: of the bristle", "ms"),
        Parameter("spectrum", "1", 0.0, 0.0, 1.0, None, "one length: 0", "w: spread of the lengths, 1 Iwan's parabola"),
        Parameter("rated", "N", 2770.0, 10.0, 1e5, None, "a choice, assumed: friction of a pad", "F_0", "kN"),
    ),
    memory=("last_x", "last_y", "last_time", *(f"bristle_{k}_{axis}" for k in range(BRISTLES) for axis in "xy")),
    diagnosis=ForDiagnosis(
        component="pad friction", equation="F = F_b z/u,  dz/ds = (1 - z/u)^i", moves=RESPONSE,
        signature="after each reversal force lags by a constant distance; small cycles never develop full friction",
        confused_with={
            "channel_delay": "unlike accelerations at reversals: one distance is pre-sliding, one time a delay",
            "channel_filter": "the same; and the girder balance stays clean with pre-sliding",
        }, limits=(Limit("length", "high", "slide_curvature"),),  # what never slides is a spring
    ), rare=Rare(base="stick"),
)  # fmt: skip
