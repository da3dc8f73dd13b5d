"""What a fit may change: numbers of the rig, and parameters of effects, each with a key, a start and bounds."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from slipwise.effects import Effect
from slipwise.model import EffectUse, Model, use_of
from slipwise.params import Parameter
from slipwise.rig import Specimen, pad_frequencies
from slipwise.rig.load_basis import is_uneven
from slipwise.rig.rocking import rolls
from slipwise.short_repr import short_repr

#: Largest delay between the cards of a logger that counts as none [s].
MAX_CARD_DELAY = 1.5e-4
#: The same of the friction channels where nothing is known of the logger's filters [s].
_MAX_CARD_DELAY_UNKNOWN = 4e-4
#: Stiffness of the pads over rated, as the loads at rest show it where pads are stated to stand at unlike heights.
SEAT_STIFFNESS = "rig.seat_stiffness"
#: Rated values of the rig may be off by these shares; a frequency and a slip per pitch load are not rated at all.
_RIG_SHARES: dict[str, tuple[float, float]] = {
    "rig.mass": (0.7, 1.4),
    "rig.buffer_stiffness": (0.4, 2.5),
    "rig.centre_height": (0.5, 2.0),
    SEAT_STIFFNESS: (0.4, 2.5),
}
#: What no rig is rated for: start, low, high, scale, unit. Pitch of the girder on its pads, over its rated frequency;
#: slip at the gauge for pitch load, as the height at which the girder's tilt for that load would show so [m]; time by
#: which channels of one card may lag behind those of another (more than that is a `channel_delay`).
_SMALL: dict[str, tuple[float, float, float, float, str]] = {
    "rig.pitch_frequency": (1.04, 0.39, 2.6, 0.26, "Hz"),
    "rig.pitch_damping": (0.05, 0.002, 0.6, 0.05, "1"),
    "rig.pitch_slip": (0.0, -3.6, 3.6, 0.36, "m/N"),
    "rig.late_girder": (0.0, -MAX_CARD_DELAY, MAX_CARD_DELAY, 5e-5, "s"),
    "rig.late_load": (0.0, -MAX_CARD_DELAY, MAX_CARD_DELAY, 5e-5, "s"),
    "rig.late_pitch": (0.0, -MAX_CARD_DELAY, MAX_CARD_DELAY, 5e-5, "s"),
    "rig.late_slip": (0.0, -MAX_CARD_DELAY, MAX_CARD_DELAY, 5e-5, "s"),
}
#: Those that only measured loads show.
_OF_LOADS = ("rig.pitch_frequency", "rig.pitch_damping", "rig.pitch_slip", "rig.late_load", "rig.late_pitch")
#: The lag of these channels is the number; an effect on them that has a `lag` takes its place.
_LAGS: dict[str, str] = {
    "rig.late_force": "pad_*_Fx",
    "rig.late_load": "pad_*_N",
    "rig.late_pitch": "pad_*_N",
    "rig.late_girder": "girder_ax",
    "rig.late_slip": "slip_x",
}
#: The zero of a slider's friction gauge.
ZERO = "rig.zero_force"
#: Axis, and the shares of the rated inertia between which it may be: 8 % more leave three floors in pads that yaw.
YAW_INERTIA, PITCH_INERTIA, ROLL_INERTIA = "rig.yaw_inertia", "rig.pitch_inertia", "rig.roll_inertia"
_INERTIAS: dict[str, tuple[int, tuple[float, float]]] = {
    YAW_INERTIA: (2, (0.6, 1.7)),
    PITCH_INERTIA: (1, (0.4, 3.0)),
    ROLL_INERTIA: (0, (0.4, 3.0)),
}
#: Slip over which a pad's friction reverses without any effect of its own [m]; longer than that it is `presliding`.
_STICK_LENGTH = (1e-6, 1e-8, 8e-6, 1e-6)
#: How that is damped [s], and the stick from which a damped one is looked for: one that reverses at once has no slopes.
_STICK_DAMPING, DAMPED_STICK = (0.0, 0.0, 0.02, 2e-4), {"rig.stick_length": 5e-6, "rig.stick_damping": 3e-3}
#: The friction channels' filter where the campaign does not know it [Hz].
_LOGGER = (100.0, 20.0, 240.0, 20.0)


@dataclass(frozen=True)
class Free:
    """One number that a fit may change.

    Attributes:
        key: "rig.mass", "heating.share", "channel_gain[pad_A_N].gain" ...
        start: where the fit begins [SI].
        low: lower bound.
        high: upper bound.
        scale: a change that matters.
        unit: SI unit.
    """

    key: str
    start: float
    low: float
    high: float
    scale: float
    unit: str


@short_repr
@dataclass(frozen=True)
class Term:
    """An effect that a hypothesis adds, with the channels on which it acts alike.

    Attributes:
        effect: which.
        targets: channels; ("",) for an effect that needs none.
        group: name for several targets together, e.g. "pad_*_Fx"; the target itself for one.
        own: what pads have of their own, e.g. "strength[A]".
        unused: values for all pads that no fit finds: held ones, and those of which each pad has its own [SI].
    """

    effect: Effect
    targets: tuple[str, ...] = ("",)
    group: str = ""
    own: tuple[str, ...] = ()
    unused: Mapping[str, float] = field(default_factory=dict[str, float])

    @property
    def label(self) -> str:
        """Name with the channels it acts on."""
        return f"{self.effect.name}[{self.group}]" if self.group else self.effect.name

    @property
    def parameters(self) -> dict[str, Parameter]:
        """Its parameters and those of single pads, by key: "shear_rate.strength", "shear_rate.strength[A]" ..."""
        names = (*(n for n in self.effect.parameter_names if n not in self.unused), *self.own)
        return {f"{self.label}.{n}": self.effect.parameter(n) for n in names}

    def uses(self, values: Mapping[str, float]) -> list[EffectUse]:
        """Return the uses for a model, with the values of a fit."""
        numbers = {**self.unused, **{p.name: values[key] for key, p in self.parameters.items()}}
        effect = self.effect.original or self.effect
        numbers = {**{n: v for n, v in effect.neutral().items() if n not in numbers}, **numbers}
        return [replace(use_of(effect, numbers, target), held=tuple(self.unused)) for target in self.targets]

    def free(self, start: Mapping[str, float]) -> list[Free]:
        """Return its parameters as free numbers.

        Args:
            start: parameter -> where its fit begins [SI].
        """
        out = []
        for p in self.effect.parameters:
            off = p.typical if p.neutral is None else p.neutral
            size = abs(p.typical - off) or abs(p.typical) or 0.1 * (p.high - p.low)
            out.append(Free(f"{self.label}.{p.name}", start[p.name], p.low, p.high, size, p.unit))
        return out


def make_terms(model: Model) -> tuple[Term, ...]:
    """Return the effects of a model as terms, those of several targets one by one."""
    pads = model.specimen.pads
    return tuple(
        Term(u.effect, (u.target,), u.target, tuple(n for n in u.numbers if n not in u.values), u.unused(pads))
        for u in model.uses
    )


def list_base_numbers(
    model: Model, *, balances: bool, forces: bool = True, loads: bool = True, logger_known: bool = True,
    length: float = 1.0,
) -> list[Free]:  # fmt: skip
    """Return the base parameters: those of the model's effects, and the rig's numbers where balances can see them.

    Of forces that follow from inertia alone only the ratio to the mass is known: the mass is as rated then.

    Args:
        model: the user's model.
        balances: whether the campaign has what the girder's balances need.
        forces: whether the pads' friction was measured.
        loads: whether the pads' loads were measured.
        logger_known: whether the campaign says what the logger did.
        length: scale of lengths [1].
    """
    out: list[Free] = []
    for entry in model.uses:
        unused = entry.unused(model.specimen.pads)
        for p in (p for p in entry.parameters if p.name not in unused):
            value = entry.numbers[p.name]
            scale = abs(value) or abs(p.typical) or 0.1 * (p.high - p.low)
            out.append(Free(f"{entry.label}.{p.name}", value, p.low, p.high, scale, p.unit))
    specimen = model.specimen
    if not model.reverses and specimen.slides:
        out.append(list_stick_numbers(length))
    if specimen.slides and "rig.shear_strength" not in list_replaced_numbers(u.effect for u in model.uses):
        out.append(_around("rig.shear_strength", specimen.shear_strength, 1e-3, 1e3, "Pa"))
    if balances:
        rated = {"rig.mass": specimen.mass, "rig.centre_height": specimen.centre_height}
        if specimen.buffer_stiffness:
            rated["rig.buffer_stiffness"] = sum(specimen.buffer_stiffness)
        units = {"rig.mass": "kg", "rig.centre_height": "m", "rig.buffer_stiffness": "N/m"}
        if not loads:
            rated = {
                key: value
                for key, value in rated.items()
                if key == "rig.buffer_stiffness" or (key == "rig.mass" and forces)
            }
        out += [_around(key, value, *_RIG_SHARES[key], units[key]) for key, value in rated.items()]
        out += [_small(key, specimen) for key in _SMALL if loads or key not in _OF_LOADS]
        out += [make_free_inertia(specimen, ROLL_INERTIA)] if loads and rolls(specimen) else []
        if loads and is_uneven(specimen):
            out.append(_around(SEAT_STIFFNESS, 1.0, *_RIG_SHARES[SEAT_STIFFNESS], "1"))
    elif specimen.free:  # the sliding plane moves against the gauge all the same
        out.append(_small("rig.pitch_slip", specimen))
    if specimen.free:
        card_delay = MAX_CARD_DELAY if logger_known else _MAX_CARD_DELAY_UNKNOWN
        if forces:
            out.append(Free("rig.late_force", 0.0, -card_delay, card_delay, 5e-5, "s"))
        if not logger_known and specimen.slides:
            out.append(Free("rig.logger", *_LOGGER, "Hz"))
    delayed = {entry.target for entry in model.uses if entry.effect.lag}
    return [f for f in out if f.key not in _LAGS or not _covered(_LAGS[f.key], delayed, specimen)]


def _small(key: str, specimen: Specimen) -> Free:
    """Return a number that no rig is rated for, in the size of this rig."""
    *numbers, unit = _SMALL[key]
    sizes = {
        "rig.pitch_frequency": pad_frequencies(specimen).get("pitch", 1.0),
        "rig.pitch_slip": specimen.half_spacing[0] / specimen.pitch_stiffness,
    }
    start, low, high, scale = (sizes.get(key, 1.0) * number for number in numbers)
    return Free(key, start, low, high, scale, unit)


def list_stick_numbers(length: float) -> Free:
    """Return the slip over which a pad's friction reverses, for a scale of lengths [1]."""
    start, low, high, scale = (length * x for x in _STICK_LENGTH)
    return Free("rig.stick_length", start, low, high, scale, "m")


def make_stick_damping(time: float) -> Free:
    """Return how that is damped, for a scale of times [1]."""
    start, low, high, scale = (time * x for x in _STICK_DAMPING)
    return Free("rig.stick_damping", start, low, high, scale, "s")


def _covered(channels: str, delayed: set[str], specimen: Specimen) -> bool:
    """Return whether a card lags by effects of its own: as one, or each of its channels."""
    return channels in delayed or {channels.replace("*", pad) for pad in specimen.pads} <= delayed


def list_replaced_numbers(effects: Iterable[Effect]) -> set[str]:
    """Return keys of the base fit's numbers in whose place effects come: beside one of them it is the same number."""
    return {key for effect in effects for key in effect.stands_for}


def make_free_inertia(specimen: Specimen, key: str) -> Free:
    """Return an inertia of the girder: free where the motion that it resists is made from what was measured."""
    axis, shares = _INERTIAS[key]
    return _around(key, specimen.inertia[axis], *shares, "kg*m^2")


def _around(key: str, value: float, low: float, high: float, unit: str) -> Free:
    return Free(key, value, low * value, high * value, 0.1 * value, unit)


#: Numbers of the rig that change its rated values.
RIG_NUMBERS: tuple[str, ...] = (
    "rig.mass", "rig.centre_height", "rig.shear_strength", "rig.buffer_stiffness", *_INERTIAS,
)  # fmt: skip


def build_fitted_specimen(
    specimen: Specimen, values: Mapping[str, float], numbers: Sequence[str] = RIG_NUMBERS
) -> Specimen:
    """Return the specimen with the numbers of a fit.

    Args:
        specimen: rated values.
        values: key -> value.
        numbers: of `RIG_NUMBERS`, those that take the place of rated values; the others stay rated.
    """
    fitted = {key: values[key] for key in numbers if key in values}
    if not fitted:
        return specimen
    changes: dict[str, object] = {
        key.removeprefix("rig."): fitted[key]
        for key in ("rig.mass", "rig.centre_height", "rig.shear_strength")
        if key in fitted
    }
    if "rig.buffer_stiffness" in fitted:
        share = fitted["rig.buffer_stiffness"] / sum(specimen.buffer_stiffness)
        changes["buffer_stiffness"] = tuple(share * k for k in specimen.buffer_stiffness)
    inertia = list(specimen.inertia)
    for key, (axis, _) in _INERTIAS.items():
        inertia[axis] = fitted.get(key, inertia[axis])
    changes["inertia"] = tuple(inertia)
    return specimen.changed(**changes)


def build_fitted_model(
    specimen: Specimen, terms: Iterable[Term], values: Mapping[str, float], numbers: Sequence[str] = RIG_NUMBERS
) -> Model:
    """Return the model that a fit's numbers describe; `numbers` as for `build_fitted_specimen`."""
    return Model(build_fitted_specimen(specimen, values, numbers), tuple(u for t in terms for u in t.uses(values)))
