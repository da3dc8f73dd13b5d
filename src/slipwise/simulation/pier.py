"""The bridge between the ground and the shaking table: what the top of a pier does.

The paper's table followed the pier's top, not the ground: the whole bridge was analysed first. Its bridge model is not
in the text, so this is a small one in the plane of shaking: a rigid superstructure on isolators and buffers on piers.
Each pier is a mass on a spring and a damper sideways; upwards, pier and superstructure ride on the pier's axial spring.

    M v_s' = -M a_g - sum (F_i + k_b x_i)          m_i u_i'' = -m_i a_g - k_i u_i - c_i u_i' + F_i + k_b x_i
    x_i = slip over pier i,   |F_i| <= the model's law at load M_i (g + a_z) and speed |x_i'|

Friction is set-valued: a step asks for the force that stops the slip, and takes what the pads can give. Everything is
in the prototype's size and time until `pier_top` shortens the time to the model's.

Source: paper, Input motion and Fig. 5, for what is done; stiffness, mass and damping of piers are assumed.
"""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.linalg import expm

from slipwise.arrays import Array
from slipwise.errors import InputError, SettingError, SlipwiseWarning
from slipwise.model import Model, base_model
from slipwise.motion import TableMotion, resample, scale_time
from slipwise.rig import LENGTH_SCALE
from slipwise.short_repr import short_repr
from slipwise.simulation.kernel import fill, kernel

#: Step of the analysis, in the model's time [s]: that of a replay, so that nothing is resampled afterwards.
_STEP = 0.0005
#: Sweeps over the piers' friction forces in a step; one is exact for one pier.
_SWEEPS = 12


@dataclass(frozen=True)
class Pier:
    """One pier of the prototype; all values assumed, the paper's text has none.

    Attributes:
        stiffness: horizontal, at the top [N/m].
        mass: that moves with the top [kg].
        damping: fraction of critical of the pier on its own [1].
    """

    stiffness: float = 250e6
    mass: float = 300e3
    damping: float = 0.05

    def __post_init__(self) -> None:
        """Refuse a pier that cannot stand."""
        if not (self.stiffness > 0.0 and self.mass > 0.0 and 0.0 <= self.damping < 1.0):
            raise SettingError(
                f"a pier needs stiffness and mass above 0 and a damping of 0 to 1, not {self.stiffness:g} N/m, "
                f"{self.mass:g} kg, {self.damping:g}"
            )


@short_repr
@dataclass(frozen=True)
class BridgeSettings:
    """How the prototype is modelled.

    Attributes:
        piers: each carries as much superstructure and as many buffers as the specimen stands for; one stands for a long
            bridge of equal piers.
        top: the pier whose top drives the table.
        vertical_frequency: of pier and superstructure on the pier's axial stiffness [Hz].
        vertical_damping: its fraction of critical [1].
        similar_law: True shortens the speed that the friction law sees to the model's, as if n scaled; the real
            material does not do that.
    """

    piers: Sequence[Pier] = field(default_factory=lambda: (Pier(),))
    top: int = 0
    vertical_frequency: float = 20.0
    vertical_damping: float = 0.05
    similar_law: bool = False

    def __post_init__(self) -> None:
        """Refuse settings that cannot go together."""
        if not 0 <= self.top < len(self.piers):
            raise SettingError(f"top = {self.top}: there are piers 0 to {len(self.piers) - 1}")
        if not (self.vertical_frequency > 0.0 and 0.0 <= self.vertical_damping < 1.0):
            raise SettingError("vertical_frequency must be above 0 and vertical_damping within 0 to 1")


@dataclass(frozen=True)
class BridgeResponse:
    """What the bridge does, in the prototype's size and time; all (n,) at one pier.

    Attributes:
        dt: step [s].
        ground_ax: of the ground [m/s^2].
        pier_ax: of the pier's top, absolute [m/s^2].
        pier_az: the same upwards [m/s^2].
        deck_ax: of the superstructure, absolute [m/s^2].
        slip: of the superstructure over the pier [m].
        friction: of all isolators on the pier, positive when the superstructure slides to + [N].
    """

    dt: float
    ground_ax: Array
    pier_ax: Array
    pier_az: Array
    deck_ax: Array
    slip: Array
    friction: Array


def pier_top(
    motion: TableMotion, bridge: str, settings: BridgeSettings | None = None, model: Model | None = None
) -> TableMotion:
    """Turn a ground motion in the prototype's time into the table motion of the model.

    Args:
        motion: of the ground; x and z are used, y is left out of a model in the plane.
        bridge: "bridge1" or "bridge2".
        settings: of the bridge; one assumed pier when not given.
        model: the specimen that stands for the bridge, with its friction law; the paper's when not given.

    Raises:
        SettingError: the paper has no such bridge.
        InputError: nothing shakes it in x.
    """
    return table_motion(motion, bridge, bridge_response(motion, bridge, settings, model))


def table_motion(motion: TableMotion, bridge: str, response: BridgeResponse) -> TableMotion:
    """Turn what the bridge did under a ground motion into the table motion of its model."""
    values = np.zeros((len(response.pier_ax), 3))
    values[:, 0], values[:, 2] = response.pier_ax, response.pier_az
    words = f"turned into the response at the top of a pier of {bridge} (assumed pier: slipwise.simulation.pier)"
    if np.any(motion.acceleration[:, 1]):
        words += "; y left out"
    top = replace(
        motion,
        dt=response.dt,
        acceleration=values,
        title=f"{motion.title}, at the pier top of {bridge}",
        components=(motion.components[0], "", motion.components[2]),
        treatment=(*motion.treatment, words),
        steady=None,
    )
    return scale_time(top, LENGTH_SCALE[bridge])


def bridge_response(
    motion: TableMotion, bridge: str, settings: BridgeSettings | None = None, model: Model | None = None
) -> BridgeResponse:
    """Shake the bridge.

    Args:
        motion: of the ground, in the prototype's time.
        bridge: "bridge1" or "bridge2".
        settings: of the bridge; one assumed pier when not given.
        model: the specimen that stands for the bridge, with its friction law; the paper's when not given.

    Raises:
        SettingError: the paper has no such bridge.
        InputError: nothing shakes it in x.
        SlipwiseWarning: as a warning, where a component across is left out.
    """
    if bridge not in LENGTH_SCALE:
        raise SettingError(f"the paper has no bridge {bridge!r}; possible: {', '.join(LENGTH_SCALE)}")
    if not np.any(motion.acceleration[:, 0]):
        raise InputError(f"{motion.title}: nothing moves in x, so the pier would not sway; choose --x")
    if np.any(motion.acceleration[:, 1]):
        words = f"{motion.title}: the bridge is modelled in its plane, y is left out"
        warnings.warn(words, SlipwiseWarning, stacklevel=2)
    chosen = settings or BridgeSettings()
    scale = LENGTH_SCALE[bridge]
    ground = resample(motion, _STEP * scale**0.5)
    vertical = _oscillator(ground.acceleration[:, 2], ground.dt, chosen.vertical_frequency, chosen.vertical_damping)
    return _march(ground.dt, ground.acceleration[:, 0], vertical, scale, chosen, model or base_model(bridge))


def _oscillator(ground: Array, dt: float, frequency: float, damping: float) -> Array:
    """Return the absolute acceleration of a mass on a spring and a damper, exact for straight lines between samples."""
    omega = 2.0 * np.pi * frequency
    block = np.zeros((4, 4))
    block[:2, :2] = dt * np.array([[0.0, 1.0], [-(omega**2), -2.0 * damping * omega]])
    block[1, 2], block[2, 3] = -dt, 1.0
    step = expm(block)
    (a, b), (c, d) = step[:2, :2].tolist()
    (p, q), (r, s) = step[:2, 2:].tolist()
    place = rate = 0.0
    out = np.zeros_like(ground)
    values = ground.tolist()
    for i, (now, then) in enumerate(zip(values[:-1], values[1:], strict=True)):
        rise = then - now
        place, rate = a * place + b * rate + p * now + q * rise, c * place + d * rate + r * now + s * rise
        out[i + 1] = -(omega**2) * place - 2.0 * damping * omega * rate
    return out


def _resolved(pier: Pier, dt: float) -> None:
    """Refuse a pier that swings too fast for the step: the midpoint rule would let it ring for ever.

    Raises:
        SettingError: its frequency on its own is above a tenth of the sampling rate.
    """
    frequency = float(np.sqrt(pier.stiffness / pier.mass)) / (2.0 * np.pi)
    if frequency > 0.1 / dt:
        raise SettingError(
            f"a pier of {pier.stiffness / 1e6:g} kN/mm and {pier.mass / 1e3:g} t swings at {frequency:.0f} Hz on its "
            f"own; at most {0.1 / dt:.0f} Hz can be followed: give it more mass or less stiffness"
        )


def _march(
    dt: float, ground: Array, vertical: Array, scale: float, chosen: BridgeSettings, model: Model
) -> BridgeResponse:
    """Step superstructure and piers; midpoint rule for the springs, projection for the friction."""
    specimen, count = model.built_specimen(), len(chosen.piers)
    law = kernel()
    numbers = fill(law.layout, model, dt)
    bound_of, memory = law.functions["pad_bound"], law.layout.first_pad
    pads, mass = len(specimen.pads), specimen.mass * scale**2
    buffer = sum(specimen.buffer_stiffness) * scale
    shorter = 1.0 / scale**0.5 if chosen.similar_law else 1.0
    for pier in chosen.piers:
        _resolved(pier, dt)
    masses = np.array([count * mass, *(p.mass for p in chosen.piers)])
    couple = np.concatenate([np.ones((1, count)), -np.eye(count)])  # slip rates = couple.T @ velocities
    own = np.diag([0.0, *(p.stiffness for p in chosen.piers)])
    stiffness = own + buffer * couple @ couple.T
    damping = np.diag([0.0, *(2.0 * p.damping * np.sqrt(p.stiffness * p.mass) for p in chosen.piers)])
    system = np.linalg.inv(np.diag(masses) + 0.5 * dt * damping + 0.25 * dt**2 * stiffness)
    lever = dt * couple.T @ system @ couple
    drift = np.eye(count + 1) - dt * system @ (damping + 0.5 * dt * stiffness)
    pull, push = -dt * system @ stiffness, -dt * system @ masses
    spread = -dt * system @ couple
    place, velocity, force = np.zeros(count + 1), np.zeros(count + 1), np.zeros(count)
    middle = 0.5 * (ground[1:] + ground[:-1])
    lift = 0.5 * (vertical[1:] + vertical[:-1])
    out = np.zeros((len(middle), 4))
    top = chosen.top
    for i, (a_x, a_z) in enumerate(zip(middle.tolist(), lift.tolist(), strict=True)):
        load = max(specimen.mass * (specimen.gravity + a_z) / pads, 0.0)
        rates = couple.T @ velocity
        bounds = [
            pads * scale**2 * bound_of(numbers, memory, load, v * shorter, 0.0, 0.0, 0.0, 1.0, 1.0, i * dt, dt)
            for v in rates.tolist()
        ]
        free = drift @ velocity + pull @ place + push * a_x
        wanted = couple.T @ free
        for _ in range(1 if count == 1 else _SWEEPS):
            for p in range(count):
                left = wanted[p] - lever[p] @ force + lever[p, p] * force[p]
                force[p] = min(max(left / lever[p, p], -bounds[p]), bounds[p])
        new = free + spread @ force
        place = place + 0.5 * dt * (velocity + new)
        absolute = (new - velocity) / dt + a_x
        out[i] = absolute[1 + top], absolute[0], place[0] - place[1 + top], force[top]
        velocity = new
    return BridgeResponse(dt, middle, out[:, 0], lift, out[:, 1], out[:, 2], out[:, 3])
