"""What a picture has to know of a rig's shape."""

from dataclasses import dataclass
from string import ascii_uppercase

import numpy as np

from slipwise.errors import SettingError
from slipwise.rig import Specimen
from slipwise.rig.load_basis import LoadBasis, load_basis
from slipwise.rig.storeys import Storey

Place = tuple[float, float]


@dataclass(frozen=True)
class RigGeometry:
    """The shape of a rig; x is the shaking direction, z is up, z = 0 is the sliding plane.

    Attributes:
        girder_size: length of the girder along x, y, z [m].
        girder_centre_height: of the centre of gravity above the sliding plane [m].
        pad_places: of the pads, A first, from their middle, (n_pads, 2) [m].
        pad_radius: of the sliding disc [m].
        buffer_places: of the buffers from the middle of the pads, (n_buffers, 2) [m].
        table_size: length of the table along x, y, z [m].
        mass: of the girder [kg].
        gravity: [m/s^2].
        pads_on: the side that carries the pads, "table" or "girder".
        pad_names: of the pads; A, B ... when not given.
        buffer_names: of the buffers; 1, 2 ... when not given.
        pad_springs: vertical stiffness of each pad; the same when not given [N/m].
        centre: of gravity from the middle of the table, along x and y [m].
        storeys: of a frame that stands on the girder, from below.
        pad_curvatures: 1/R of the plate of each pad, above zero for a bowl; flat when not given [1/m].
    """

    girder_size: tuple[float, float, float]
    girder_centre_height: float
    pad_places: tuple[Place, ...]
    pad_radius: float
    buffer_places: tuple[Place, ...]
    table_size: tuple[float, float, float]
    mass: float
    gravity: float
    pads_on: str = "table"
    pad_names: tuple[str, ...] = ()
    buffer_names: tuple[str, ...] = ()
    pad_springs: tuple[float, ...] = ()
    centre: Place = (0.0, 0.0)
    storeys: tuple[Storey, ...] = ()
    pad_curvatures: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        """Refuse shapes that cannot be drawn."""
        lengths = (*self.girder_size, *self.table_size, self.girder_centre_height, self.pad_radius)
        if min(lengths) <= 0.0 or self.mass <= 0.0 or self.gravity <= 0.0:
            raise SettingError("sizes, centre height, pad radius, mass and gravity of a rig must be above zero")
        if not self.pad_places:
            raise SettingError("a rig is drawn with one pad or more; it has none")

    @property
    def carried_mass(self) -> float:
        """Mass of all that the pads carry [kg]: the girder and its storeys."""
        return self.mass + sum(storey.mass for storey in self.storeys)

    @property
    def pad_load(self) -> float:
        """Load on one pad at rest if all carry the same [N]."""
        return self.carried_mass * self.gravity / len(self.pad_places)

    @property
    def pads(self) -> tuple[str, ...]:
        """Names of the pads that the rig has."""
        return self.pad_names or tuple(ascii_uppercase[: len(self.pad_places)])

    @property
    def buffers(self) -> tuple[str, ...]:
        """Names of the buffers that the rig has."""
        return self.buffer_names or tuple(str(i + 1) for i in range(len(self.buffer_places)))

    @property
    def basis(self) -> LoadBasis:
        """Heave, pitch, roll and warp of the loads on the pads."""
        return load_basis(self.pad_places, self.pad_springs or None)

    @property
    def half_spacing(self) -> tuple[float, float]:
        """Largest distance of a pad from their middle along x and y [m]."""
        return self.basis.half


def geometry_of(specimen: Specimen) -> RigGeometry:
    """Return the shape of a specimen; what its rated values do not say is drawn to fit its pads."""
    reach = 2.0 * np.abs(np.array(specimen.pad_places)).max(axis=0)
    reach_x, reach_y = (max(float(length), 0.8) for length in reach)
    return RigGeometry(
        girder_size=(reach_x, reach_y, 0.5),
        girder_centre_height=specimen.centre_height,
        pad_places=specimen.pad_places,
        pad_radius=specimen.pad_radius,
        buffer_places=specimen.buffer_places,
        table_size=(reach_x + 0.5, reach_y + 0.5, 0.2),
        mass=specimen.mass,
        gravity=specimen.gravity,
        pads_on=specimen.pads_on,
        pad_names=specimen.pads,
        buffer_names=tuple(buffer.name for buffer in specimen.buffers),
        pad_springs=specimen.springs,
        centre=(specimen.centre_x, specimen.centre_y),
        storeys=specimen.storeys,
        pad_curvatures=tuple(place.curvature for place in specimen.places),
    )
