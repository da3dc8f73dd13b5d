"""How the paper is read where it is silent or ambiguous: every choice a setting with a stated default.

Source: the paper's text; its figures and Table 1 give nothing more here. Each field names the alternatives.
"""

from dataclasses import dataclass

from slipwise.errors import SettingError, unknown_name
from slipwise.rig.load import load_specimen
from slipwise.rig.similarity import LENGTH_SCALE
from slipwise.rig.specimen import Specimen
from slipwise.short_repr import short_repr

#: Plan of the girder model, across and along it [m]. Source: paper, Summary, "a 5 x 3 m girder model".
PLAN = (5.0, 3.0)
#: h/b. Source: paper, Prototype bridges.
SLENDERNESS = {"bridge1": 0.122, "bridge2": 0.244}
#: Stiffness of the rubber buffer in the prototype [N/m]. Source: paper, Rubber buffer: @18.5 and 13.7 kN/mm.
PROTOTYPE_STIFFNESS = {"bridge1": 18.5e6, "bridge2": 13.7e6}


@short_repr
@dataclass(frozen=True)
class Readings:
    """One reading of the paper.

    Attributes:
        shake_axis: "width": the table shakes along the girder's 3 m; "length": along its 5 m.
        b_means: what b of h/b is: "pad_spacing" in the shaking direction, or the girder's "width" of 3 m.
        pad_spacing_x: distance of the pads in the shaking direction [m]; None: the plan's side along it.
        pad_spacing_y: distance of the pads across [m]; None: the plan's other side.
        centre_offset: what is added to h if it is not counted from the sliding plane [m].
        stiffness_means: "each" of the two buffers has the paper's stiffness ("@"), or it is their "total".
        stiffness_of: "prototype" (divided by the scale factor) or "model".
        buffer_height: of the buffers' force above the sliding plane [m].
        pads_on: the side that carries the pads and their cells: "table" or "girder".
        stick_capacity: "slow": a pad sticks up to alpha N; "full": up to its friction at high speed.
    """

    shake_axis: str = "width"
    b_means: str = "pad_spacing"
    pad_spacing_x: float | None = None
    pad_spacing_y: float | None = None
    centre_offset: float = 0.0
    stiffness_means: str = "each"
    stiffness_of: str = "prototype"
    buffer_height: float = 0.0
    pads_on: str = "table"
    stick_capacity: str = "slow"

    def __post_init__(self) -> None:
        """Refuse words that are no reading."""
        choices = {
            "shake_axis": ("width", "length"),
            "b_means": ("pad_spacing", "width"),
            "stiffness_means": ("each", "total"),
            "stiffness_of": ("prototype", "model"),
        }
        for name, possible in choices.items():
            if getattr(self, name) not in possible:
                raise unknown_name(name.replace("_", " "), getattr(self, name), possible)


def read_paper(rig: str, readings: Readings | None = None) -> Specimen:
    """Return a bridge's specimen under a reading of the paper; the default reading is what the MJCF files hold.

    Args:
        rig: "bridge1" or "bridge2".
        readings: the choices; the defaults when not given.

    Raises:
        SettingError: the rig is not one of the paper's.
    """
    chosen = readings or Readings()
    if rig not in SLENDERNESS:
        raise SettingError(f"the paper has no rig {rig!r}; possible: {', '.join(SLENDERNESS)}")
    specimen = load_specimen(rig)
    across, along = PLAN if chosen.shake_axis == "width" else PLAN[::-1]
    spacing_x = along if chosen.pad_spacing_x is None else chosen.pad_spacing_x
    spacing_y = across if chosen.pad_spacing_y is None else chosen.pad_spacing_y
    height = SLENDERNESS[rig] * (spacing_x if chosen.b_means == "pad_spacing" else min(PLAN))
    stiffness = PROTOTYPE_STIFFNESS[rig] / (LENGTH_SCALE[rig] if chosen.stiffness_of == "prototype" else 1.0)
    each = stiffness if chosen.stiffness_means == "each" else stiffness / len(specimen.buffer_stiffness)
    signs = [(1.0 if x > 0 else -1.0, 1.0 if y > 0 else -1.0) for x, y in specimen.pad_places]
    return specimen.changed(
        centre_height=height + chosen.centre_offset,
        pad_places=tuple((sx * spacing_x / 2, sy * spacing_y / 2) for sx, sy in signs),
        buffer_stiffness=(each,) * len(specimen.buffer_stiffness),
        buffer_height=chosen.buffer_height,
        pads_on=chosen.pads_on,
        stick_capacity=chosen.stick_capacity,
    )
