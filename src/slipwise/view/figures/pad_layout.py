"""Where each pad's panel stands, what it is called and which colour it has: seen from above where places are known."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.channels import PADS, pads_in
from slipwise.record import Record
from slipwise.view.figures.style import PAD_PANELS, PAD_PLACES, pad_colour
from slipwise.view.geometry import RigGeometry

#: Places that differ by less stand in one row or column [m]; a grid with more empty than full panels is no picture.
_SAME = 1e-3
#: Columns of pads whose places are not known.
_ABREAST = 4


@dataclass(frozen=True)
class PadLayout:
    """Panels of the pads.

    Attributes:
        pads: in the order of the rig, or of their names.
        panels: pad -> (row, column), from the top left.
        titles: pad -> what its panel is called.
        rows: of the grid.
        columns: of the grid.
    """

    pads: tuple[str, ...]
    panels: Mapping[str, tuple[int, int]]
    titles: Mapping[str, str]
    rows: int
    columns: int

    @property
    def colours(self) -> dict[str, str]:
        """Pad -> colour."""
        return {pad: pad_colour(pad) for pad in self.pads}


def layout_of(record: Record, geometry: RigGeometry | None = None) -> PadLayout:
    """Lay out the pads of a rig; those of the record, by the convention of their names, where no rig is given."""
    if geometry is not None:
        return layout_from_places(geometry.pads, geometry.pad_places)
    return layout_by_names(pads_in(record.channels) or PADS)


def layout_by_names(pads: Sequence[str]) -> PadLayout:
    """Lay out pads by their names: A to D at the corners of the reference rig, others in rows."""
    if set(pads) <= set(PADS):
        # A single one of the four stands where the four would.
        titles = {pad: f"Pad {pad}  ({PAD_PLACES[pad]})" for pad in PADS}
        return PadLayout(PADS, PAD_PANELS, titles, 2, 2)
    return _in_rows(tuple(pads), {pad: f"Pad {pad}" for pad in pads})


def layout_from_places(pads: Sequence[str], places: Sequence[tuple[float, float]]) -> PadLayout:
    """Lay out pads as they stand, seen from above: x to the right, y up."""
    if len(pads) == 1:
        return PadLayout(tuple(pads), {pads[0]: (0, 0)}, {pads[0]: f"Pad {pads[0]}"}, 1, 1)
    at = np.array(places)
    across, along = (_steps(at[:, axis]) for axis in (1, 0))
    panels = {pad: (max(across) - row, column) for pad, row, column in zip(pads, across, along, strict=True)}
    corners = len(pads) == 4 and max(across) == max(along) == 1
    words = _corner if corners else _metres
    titles = {pad: f"Pad {pad}  ({words(*place)})" for pad, place in zip(pads, at - at.mean(axis=0), strict=True)}
    rows, columns = max(across) + 1, max(along) + 1
    if len(set(panels.values())) < len(pads) or rows * columns > 2 * len(pads) or columns > _ABREAST + 2:
        return _in_rows(tuple(pads), titles)
    return PadLayout(tuple(pads), panels, titles, rows, columns)


def _in_rows(pads: tuple[str, ...], titles: Mapping[str, str]) -> PadLayout:
    columns = min(_ABREAST, len(pads))
    panels = {pad: divmod(i, columns) for i, pad in enumerate(pads)}
    return PadLayout(pads, panels, titles, -(-len(pads) // columns), columns)


def _steps(values: np.ndarray) -> list[int]:
    """Number equal places from the smallest on."""
    found = sorted({round(float(value) / _SAME) for value in values})
    return [found.index(round(float(value) / _SAME)) for value in values]


def _corner(x: float, y: float) -> str:
    return f"{'+' if x > 0 else '−'}x {'+' if y > 0 else '−'}y"


def _metres(x: float, y: float) -> str:
    return ", ".join(
        f"{axis} {value:+.3g} m" if value else f"{axis} 0 m" for axis, value in (("x", x), ("y", y))
    ).replace("-", "−")
