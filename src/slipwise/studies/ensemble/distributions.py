"""What differs from member to member: numbers of the rig and of effects, drawn between two ends or from an interval."""

import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import norm, qmc

from slipwise.arrays import Array
from slipwise.errors import SettingError, unknown_name
from slipwise.model import Model
from slipwise.rig.known import SPECIMEN_UNITS, better_known
from slipwise.short_repr import short_repr
from slipwise.units import quantity

SAMPLINGS = ("sobol", "latin")
#: Half the width of a 95 % interval, and how far from its value a number is drawn, in standard deviations.
_REACH, _FARTHEST = float(norm.ppf(0.975)), 3.0
#: "9..11t", "9 t..11 t", "-2..2 %": two ends, the first of which may leave its unit to the second.
_RANGE = re.compile(r"\s*(?P<low>[-+\d.eE]*\d\.?)\s*(?P<low_unit>[^\d.+-][^.]*)?\.\.\s*(?P<high>[-+.\d].*)")
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


@short_repr
@dataclass(frozen=True)
class Varied:
    """One number that is drawn.

    Attributes:
        key: "rig.mass", "heating.share", "channel_gain[pad_A_N].gain" ...
        low: lower end [unit].
        high: upper end [unit].
        unit: SI unit.
        whole: whether only whole numbers make sense.
        value: None for a number that is uniform between its ends; else the ends are those of a 95 % interval about it,
            and each side of it is half of a normal distribution.
        bounds: what no draw passes.
    """

    key: str
    low: float
    high: float
    unit: str
    whole: bool = False
    value: float | None = None
    bounds: tuple[float, float] = (-np.inf, np.inf)


def read_varied(text: str, model: Model) -> Varied:
    """Read "KEY=LOW..HIGH[unit]".

    Args:
        text: e.g. "rig.mass=9..11t"; KEY is `rig.` and a name of campaign.toml's [specimen], or an effect of the model
            and its parameter, "shear_rate.rate".
        model: that is shaken; it must bear both ends.

    Raises:
        SettingError: it cannot be read, the ends are not in order, or the model cannot have them.
        UnknownNameError: no such number.
        UnitError: no unit, or one of the wrong dimension.
    """
    key, equals, span = text.partition("=")
    key = key.strip()
    found = _RANGE.fullmatch(span)
    if not equals or found is None:
        raise SettingError(f"--vary {text!r}: write KEY=LOW..HIGH with a unit, for example rig.mass=9..11t")
    unit, whole = _unit(key, model)
    number = _NUMBER.match(found["high"])
    shown = found["high"][number.end() :].strip() if number else ""
    what = f"--vary {key}"
    low = quantity(f"{found['low']} {(found['low_unit'] or shown).strip()}".strip(), unit, what)
    high = quantity(found["high"], unit, what)
    if not low < high:
        raise SettingError(f"{what}: {span!r} goes from {low:g} to {high:g} {unit}; give the lower end first")
    varied = Varied(key, low, high, unit, whole)
    for end in (low, high):
        with_values(model, {key: end})
    return varied


def with_values(model: Model, values: Mapping[str, float]) -> Model:
    """Return a model with other numbers.

    Args:
        model: as it was.
        values: key -> value [SI]; `rig.buffer_stiffness` is that of each buffer.

    Raises:
        SettingError: a value that rig or effect cannot have.
    """
    of_rig: dict[str, float | str] = {}
    for key, value in values.items():
        owner, _, name = key.rpartition(".")
        if owner == "rig":
            of_rig[name] = value
        else:
            model = model.setting(owner, **{name: value})
    return replace(model, specimen=better_known(model.specimen, of_rig, "drawn")) if of_rig else model


def draw(varied: Sequence[Varied], count: int, sampling: str, seed: int) -> Array:
    """Draw values, independent of each other.

    Args:
        varied: what is drawn, at least one.
        count: of members.
        sampling: "sobol" (scrambled; even best where the count is a power of 2) or "latin" (hypercube).
        seed: the same one draws the same.

    Returns:
        (count, len(varied)) [SI].

    Raises:
        UnknownNameError: no such sampling.
    """
    check_sampling(sampling)
    generator = np.random.default_rng(seed)
    make = qmc.Sobol if sampling == "sobol" else qmc.LatinHypercube
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # a count that is no power of 2: said in the help
        # `seed` is called `rng` from scipy 1.15 on, which takes both; the oldest that we allow has `seed` only
        unit = make(len(varied), seed=generator).random(count)  # pyright: ignore[reportCallIssue]
    low, high = (np.array([getattr(v, end) for v in varied]) for end in ("low", "high"))
    values = low + unit * (high - low)
    for column, one in enumerate(varied):
        if one.value is not None:
            normal = np.clip(norm.ppf(unit[:, column]), -_FARTHEST, _FARTHEST) / _REACH
            side = np.where(normal < 0.0, one.value - one.low, one.high - one.value)
            values[:, column] = np.clip(one.value + normal * side, *one.bounds)
    whole = [v.whole for v in varied]
    values[:, whole] = np.round(values[:, whole])
    return values


def check_sampling(name: str) -> None:
    """Refuse a way of drawing that there is not.

    Raises:
        UnknownNameError: the message names those that there are.
    """
    if name not in SAMPLINGS:
        raise unknown_name("sampling", name, SAMPLINGS)


def _unit(key: str, model: Model) -> tuple[str, bool]:
    """Return the SI unit of a number, and whether it is a whole one.

    Raises:
        UnknownNameError: neither the rig nor an effect of the model has it.
    """
    owner, _, name = key.rpartition(".")
    if owner == "rig" and name in SPECIMEN_UNITS:
        return SPECIMEN_UNITS[name], False
    known = [f"rig.{n}" for n in SPECIMEN_UNITS]
    for entry in model.uses:
        if owner == entry.label and name in entry.numbers:
            parameter = entry.effect.parameter(name)
            return parameter.unit, parameter.whole
        known += [f"{entry.label}.{n}" for n in entry.numbers]
    raise unknown_name("number", key, known, "An effect's are there when it is in the model: --effect NAME.")
