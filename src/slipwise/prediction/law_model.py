"""A law that was read back, as a model of the catalogue's effects: what the fit and the diagnosis start from."""

from collections.abc import Mapping
from dataclasses import replace

from slipwise.effects import Effect, base_effects
from slipwise.model import EffectUse, Model
from slipwise.params import Parameter
from slipwise.prediction.friction_families import ReadLaw
from slipwise.rig import Specimen

#: Saturation of the contact area at which friction no longer follows the load [1/Pa].
_SATURATED = 1e-4
#: What is held is free by this share [1].
_HELD = 1e-3


def model_of_law(law: ReadLaw, specimen: Specimen, rest: float) -> Model:
    """Return a model that has a law that was read back.

    Args:
        law: fitted to the output.
        specimen: of the campaign.
        rest: load of a pad at rest, mean of all [N].
    """
    numbers, hard = law.numbers, specimen.plastic_pressure
    pressure = rest / specimen.pad_area
    match law.family.name:
        case "coulomb":
            return Model(specimen.changed(shear_strength=numbers["coefficient"] * hard), ())
        case "coulomb at constant load":
            strong = specimen.changed(shear_strength=numbers["coefficient"] * pressure)
            return Model(strong, (_use("area", {"saturation": _SATURATED}, {"saturation"}),))
        case "speed":
            values = {"strength": numbers["added"] * hard, "rate": numbers["rate"], "slow": numbers["slow"]}
            return Model(specimen, (_use("shear", values),))
        case "speed at constant load":
            # what friction has at no speed goes with the strength: a part that no load changes cannot stand by itself
            strength = (numbers["added"] + numbers["slow"]) * pressure
            uses = (
                _use("area", {"saturation": _SATURATED}, {"saturation"}),
                _use("shear", {"strength": strength, "rate": numbers["rate"], "slow": 0.0}, {"slow"}),
            )
            return Model(specimen, uses)
        case _:
            uses = (
                _use("area", {"saturation": numbers["saturation"]}),
                _use("shear", {name: numbers[name] for name in ("strength", "rate", "slow")}),
            )
            return Model(specimen, uses)


def _use(port: str, values: Mapping[str, float], held: set[str] | frozenset[str] = frozenset()) -> EffectUse:
    """Return a use of the paper's law at a port, whose bounds hold the values, and hardly more than what is held."""
    effect = next(effect for effect in base_effects("law") if effect.port == port)
    parameters = tuple(
        _held(p, values[p.name]) if p.name in held else _holding(p, values[p.name]) for p in effect.parameters
    )
    known: Effect = replace(effect, parameters=parameters)
    return EffectUse(known, values)


def _held(p: Parameter, value: float) -> Parameter:
    reach = _HELD * (abs(value) or abs(p.typical))
    return replace(p, typical=value, low=max(value - reach, 0.0), high=value + reach)


def _holding(p: Parameter, value: float) -> Parameter:
    return replace(p, low=min(p.low, value), high=max(p.high, value))
