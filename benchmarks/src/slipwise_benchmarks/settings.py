"""Everything a rig of the bench has, its hidden effects included: numbers only, SI, all effects absent by default."""

from typing import Any, NamedTuple

import numpy as np

from slipwise_benchmarks.parts import Buffer, Pad, Storey, Use

GRAVITY = 9.80665
PAD_AREA = np.pi * 0.0215**2
PADS = ("A", "B", "C", "D")
PAD_SIGN_X = (1.0, -1.0, 1.0, -1.0)
PAD_SIGN_Y = (1.0, 1.0, -1.0, -1.0)
#: (height of the centre of gravity [m], both buffers' stiffness [N/m])
RIGS = {"bridge1": (0.366, 3.4612e6), "bridge2": (0.732, 2.2514e6), "block": (0.366, 0.0)}

#: One value for each pad.
Each = tuple[float, ...]
NONE: Each = (0.0, 0.0, 0.0, 0.0)
ONES: Each = (1.0, 1.0, 1.0, 1.0)


class Settings(NamedTuple):
    """The rig and its hidden effects.

    A `_form` chooses between laws of one effect (0: absent). Lengths [m], forces [N], speeds [m/s], masses [kg],
    times [s].
    """

    # specimen: a box of 3 x 5 x 0.5 m on four pads, 3 m apart in x and 5 m in y, and two buffers
    mass: float = 1.0e4
    height: float = 0.366
    inertia_roll: float = 21041.7
    inertia_pitch: float = 7708.3
    inertia_yaw: float = 28333.3
    spacing_x: float = 3.0
    spacing_y: float = 5.0
    centre_x: float = 0.0
    centre_y: float = 0.0
    pad_area: float = PAD_AREA
    pad_stiffness: float = 2.5e8
    pad_damping: float = 6.0e4
    seating: Each = NONE
    # eq. (7), and a stick that is elastic over a few micrometres with a share of critical damping
    s1: float = 1.379e6
    n: float = 19.7
    k: float = 0.102e-6
    alpha: float = 0.046
    stick_length: float = 4.0e-6
    stick_damping: float = 0.6
    # both buffers together, at x = 0, y = +-buffer_place
    buffer_stiffness: float = 3.4612e6
    buffer_place: float = 1.5
    buffer_height: float = 0.0
    # another specimen: its pads and buffers in place of these; their spacing, total stiffness and so on stand above too
    pads: tuple[Pad, ...] = ()
    buffers: tuple[Buffer, ...] = ()
    # a frame on the girder, its floors from below
    storeys: tuple[Storey, ...] = ()
    # weight, load of a pad and spans over those of the girder of 10 t: hidden forces and lengths go with them
    size: float = 1.0
    pad_size: float = 1.0
    length: float = 1.0
    # pad friction
    breakaway_form: int = 0
    breakaway: float = 0.0
    breakaway_speed: float = 0.01
    breakaway_ageing: float = 0.0
    presliding_form: int = 0
    presliding_length: float = 1.0e-4
    presliding_lag: float = 0.0
    heat_form: int = 0
    heat: float = 0.0
    heat_time: float = 10.0
    wear_form: int = 0
    wear: float = 0.0
    wear_length: float = 0.3
    rate_form: int = 0
    rate_direct: float = 0.0
    rate_evolution: float = 0.0
    age_length: float = 1.0e-4
    pressure_form: int = 0
    pressure_size: float = 0.0
    asymmetry: float = 0.0
    anisotropy: float = 0.0
    patch_form: int = 0
    patch: Each = NONE
    patch_place: float = 0.0
    patch_width: float = 0.005
    pad_factor: Each = ONES
    # friction of each run over what it should be; none: the same in all
    run_levels: Each = ()
    tilt: float = 0.0
    curvature: float = 0.0
    # buffers and key
    buffer_damping_form: int = 0
    buffer_damping: float = 0.0
    buffer_relaxation: float = 0.02
    hysteresis_form: int = 0
    hysteresis_force: float = 0.0
    hysteresis_length: float = 2.0e-3
    hardening: float = 0.0
    hardening_length: float = 0.02
    hardening_power: float = 2.0
    softening_form: int = 0
    softening: float = 0.0
    softening_length: float = 0.01
    mismatch: float = 0.0
    clearance: float = 0.0
    key_impact: float = 0.0
    key_form: int = 0
    key_friction: float = 0.0
    key_scale: float = 2.0e-4
    # girder and table
    bending_mass: float = 0.0
    bending_frequency: float = 15.0
    bending_damping: float = 0.02
    bending_gauge: float = 0.0
    drag_form: int = 0
    drag: float = 0.0
    pitch_form: int = 0
    pitch_per_acceleration: float = 0.0
    pitch_frequency: float = 15.0
    # outside the catalogue
    unknown_form: int = 0
    unknown_size: float = 0.0
    unknown_scale: float = 1.0
    unknown_place: float = 0.0
    clock: float = 0.0
    # a law of `laws`: numbers of its port, form and states; along the slip velocity or not; share of each pad
    law_port: int = 0
    law_form: int = 0
    law_state: int = 0
    law_other: int = 0
    law_signed: int = 1
    law_pads: Each = ONES
    law_size: float = 0.0
    law_place: float = 0.0
    law_scale: float = 1.0
    law_back: float = 0.0
    law_phase: float = 0.0
    law_exponent: float = 1.0
    law_time: float = 0.01
    # whether the base law's shadow knows each pad's own slip speed (yaw recorded) or only that of the pads' middle
    yaw_known: int = 0
    # effects of the library's catalogue, where the library shakes the rig
    uses: tuple[Use, ...] = ()

    def changed(self, **changes: Any) -> "Settings":
        """Give a copy with other values, each of the type that the default has (one compiled loop serves them all)."""
        typed = {name: _like(getattr(_DEFAULT, name), value) for name, value in changes.items()}
        return self._replace(**typed)

    def of_run(self, number: int, clock: float) -> "Settings":
        """Give the specimen as it is in a run of the campaign: half an hour after the one before, cold or warm.

        Args:
            number: of the run.
            clock: of the first run [s].
        """
        now = self.changed(clock=clock + 1800.0 * number)
        if not self.run_levels:
            return now
        level = self.run_levels[number % len(self.run_levels)]
        return now.changed(pad_factor=tuple(level * factor for factor in self.pad_factor))


_DEFAULT = Settings()


def _like(default: Any, value: Any) -> Any:
    if default == ():  # pads, buffers, storeys, levels of runs, uses
        return tuple(value)
    if isinstance(default, tuple):
        return tuple(float(one) for one in value)
    return type(default)(value)


def pads_of(settings: Settings) -> tuple[Pad, ...]:
    """Give the pads of a rig: its own, or four at the corners."""
    p = settings
    if p.pads:
        return p.pads
    half_x, half_y = 0.5 * p.spacing_x, 0.5 * p.spacing_y
    places = zip(PADS, PAD_SIGN_X, PAD_SIGN_Y, strict=True)
    kind = (p.pad_area, p.pad_stiffness, p.pad_damping)
    return tuple(Pad(name, half_x * x, half_y * y, *kind) for name, x, y in places)


def buffers_of(settings: Settings) -> tuple[Buffer, ...]:
    """Give the buffers of a rig: its own, or one at either side."""
    p = settings
    if p.pads:
        return p.buffers
    half = 0.5 * p.buffer_stiffness
    return tuple(Buffer(name, 0.0, y, 0.0, half, half) for name, y in (("1", p.buffer_place), ("2", -p.buffer_place)))


def pad_names(settings: Settings) -> tuple[str, ...]:
    """Give the names of the pads."""
    return tuple(pad.name for pad in pads_of(settings))


def rated(rig: str) -> Settings:
    """Give the rated values of bridge1, bridge2 or block (bridge1 without buffers)."""
    height, stiffness = RIGS[rig]
    return Settings().changed(height=height, buffer_stiffness=stiffness)


def drawn_law(base: Settings, rng: np.random.Generator) -> dict[str, float]:
    """Draw a pad's law near that of a rig, and the stick over which it turns round, as settings."""
    return {
        "s1": base.s1 * (1.0 + rng.normal(0.0, 0.04)),
        "n": base.n * (1.0 + rng.normal(0.0, 0.06)),
        "k": base.k * (1.0 + rng.normal(0.0, 0.05)),
        "alpha": base.alpha * (1.0 + rng.normal(0.0, 0.05)),
        "stick_length": rng.uniform(2.0e-6, 1.0e-5),
        "stick_damping": rng.uniform(0.4, 1.0),
    }


def random_rig(rig: str, rng: np.random.Generator) -> Settings:
    """Give a specimen whose base parameters are several percent off the rated ones.

    Heave is between 40 and 60 Hz, pitch (on its four pads, about the centre of gravity) between 50 and 100 Hz.
    """
    base = rated(rig)
    mass = base.mass * (1.0 + rng.normal(0.0, 0.004))
    stiffness = 0.25 * mass * (2.0 * np.pi * rng.uniform(40.0, 60.0)) ** 2
    pitch = 2.0 * np.pi * rng.uniform(*((70.0, 100.0) if rig == "bridge1" else (52.0, 85.0)))
    inertia_pitch = stiffness * base.spacing_x**2 / pitch**2
    return base.changed(
        mass=mass,
        height=base.height * (1.0 + rng.normal(0.0, 0.01)),
        inertia_pitch=np.clip(inertia_pitch, 6.0e3, 1.6e4),
        inertia_roll=base.inertia_roll * rng.uniform(0.9, 1.15),
        inertia_yaw=base.inertia_yaw * rng.uniform(0.9, 1.1),
        pad_stiffness=stiffness,
        pad_damping=2.0 * rng.uniform(0.02, 0.06) * np.sqrt(stiffness * 0.25 * mass),
        **drawn_law(base, rng),
        buffer_stiffness=base.buffer_stiffness * (1.0 + rng.normal(0.0, 0.04)),
    )
