"""A rigid girder that slides and hops in a plane, integrated from event to event: what a replay is held against.

Coordinates relative to the table: x [m], z [m] (zero where the unloaded pads just touch), pitch [rad] about y. The pads
at +b and -b carry N = k d + c d' while that is positive; Coulomb friction of the sum of the loads acts at the sliding
plane, a buffer there pulls back with k_b times the slip. Between events (a pad lands, a pad lifts, sliding stops, stick
gives way) the equations are smooth and are integrated to 1e-10.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from slipwise.rig import Specimen

G = 9.80665
#: How long after an event the next one is looked for [s]: at the event itself its sign is that of a rounding error, and
#: a pad that lifts and lands again within one step of the integration would be missed.
_PAST = 1e-7


@dataclass(frozen=True)
class Answer:
    """What the reference gives.

    Attributes:
        time: (n,) of the samples [s].
        slip: (n,) at the sliding plane [m].
        energy: work against friction [J].
        lifts: times at which the pads at +x and at -x lift [s].
        landings: times at which they land [s].
    """

    time: np.ndarray
    slip: np.ndarray
    energy: float
    lifts: tuple[list[float], list[float]]
    landings: tuple[list[float], list[float]]


class Plane:
    """The equations of motion of one specimen under a table's acceleration (x and z, of time) [m/s^2]."""

    def __init__(self, specimen: Specimen, mu: float, table: Callable[[float], tuple[float, float]]) -> None:
        self.table, self.mu = table, mu
        self.mass, self.inertia, self.height = specimen.mass, specimen.inertia[1], specimen.centre_height
        pads = len(specimen.pads) / 2
        self.stiffness, self.damping = pads * specimen.pad_stiffness, pads * specimen.pad_damping
        self.places = (specimen.half_spacing[0], -specimen.half_spacing[0])
        self.radius, self.buffers = specimen.pad_radius, sum(specimen.buffer_stiffness)

    def pad(self, state: np.ndarray, side: int) -> tuple[float, float, np.ndarray]:
        """Give compression [m], its rate [m/s] and the direction (3,) in which it pushes x, z and pitch.

        The pad is a sphere on the table, which a plane below the girder touches.
        """
        x, z, pitch = state[:3]
        s, c = np.sin(pitch), np.cos(pitch)
        ahead, above = x - self.places[side], self.height + z + self.radius
        gap = ahead * s + above * c - self.height - self.radius
        push = np.array([s, c, ahead * c - above * s])
        return -gap, -float(push @ state[3:6]), push

    def bears(self, state: np.ndarray, side: int) -> float:
        """Give the force of a pad's spring and damper, which pulls where it is negative [N]."""
        compression, rate, _ = self.pad(state, side)
        return self.stiffness * compression + self.damping * rate

    def presses(self, state: np.ndarray, side: int) -> float:
        """Give what is above zero where a lifted pad touches and its spring and damper do not pull [N]."""
        return min(self.stiffness * self.pad(state, side)[0], self.bears(state, side))

    def slip_rate(self, state: np.ndarray) -> float:
        """Give the slip rate at the sliding plane [m/s]."""
        return state[3] - self.height * state[5]

    def forces(self, time: float, state: np.ndarray, bearing: list[bool]) -> tuple[np.ndarray, float]:
        """Give the acceleration (3,) without friction and the sum of the loads [N]."""
        ax, az = self.table(time)
        force = np.array([-self.mass * ax, -self.mass * (G + az), 0.0])
        pull = self.buffers * (state[0] - self.height * state[2])
        force += pull * np.array([-1.0, 0.0, self.height])
        total = 0.0
        for side in (0, 1):
            if bearing[side]:
                load = self.bears(state, side)
                force += load * self.pad(state, side)[2]
                total += load
        return force / np.array([self.mass, self.mass, self.inertia]), total

    def sticking(self, free: np.ndarray) -> float:
        """Give the friction that holds the slip rate where it is, under an acceleration (3,) without friction [N]."""
        return (free[0] - self.height * free[2]) / (1.0 / self.mass + self.height**2 / self.inertia)

    def rate(self, time: float, state: np.ndarray, bearing: list[bool], sliding: int) -> np.ndarray:
        """Give the rate of the state (x, z, pitch, their rates, work against friction)."""
        free, total = self.forces(time, state, bearing)
        friction = sliding * self.mu * total if sliding else self.sticking(free)
        free = free + friction * np.array([-1.0 / self.mass, 0.0, self.height / self.inertia])
        return np.array([*state[3:6], *free, friction * self.slip_rate(state)])


def integrate(
    specimen: Specimen, mu: float, table: Callable[[float], tuple[float, float]], seconds: float, dt: float
) -> Answer:
    """Integrate from rest; the slip is sampled every dt [s]."""
    plane = Plane(specimen, mu, table)
    state = np.zeros(7)
    state[1] = -plane.mass * G / (2.0 * plane.stiffness)
    bearing, sliding, now = [True, True], 0, 0.0
    samples, at = [], np.arange(round(seconds / dt)) * dt
    lifts: tuple[list[float], list[float]] = ([], [])
    landings: tuple[list[float], list[float]] = ([], [])
    while now < seconds:
        events = _events(plane, bearing, sliding)
        wanted = at[(at >= now) & (at < seconds)]
        answer = solve_ivp(
            plane.rate, (now, seconds), state, method="DOP853", rtol=1e-10, atol=1e-12, args=(bearing, sliding),
            events=[event for _, event in events], dense_output=True, max_step=2e-3,
        )  # fmt: skip
        end = float(answer.t[-1])
        inside = wanted[wanted < end]
        if len(inside):
            samples.append(answer.sol(inside)[0] - plane.height * answer.sol(inside)[2])
        now, state = end, answer.y[:, -1]
        happened = [name for (name, _), times in zip(events, answer.t_events, strict=True) if len(times)]
        for name in happened:
            if name[0] == "lift":
                bearing[name[1]] = False
                lifts[name[1]].append(now)
            elif name[0] == "land":
                bearing[name[1]] = True
                landings[name[1]].append(now)
        free, total = plane.forces(now, state, bearing)
        needed = plane.sticking(free)
        if total == 0.0:  # in flight nothing rubs: only the direction is kept
            sliding = -sliding if ("stop", -1) in happened else sliding or 1
        elif ("slide", -1) in happened:
            sliding = int(np.sign(needed))
        elif sliding == 0 or ("stop", -1) in happened:
            sliding = 0 if abs(needed) < plane.mu * total else int(np.sign(needed))
        state = state + _PAST * plane.rate(now, state, bearing, sliding)
        now += _PAST
    slip = np.concatenate(samples)
    return Answer(at[: len(slip)], slip, float(state[6]), lifts, landings)


def _events(plane: Plane, bearing: list[bool], sliding: int) -> list[tuple[tuple, Callable]]:
    """List what ends a smooth stretch."""
    out: list[tuple[tuple, Callable]] = []
    for side in (0, 1):
        if bearing[side]:
            out.append((("lift", side), _event(lambda t, y, *_, side=side: plane.bears(y, side), -1)))
        else:
            out.append((("land", side), _event(lambda t, y, *_, side=side: plane.presses(y, side), 1)))
    if sliding:
        out.append((("stop", -1), _event(lambda t, y, *_: sliding * plane.slip_rate(y), -1)))
    else:

        def left(time: float, state: np.ndarray, *_: object) -> float:
            free, total = plane.forces(time, state, bearing)
            return plane.mu * total - abs(plane.sticking(free))

        out.append((("slide", -1), _event(left, -1)))
    return out


def _event(function: Callable, direction: int) -> Callable:
    function.terminal, function.direction = True, direction  # type: ignore[attr-defined]
    return function
