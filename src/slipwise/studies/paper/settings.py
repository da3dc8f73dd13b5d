"""What had to be assumed to re-enact the paper: every assumption a setting with its default, its rivals and its reason.

The paper's text does not give its figures, Table 1, the input motions, the piers, or the units of two parameters. None
of the defaults below is the paper's unless its source says so.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field, fields, replace

from slipwise.errors import SettingError, unknown_name
from slipwise.model import Model, base_model
from slipwise.rig import Readings, read_paper
from slipwise.short_repr import short_repr
from slipwise.simulation.pier import BridgeSettings, Pier
from slipwise.units import quantity

#: Unit of n -> factor to s/m.
RATE_UNITS = {"s/cm": 100.0, "s/mm": 1000.0, "s/in": 1.0 / 0.0254}
#: n as printed. Source: paper, below eq. (8).
RATE_PRINTED = 0.197


@dataclass(frozen=True)
class Setting:
    """One assumption.

    Attributes:
        name: as in `--readings NAME=VALUE`.
        unit: SI unit of a number; "1" for a pure one, "" for a word.
        shown_in: unit in which it is printed.
        about: what it decides.
        why: why this default, and what else the text allows.
    """

    name: str
    unit: str
    shown_in: str
    about: str
    why: str


SETTINGS: tuple[Setting, ...] = (
    Setting("shake_axis", "", "", "side of the 5 x 3 m girder along which it is shaken", "width; length is possible"),
    Setting("b_means", "", "", "b of h/b", "pad_spacing; the girder's width is possible"),
    Setting("pad_spacing_x", "m", "m", "pad spacing, shaken way", "the girder's plan; they may stand closer"),
    Setting("pad_spacing_y", "m", "m", "pad spacing across", "the girder's plan; the pads may stand closer"),
    Setting("centre_offset", "m", "m", "added to h", "h counts from the sliding plane"),
    Setting("stiffness_means", "", "", "what has the stated buffer stiffness", "each ('@'); total is possible"),
    Setting("stiffness_of", "", "", "prototype or model", "prototype: a model that stiff would hardly slide"),
    Setting("buffer_height", "m", "m", "height of the buffers' force", "0: trapezoids need it well below h"),
    Setting("pads_on", "", "", "side that carries pads and cells", "table: the weight moves over the pads"),
    Setting("stick_capacity", "", "", "what a pad can hold at rest", "slow: alpha N, eq. (7) at V = 0; or full"),
    Setting("n_unit", "", "", "unit of n = 0.197", "s/cm: energies are in kN cm; s/mm and s/in are possible"),
    Setting("peak_low", "m/s^2", "g", "smallest peak of the motions", "0.6 to 0.8 g reach the paper's energies"),
    Setting("peak_high", "m/s^2", "g", "largest peak of the motions", "0.6 to 0.8 g reach the paper's energies"),
    Setting("frequency_low", "Hz", "Hz", "lowest predominant frequency", "3 to 5 Hz is 0.65 to 1.1 s of a pier"),
    Setting("frequency_high", "Hz", "Hz", "highest predominant frequency", "3 to 5 Hz is 0.65 to 1.1 s of a pier"),
    Setting("strong_low", "s", "s", "shortest strong part", "3 to 5 s is 10 to 16 s of an earthquake"),
    Setting("strong_high", "s", "s", "longest strong part", "3 to 5 s is 10 to 16 s of an earthquake"),
    Setting("vertical_share", "1", "1", "vertical peak over horizontal peak", "0.4: Kobe's 332 over 818 gal"),
    Setting("pier_stiffness", "N/m", "kN/mm", "of a pier", "4.6 Hz alone, 2.1 Hz with all that it carries"),
    Setting("pier_mass", "kg", "t", "that moves with a pier's top", "a quarter of what it carries"),
    Setting("pier_damping", "1", "1", "of a pier, of critical", "concrete under strong motion"),
    Setting("pier_vertical_frequency", "Hz", "Hz", "of pier and superstructure, vertically", "axially stiff piers"),
    Setting("noise_load", "1", "1", "rms noise of the load cells, of the load at rest", "a good laboratory's"),
    Setting("noise_friction", "1", "1", "rms noise of the friction cells, of friction at rest", "a good laboratory's"),
    Setting("noise_speed", "m/s", "mm/s", "rms noise of the fused speed", "a slip gauge fused with accelerometers"),
    Setting("seating_share", "1", "1", "load of pad C in sine tests", "25 to 5 MPa has mean 15, not 16.9"),
)  # fmt: skip
_BY_NAME = {s.name: s for s in SETTINGS}
_READINGS = tuple(f.name for f in fields(Readings))


@short_repr
@dataclass(frozen=True)
class PaperSettings:
    """Everything that the study depends on besides the paper; `SETTINGS` says what each is and why.

    Attributes that are not in `SETTINGS`:
        readings: how the specimen is read.
        members: motions of the big ensemble, each with and without vertical part.
        seed: of the ensemble and of the noise.
        ground: ground motion for the bridge model, in the prototype's time.
    """

    readings: Readings = field(default_factory=Readings)
    n_unit: str = "s/cm"
    peak_low: float = 0.6 * 9.80665
    peak_high: float = 0.8 * 9.80665
    frequency_low: float = 3.0
    frequency_high: float = 5.0
    strong_low: float = 3.0
    strong_high: float = 5.0
    vertical_share: float = 0.4
    pier_stiffness: float = Pier.stiffness
    pier_mass: float = Pier.mass
    pier_damping: float = Pier.damping
    pier_vertical_frequency: float = 20.0
    noise_load: float = 0.005
    noise_friction: float = 0.02
    noise_speed: float = 0.5e-3
    seating_share: float = 0.89
    members: int = 200
    seed: int = 1
    ground: str = "quake:seed=1,peak=0.4g,f=1.2Hz,strong=13s,vertical=0.16g,2.4Hz"

    def __post_init__(self) -> None:
        """Refuse settings that cannot be."""
        if self.n_unit not in RATE_UNITS:
            raise unknown_name("unit of n", self.n_unit, RATE_UNITS)
        for name in ("peak", "frequency", "strong"):
            low, high = getattr(self, f"{name}_low"), getattr(self, f"{name}_high")
            if not 0.0 < low <= high:
                raise SettingError(f"{name}_low = {low:g} and {name}_high = {high:g}: 0 < low <= high is needed")
        if self.strong_low * self.frequency_low < 4.0:
            raise SettingError(
                f"strong_low = {self.strong_low:g} s is too short for frequency_low = {self.frequency_low:g} Hz: an "
                "earthquake needs 4 cycles at least"
            )
        if self.members < 2:
            raise SettingError(f"an ensemble of {self.members} says nothing; give at least 2 motions")
        for name in ("noise_load", "noise_friction", "noise_speed", "vertical_share"):
            if getattr(self, name) < 0.0:
                raise SettingError(f"{name} = {getattr(self, name):g} must not be negative")
        if not 0.5 <= self.seating_share <= 1.0:
            raise SettingError(f"seating_share = {self.seating_share:g}: between 0.5 and 1")

    def value(self, name: str) -> float | str | None:
        """Return the value of one setting of `SETTINGS` [SI]."""
        return getattr(self.readings if name in _READINGS else self, name)

    def bridge(self, *, similar_law: bool = False) -> BridgeSettings:
        """Return the bridge model."""
        pier = Pier(self.pier_stiffness, self.pier_mass, self.pier_damping)
        return BridgeSettings((pier,), 0, self.pier_vertical_frequency, similar_law=similar_law)


def change(settings: PaperSettings, assignments: Iterable[str]) -> PaperSettings:
    """Change assumptions written as "NAME=VALUE", numbers with their unit.

    Raises:
        SettingError: not of that form, or values that cannot go together.
        UnknownNameError: no such setting.
        UnitError: a unit is missing or of the wrong dimension.
    """
    for text in assignments:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not equals or not value:
            raise SettingError(f"{text!r}: write NAME=VALUE, for example buffer_height='0.4 m' or n_unit=s/mm")
        if name not in _BY_NAME:
            raise unknown_name("reading", name, _BY_NAME, "`slipwise paper --help` shows an example.")
        unit = _BY_NAME[name].unit
        new = quantity(value, unit, name) if unit else value
        if name in _READINGS:
            settings = replace(settings, readings=replace(settings.readings, **{name: new}))
        else:
            settings = replace(settings, **{name: new})
    for rig in ("bridge1", "bridge2"):
        read_paper(rig, settings.readings)
    return settings


def paper_model(bridge: str, settings: PaperSettings) -> Model:
    """Return the paper's specimen with its law, under these settings."""
    rate = RATE_PRINTED * RATE_UNITS[settings.n_unit]
    return base_model(read_paper(bridge, settings.readings)).setting("shear_rate", rate=rate)
