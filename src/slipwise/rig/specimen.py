"""A specimen: the rated values of a rig, and where its MJCF file lies."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.errors import SettingError, unknown_name
from slipwise.rig.bounds import BOUNDS, out_of_bounds
from slipwise.rig.changed_parts import PART_VALUES, changed_parts
from slipwise.rig.places import MOST_PADS, Buffer, Place, check_parts, mean
from slipwise.rig.similarity import LENGTH_SCALE
from slipwise.rig.storeys import Storey, check_storeys
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class Specimen:
    """What is known of a rig before it is shaken. All SI; x is the shaking direction, z is up.

    Attributes:
        name: as in its file.
        path: the file: MJCF or specimen.toml.
        mass: of the girder with all that is fixed to it [kg].
        inertia: about the centre of gravity, roll, pitch, yaw [kg m^2].
        centre_height: centre of gravity above the sliding plane [m].
        centre_x: centre of gravity off the middle of the table [m].
        centre_y: the same across [m].
        places: of the pads, with what each is.
        pads_on: the side that carries the pads: "table" (weight moves over them, P-delta) or "girder".
        plastic_pressure: p_m of eq. (2), the real pressure of contact without `contact_area` [Pa].
        shear_strength: s of eq. (1) without `shear_rate` [Pa].
        stick_capacity: "slow" sticks up to friction at zero speed, "full" up to friction at high speed.
        friction: "pads" where the pads slide with friction; "none" where they only carry the weight and the buffers
            are the isolators, as rubber bearings are.
        buffers: none or more.
        bending_mass: modal mass of the girder's first vertical mode; 0 for a rigid girder [kg].
        bending_frequency: its frequency on a fixed base [Hz].
        bending_damping: its fraction of critical damping [1].
        edge_distance: of the two gauges of `girder_az_1` and `_2` from the centre of gravity, along x [m].
        gravity: [m/s^2].
        storeys: of a frame that stands on the girder, from below; none for a rigid specimen.
        free: whether the girder can move horizontally; False where slip is prescribed.
        sources: where each rated value comes from.
        stated: names of the values that a person stated in specimen.toml, campaign.toml or model.toml.
    """

    name: str
    path: Path
    mass: float
    inertia: tuple[float, float, float]
    centre_height: float
    places: tuple[Place, ...]
    plastic_pressure: float
    shear_strength: float
    buffers: tuple[Buffer, ...]
    gravity: float
    storeys: tuple[Storey, ...] = ()
    free: bool = True
    centre_x: float = 0.0
    centre_y: float = 0.0
    pads_on: str = "table"
    stick_capacity: str = "slow"
    friction: str = "pads"
    edge_distance: float = 1.5
    bending_mass: float = 0.0
    bending_frequency: float = 15.0
    bending_damping: float = 0.02
    sources: dict[str, str] = field(default_factory=dict)
    stated: tuple[str, ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        """Refuse values that no rig can have, and values that do not belong together."""
        for name in BOUNDS:
            if name in self.__dataclass_fields__ and (wrong := out_of_bounds(name, getattr(self, name))):
                raise SettingError(f"{self.name}: {wrong}")
        check_parts(self.name, "pad", self.places)
        check_parts(self.name, "buffer", self.buffers)
        check_storeys(self.name, self.storeys, 0.0)
        if self.storeys and not self.free:
            raise SettingError(f"{self.name}: storeys need a girder that is free; the slip of this one is prescribed")
        fewest = 3 if self.free else 1
        if not fewest <= len(self.places) <= (MOST_PADS if self.free else 1):
            possible = f"3 to {MOST_PADS} pads" if self.free else "one pad"
            kind = "a girder that is free stands on" if self.free else "a girder whose slip is prescribed stands on"
            raise SettingError(f"{self.name}: it has {len(self.places)} pads; {kind} {possible}")
        if not 0.0 <= self.bending_mass < self.mass:
            raise SettingError(
                f"{self.name}: bending_mass = {self.bending_mass:g} kg must be below the mass {self.mass:g} kg"
            )
        if self.pads_on not in ("table", "girder"):
            raise unknown_name("side that carries the pads", self.pads_on, ("table", "girder"))
        if self.stick_capacity not in ("slow", "full"):
            raise unknown_name("stick capacity", self.stick_capacity, ("slow", "full"))
        if self.friction not in ("pads", "none"):
            raise unknown_name("friction", self.friction, ("pads", "none"))
        if not self.slides and not self.free:
            raise SettingError(
                f'{self.name}: friction = "none" needs a girder that is free; a slider whose slip is prescribed shows '
                "nothing but its friction"
            )
        if not self.slides and not self.buffers:
            raise SettingError(
                f'{self.name}: with friction = "none" nothing holds the girder; give the isolators as [buffers], each '
                "with its place and its stiffness"
            )

    @property
    def slides(self) -> bool:
        """Whether the pads slide with friction; bearings that do not are buffers, and the pads carry the weight."""
        return self.friction == "pads"

    @property
    def pads(self) -> tuple[str, ...]:
        """Names of the pads."""
        return tuple(place.name for place in self.places)

    @property
    def pad_places(self) -> tuple[tuple[float, float], ...]:
        """Places of the pads from the middle of the table, (n_pads, 2) [m]."""
        return tuple((place.x, place.y) for place in self.places)

    @property
    def seating(self) -> tuple[float, ...]:
        """Height of each pad above the sliding plane, (n_pads,) [m]."""
        return tuple(place.z for place in self.places)

    @property
    def pad_radius(self) -> float:
        """Radius of the pads, their mean where they differ [m]."""
        return mean(place.radius for place in self.places)

    @property
    def pad_stiffness(self) -> float:
        """Vertical stiffness of a pad, their mean where they differ [N/m]."""
        return mean(place.stiffness for place in self.places)

    @property
    def pad_damping(self) -> float:
        """Vertical damping of a pad, their mean where they differ [N s/m]."""
        return mean(place.damping for place in self.places)

    @property
    def pad_areas(self) -> tuple[float, ...]:
        """Apparent area of each pad, (n_pads,) [m^2]."""
        return tuple(float(np.pi * place.radius**2) for place in self.places)

    @property
    def pad_area(self) -> float:
        """Apparent area of a pad, their mean where they differ [m^2]."""
        return mean(self.pad_areas)

    @property
    def pad_curvature(self) -> float:
        """Curvature of a pad's sliding face, their mean where they differ [1/m]; 0 for flat plates."""
        return mean(place.curvature for place in self.places)

    @property
    def springs(self) -> tuple[float, ...]:
        """Vertical stiffness of each pad, (n_pads,) [N/m]."""
        return tuple(place.stiffness for place in self.places)

    @property
    def buffer_stiffness(self) -> tuple[float, ...]:
        """Stiffness of each buffer along x, (n_buffers,) [N/m]."""
        return tuple(buffer.stiffness_x for buffer in self.buffers)

    @property
    def buffer_places(self) -> tuple[tuple[float, float], ...]:
        """Places of the buffers from the middle of the table, (n_buffers, 2) [m]."""
        return tuple((buffer.x, buffer.y) for buffer in self.buffers)

    @property
    def buffer_heights(self) -> tuple[float, ...]:
        """Height of each buffer's force above the sliding plane, (n_buffers,) [m]."""
        return tuple(buffer.z for buffer in self.buffers)

    @property
    def buffer_height(self) -> float:
        """The same, its mean where buffers differ; 0 without buffers [m]."""
        return mean(self.buffer_heights) if self.buffers else 0.0

    def changed(self, **values: Any) -> "Specimen":
        """Return the specimen with other values, by the names of its attributes and of what it tells of its pads.

        One number for all pads or buffers keeps the ratios in which they differ; `buffer_stiffness` scales both
        directions, `buffer_height` and `seating` are what they say, one number or one for each.

        Raises:
            SettingError: values that no rig can have, or not one for each.
        """
        of_parts = {name: values.pop(name) for name in PART_VALUES if name in values}
        places, buffers = values.pop("places", self.places), values.pop("buffers", self.buffers)
        for name, given in of_parts.items():
            if name.startswith("buffer"):
                buffers = changed_parts(self.name, name, buffers, given)
            else:
                places = changed_parts(self.name, name, places, given)
        return replace(self, places=places, buffers=buffers, **values)

    @property
    def carried_mass(self) -> float:
        """Mass of all that the pads carry [kg]: the girder and its storeys."""
        return self.mass + sum(storey.mass for storey in self.storeys)

    @property
    def weight(self) -> float:
        """Weight of all that the pads carry [N]."""
        return self.carried_mass * self.gravity

    @property
    def rated_pressure(self) -> float:
        """Mean pressure on the pads at rest [Pa]."""
        return self.weight / len(self.pads) / self.pad_area

    @property
    def middle(self) -> tuple[float, float]:
        """Middle of the pads, weighed by their stiffness, from the middle of the table [m]."""
        weights = np.array(self.springs) / sum(self.springs)
        x, y = weights @ np.array(self.pad_places)
        return float(x), float(y)

    @property
    def half_spacing(self) -> tuple[float, float]:
        """Largest distance of a pad from their middle along x and y [m]: half their spacing."""
        off = np.abs(np.array(self.pad_places) - self.middle)
        return float(off[:, 0].max()), float(off[:, 1].max())

    @property
    def pitch_stiffness(self) -> float:
        """Stiffness of the pads against pitch about the centre of gravity [N m]."""
        arms = np.array(self.pad_places)[:, 0] - self.centre_x
        return float(np.array(self.springs) @ arms**2)

    @property
    def slenderness(self) -> float:
        """h/b of the paper: height of the centre of gravity over pad spacing in the shaking direction [1]."""
        return self.centre_height / (2.0 * self.half_spacing[0]) if self.half_spacing[0] else float("nan")

    @property
    def frequency(self) -> float:
        """Natural frequency of the girder on its buffers, without friction [Hz]."""
        return float(np.sqrt(sum(self.buffer_stiffness) / self.carried_mass) / (2.0 * np.pi))

    @property
    def length_scale(self) -> float:
        """Prototype length over model length [1].

        Raises:
            SettingError: the specimen has no prototype in the paper.
        """
        if self.name not in LENGTH_SCALE:
            raise SettingError(f"{self.name} has no prototype in the paper; possible: {', '.join(LENGTH_SCALE)}")
        return LENGTH_SCALE[self.name]
