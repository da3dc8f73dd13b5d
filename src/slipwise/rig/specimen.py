"""A specimen: the rated values of a rig, and where its MJCF file lies."""

from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.channels import BUFFERS
from slipwise.errors import SettingError, unknown_name
from slipwise.rig.similarity import LENGTH_SCALE

#: Specimens that ship with the package.
RIGS: tuple[str, ...] = ("bridge1", "bridge2", "block", "pad")


#: What any rig can have, from a tribometer to a bridge at full size: low, high, unit. Assumed.
_BOUNDS: dict[str, tuple[float, float, str]] = {
    "mass": (1e-3, 1e8, "kg"),
    "inertia": (1e-12, 1e14, "kg m^2"),
    "centre_height": (1e-4, 100.0, "m"),
    "centre_x": (-100.0, 100.0, "m"),
    "centre_y": (-100.0, 100.0, "m"),
    "pad_places": (-100.0, 100.0, "m"),
    "pad_radius": (1e-5, 10.0, "m"),
    "pad_stiffness": (1.0, 1e15, "N/m"),
    "pad_damping": (0.0, 1e15, "N s/m"),
    "plastic_pressure": (1.0, 1e14, "Pa"),
    "shear_strength": (1e-3, 1e14, "Pa"),
    "buffer_stiffness": (0.0, 1e15, "N/m"),
    "buffer_places": (-100.0, 100.0, "m"),
    "buffer_height": (-100.0, 100.0, "m"),
    "seating": (-1.0, 1.0, "m"),
    "edge_distance": (1e-4, 100.0, "m"),
    "bending_frequency": (1e-2, 1e5, "Hz"),
    "bending_damping": (0.0, 1.0, "of critical"),
    "gravity": (1e-2, 1e3, "m/s^2"),
}


def out_of_bounds(name: str, given: Any) -> str:
    """Say what is wrong with a value of a specimen, or nothing: a number or a tuple of them [SI]."""
    if name not in _BOUNDS:
        return ""
    low, high, unit = _BOUNDS[name]
    for value in np.ravel(given):
        if not low <= value <= high:
            return f"{name} = {value:g} {unit} cannot be; possible are {low:g} to {high:g} {unit}: look at its unit"
    return ""


@dataclass(frozen=True)
class Specimen:
    """What is known of a rig before it is shaken. All SI; x is the shaking direction, z is up.

    Attributes:
        name: as in the MJCF file.
        path: the MJCF file.
        mass: of girder and everything above the pads [kg].
        inertia: about the centre of gravity, roll, pitch, yaw [kg m^2].
        centre_height: centre of gravity above the sliding plane [m].
        centre_x: centre of gravity off the middle of the pads [m].
        centre_y: the same across [m].
        pads: names of the pads that the rig has.
        pad_places: (n_pads, 2) of the pads from their middle [m].
        pad_radius: of the sliding disc [m].
        pad_stiffness: vertical, of each pad with its cell [N/m].
        pad_damping: vertical, of each pad [N s/m].
        pads_on: the side that carries the pads: "table" (weight moves over them, P-delta) or "girder".
        seating: (n_pads,) height of each pad above the mean plane [m].
        plastic_pressure: p_m of eq. (2), the real pressure of contact without `contact_area` [Pa].
        shear_strength: s of eq. (1) without `shear_rate` [Pa].
        stick_capacity: "slow" sticks up to friction at zero speed, "full" up to friction at high speed.
        buffer_stiffness: (2,) horizontal, of each buffer [N/m]; empty without buffers.
        buffer_places: (n_buffers, 2) of the buffers from the middle of the pads [m].
        buffer_height: of the buffers' force above the sliding plane [m].
        bending_mass: modal mass of the girder's first vertical mode; 0 for a rigid girder [kg].
        bending_frequency: its frequency on a fixed base [Hz].
        bending_damping: its fraction of critical damping [1].
        edge_distance: of the two gauges of `girder_az_1` and `_2` from the centre of gravity, along x [m].
        gravity: [m/s^2].
        free: whether the girder can move horizontally; False where slip is prescribed.
        sources: where each rated value comes from.
    """

    name: str
    path: Path
    mass: float
    inertia: tuple[float, float, float]
    centre_height: float
    pads: tuple[str, ...]
    pad_places: tuple[tuple[float, float], ...]
    pad_radius: float
    pad_stiffness: float
    pad_damping: float
    plastic_pressure: float
    shear_strength: float
    buffer_stiffness: tuple[float, ...]
    buffer_places: tuple[tuple[float, float], ...]
    gravity: float
    free: bool = True
    centre_x: float = 0.0
    centre_y: float = 0.0
    pads_on: str = "table"
    seating: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)
    stick_capacity: str = "slow"
    buffer_height: float = 0.0
    edge_distance: float = 1.5
    bending_mass: float = 0.0
    bending_frequency: float = 15.0
    bending_damping: float = 0.02
    sources: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Refuse values that no rig can have, and values that do not belong together."""
        for name in _BOUNDS:
            if wrong := out_of_bounds(name, getattr(self, name)):
                raise SettingError(f"{self.name}: {wrong}")
        if not len(self.pads) == len(self.pad_places) == len(self.seating):
            raise SettingError(
                f"{self.name}: {len(self.pads)} pads, {len(self.pad_places)} pad_places and {len(self.seating)} values "
                "of seating; give one of each for every pad"
            )
        if not len(self.buffer_stiffness) == len(self.buffer_places) <= len(BUFFERS):
            raise SettingError(
                f"{self.name}: {len(self.buffer_stiffness)} values of buffer_stiffness and {len(self.buffer_places)} "
                f"buffer_places; give one of each for every buffer, at most {len(BUFFERS)}"
            )
        if not 0.0 <= self.bending_mass < self.mass:
            raise SettingError(
                f"{self.name}: bending_mass = {self.bending_mass:g} kg must be below the mass {self.mass:g} kg"
            )
        if self.pads_on not in ("table", "girder"):
            raise unknown_name("side that carries the pads", self.pads_on, ("table", "girder"))
        if self.stick_capacity not in ("slow", "full"):
            raise unknown_name("stick capacity", self.stick_capacity, ("slow", "full"))

    @property
    def pad_area(self) -> float:
        """Apparent area of one pad [m^2]."""
        return float(np.pi * self.pad_radius**2)

    @property
    def weight(self) -> float:
        """Weight of the girder [N]."""
        return self.mass * self.gravity

    @property
    def rated_pressure(self) -> float:
        """Pressure on a pad at rest [Pa]."""
        return self.weight / len(self.pads) / self.pad_area

    @property
    def half_spacing(self) -> tuple[float, float]:
        """Half the distance of the pads along x and y [m]."""
        places = np.abs(np.array(self.pad_places))
        return float(places[:, 0].max()), float(places[:, 1].max())

    @property
    def slenderness(self) -> float:
        """h/b of the paper: height of the centre of gravity over pad spacing in the shaking direction [1]."""
        return self.centre_height / (2.0 * self.half_spacing[0]) if self.half_spacing[0] else float("nan")

    @property
    def frequency(self) -> float:
        """Natural frequency of the girder on its buffers, without friction [Hz]."""
        return float(np.sqrt(sum(self.buffer_stiffness) / self.mass) / (2.0 * np.pi))

    @property
    def length_scale(self) -> float:
        """Prototype length over model length [1].

        Raises:
            SettingError: the specimen has no prototype in the paper.
        """
        if self.name not in LENGTH_SCALE:
            raise SettingError(f"{self.name} has no prototype in the paper; possible: {', '.join(LENGTH_SCALE)}")
        return LENGTH_SCALE[self.name]


def models_folder() -> Path:
    """Give the folder of the MJCF files: inside the installed package, or beside `src` in a checkout."""
    packed = Path(str(files("slipwise"))) / "models"
    return packed if packed.is_dir() else Path(__file__).parents[3] / "models"


def shipped_file(free: bool) -> str:
    """Give the name of the shipped file in which a rig is replayed: of a girder that is free, or of prescribed slip."""
    return "bridge1.xml" if free else "pad.xml"


def find_rig(rig: str | Path, beside: Path | None = None) -> Path:
    """Find the MJCF file of a rig given by name or by path.

    Args:
        rig: one of `RIGS` or the path of an MJCF file.
        beside: folder from which a relative path is meant.

    Raises:
        UnknownNameError: neither a name nor a file.
    """
    if str(rig) in RIGS:
        return models_folder() / f"{rig}.xml"
    path = (beside / str(rig)) if beside is not None else Path(rig)
    if path.suffix == ".xml" and path.is_file():
        return path
    raise unknown_name("rig", str(rig), RIGS, "`slipwise rigs` lists them; the path of an MJCF file works too.")
