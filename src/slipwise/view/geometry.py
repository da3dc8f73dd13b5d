"""What a picture has to know of a rig's shape."""

from dataclasses import dataclass

import numpy as np

from slipwise.channels import PADS
from slipwise.errors import SettingError
from slipwise.rig import Specimen

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

    def __post_init__(self) -> None:
        """Refuse shapes that cannot be drawn."""
        lengths = (*self.girder_size, *self.table_size, self.girder_centre_height, self.pad_radius)
        if min(lengths) <= 0.0 or self.mass <= 0.0 or self.gravity <= 0.0:
            raise SettingError("sizes, centre height, pad radius, mass and gravity of a rig must be above zero")
        if not 1 <= len(self.pad_places) <= len(PADS):
            raise SettingError(f"a rig is drawn with one to four pads, A to D, not with {len(self.pad_places)}")

    @property
    def pad_load(self) -> float:
        """Load on one pad at rest if all carry the same [N]."""
        return self.mass * self.gravity / len(self.pad_places)

    @property
    def pads(self) -> tuple[str, ...]:
        """Names of the pads that the rig has."""
        return PADS[: len(self.pad_places)]

    @property
    def half_spacing(self) -> tuple[float, float]:
        """Half the distance of the pads along x and y [m]."""
        places = np.abs(np.array(self.pad_places))
        return float(places[:, 0].max()), float(places[:, 1].max())


def geometry_of(specimen: Specimen) -> RigGeometry:
    """Give the shape of a specimen; what its rated values do not say is drawn to fit its pads."""
    half_x, half_y = specimen.half_spacing
    reach_x, reach_y = max(2.0 * half_x, 0.8), max(2.0 * half_y, 0.8)
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
    )
