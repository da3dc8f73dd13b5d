"""A model: a specimen, the effects that act on it in order, and the values of their parameters."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.channels import check_pattern, part_of
from slipwise.display import Tabular
from slipwise.effects import FRICTION_PORTS, PORTS, Effect, base_effects, catalogue, find_effect
from slipwise.errors import SettingError, unknown_name
from slipwise.model.unused_values import refuse_stated, unused_values
from slipwise.params import Parameter
from slipwise.rig import Specimen, load_specimen

#: Fraction of critical damping of bearings of which nothing is said [1]: low-damping rubber, assumed.
_USUAL_DAMPING = 0.05


@dataclass(frozen=True, repr=False)
class EffectUse(Tabular):
    """One effect in a model.

    Attributes:
        effect: which.
        values: parameter -> value [SI].
        target: the channel it acts on, or channels ("pad_*_N", "all"), for effects that need one; the load of the pad
            on which it sits alone, for effects that may.
        own: pad -> parameter -> value [SI], where a pad has another than all pads.
        held: parameters that no fit changes: the exponent of a dashpot that is to stay linear.
    """

    effect: Effect
    values: Mapping[str, float]
    target: str = ""
    own: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    held: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        """Refuse unknown parameters, values out of bounds, and a target where none belongs."""
        for name, value in self.values.items():
            self.effect.parameter(name).check(value, self.effect.name)
        missing = [n for n in self.effect.parameter_names if n not in self.values]
        if missing:
            raise SettingError(f"{self.effect.name} lacks a value for {', '.join(missing)}")
        if self.effect.target and not self.target:
            raise SettingError(
                f"{self.effect.name} must be told which {self.effect.target} it acts on, "
                "e.g. target = 'pad_A_N', 'pad_*_N' or 'all'"
            )
        if self.target and self.effect.single and part_of(self.target)[0] != "pad":
            raise SettingError(
                f"{self.effect.name} sits on all pads together, or on the one whose load is its target, e.g. target = "
                f"'pad_A_N'; {self.target!r} was given"
            )
        if self.target and not (self.effect.target or self.effect.single):
            raise SettingError(f"{self.effect.name} acts everywhere; it takes no target ({self.target!r} was given)")
        if self.target:
            check_pattern(self.target)
        if self.own and not self.effect.differs_by_pad:
            raise SettingError(
                f"{self.effect.name} acts on more than single pads, so {_pads(self.own)} can have no value of "
                f"{'their' if len(self.own) > 1 else 'its'} own; laws of friction at a pad can: "
                f"{', '.join(e.name for e in catalogue().values() if e.differs_by_pad)}"
            )
        for pad, own in self.own.items():
            for name, value in own.items():
                self.effect.parameter(name).of_pad(pad).check(value, self.effect.name)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Its parameters, then those that pads have of their own: strength, rate, strength[A]."""
        own = (self.effect.parameter(name).of_pad(pad) for pad, values in self.own.items() for name in values)
        return (*self.effect.parameters, *own)

    @property
    def numbers(self) -> dict[str, float]:
        """The values of `parameters` [SI]."""
        return {**self.values, **{f"{n}[{pad}]": v for pad, own in self.own.items() for n, v in own.items()}}

    def of_pad(self, pad: str) -> dict[str, float]:
        """Return the values that hold at a pad, parameter -> value [SI]."""
        return {**self.values, **self.own.get(pad, {})}

    def unused(self, pads: Sequence[str]) -> dict[str, float]:
        """Return the values for all pads that no fit finds: held ones, and those of which each pad has its own."""
        return {
            n: v
            for n, v in self.values.items()
            if n in self.held or self.effect.parameter(n).by_pad or all(n in self.own.get(pad, {}) for pad in pads)
        }

    @property
    def is_neutral(self) -> bool:
        """Whether every parameter that could switch it on has its neutral value."""
        switches = [p for p in self.effect.parameters if p.neutral is not None]
        given = [self.values, *(self.of_pad(pad) for pad in self.own)]
        return bool(switches) and all(values[p.name] == p.neutral for p in switches for values in given)

    @property
    def label(self) -> str:
        """Name with target, e.g. "channel_gain[pad_A_N]"."""
        return f"{self.effect.name}[{self.target}]" if self.target else self.effect.name

    def _headline(self) -> str:
        values = (f"{p.name} = {self.numbers[p.name]:.4g} {p.unit}".removesuffix(" 1") for p in self.parameters)
        return f"{self.label}({', '.join(values)})"

    def _rows(self) -> list[dict[str, Any]]:
        return [{"effect": self.label, **p.row(), "value": self.numbers[p.name]} for p in self.parameters]


def _pads(names: Iterable[str]) -> str:
    return " and ".join(f"pad {name}" for name in names)


def use(effect: Effect | str, target: str = "", **values: float | str) -> EffectUse:
    """Make an effect ready for a model; parameters that are not given take their typical values.

    Args:
        effect: itself, its name, or the path of a user's file ("./mine.py").
        target: the channel, for effects that need one.
        values: parameter -> number [SI], or text with a unit ("5 %", "2 mm"); what a pad has of its own is given
            as `**{"strength[A]": "1.2 MPa"}`.

    Raises:
        UnknownNameError: no such effect or parameter.
        UnitError: a unit of the wrong dimension, or none.
        SettingError: a value out of bounds, or something else than an effect.
    """
    found = find_effect(effect) if isinstance(effect, str) else effect
    if not isinstance(found, Effect):
        raise SettingError(f"an effect is a name, the path of a file or an Effect; got {type(found).__name__}")
    return use_of(found, {**found.typical(), **_read(found, values)}, target)


def use_of(effect: Effect, numbers: Mapping[str, float], target: str = "") -> EffectUse:
    """Make a use of an effect from its numbers, those of single pads among them: strength, strength[A] [SI].

    Raises:
        UnknownNameError: no such parameter.
        SettingError: a value is missing or out of bounds, or the effect has none of single pads.
    """
    own: dict[str, dict[str, float]] = {}
    for name, value in numbers.items():
        plain, bracket, pad = name.partition("[")
        if bracket:
            own.setdefault(pad.removesuffix("]"), {})[plain] = value
    return EffectUse(effect, {n: v for n, v in numbers.items() if "[" not in n}, target, own)


def _read(effect: Effect, values: Mapping[str, float | str]) -> dict[str, float]:
    return {name: effect.parameter(name).read(value, effect.name) for name, value in values.items()}


@dataclass(frozen=True, repr=False)
class Model(Tabular):
    """A specimen with effects.

    Attributes:
        specimen: the rated rig; effects on port `rig` and `girder` change a copy of it.
        uses: the effects in the order in which they were listed; ports act in the order of `PORTS`.
    """

    specimen: Specimen
    uses: tuple[EffectUse, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what cannot act together: one effect twice on a target, two that say how friction turns round."""
        labels = [u.label for u in self.uses]
        for label in labels:
            if labels.count(label) > 1:
                raise SettingError(f"the model lists {label} twice")
        for use in self.uses:
            _check_parts(self.specimen, use)
        sticking = [u.label for u in self.uses if "stick" in u.effect.hooks]
        train = [u.label for u in self.uses if "stretch" in u.effect.hooks]
        if len(sticking) > 1 or (sticking and train):
            raise SettingError(
                f"only one effect can say how a pad sticks, and none beside a loading train; the model lists "
                f"{' and '.join([*sticking, *train])}"
            )

    def __contains__(self, name: str) -> bool:
        return any(u.effect.name == name for u in self.uses)

    def __getitem__(self, name: str) -> EffectUse:
        """Return the first use of an effect.

        Raises:
            SettingError: the model does not hold it.
        """
        for entry in self.uses:
            if name in (entry.effect.name, entry.label):
                return entry
        raise SettingError(
            f"the model has no effect {name!r}; it has: {', '.join(u.label for u in self.uses) or 'none'}"
        )

    @property
    def reverses(self) -> bool:
        """Whether an effect says over which slip friction turns round after a reversal."""
        return any(u.effect.reverses for u in self.uses)

    def on_port(self, *ports: str) -> tuple[EffectUse, ...]:
        """Return the effects on these ports: by port; then what replaces, what adds, what scales; then as listed.

        Listed behind others a law that replaces would wipe out what they did, and one that adds would escape them.

        Args:
            *ports: of `PORTS`.
        """
        chosen = [u for port in PORTS if port in ports for u in self.uses if u.effect.port == port]

        def place(use: EffectUse) -> tuple[int, bool, bool]:
            return list(PORTS).index(use.effect.port), not use.effect.replaces, not use.effect.adds

        return tuple(sorted(chosen, key=place))

    def with_hook(self, hook: str) -> tuple[EffectUse, ...]:
        """Return the effects that have a hook, in the order of `on_port`.

        Args:
            hook: of `HOOKS`.
        """
        return tuple(u for u in self.on_port(*PORTS) if hook in u.effect.hooks)

    def adding(self, *uses: EffectUse) -> "Model":
        """Return a model with more effects.

        Args:
            *uses: effects with their values, as `use` gives them.
        """
        return replace(self, uses=(*self.uses, *uses))

    def without(self, *names: str) -> "Model":
        """Return a model without these effects (names or labels).

        Args:
            *names: of effects, or labels (channel_gain[pad_A_N]).

        Raises:
            SettingError: the model does not hold one of them.
        """
        gone = {self[name].label for name in names}
        return replace(self, uses=tuple(u for u in self.uses if u.label not in gone))

    def setting(self, name: str, **values: float | str) -> "Model":
        """Return a model with other parameter values of one effect, as `use` takes them.

        Args:
            name: of the effect.
            **values: by parameter: a number in SI, or a text with a unit ("20 mm").
        """
        old = self[name]
        new = replace(use_of(old.effect, {**old.numbers, **_read(old.effect, values)}, old.target), held=old.held)
        return replace(self, uses=tuple(new if u is old else u for u in self.uses))

    @property
    def unused_values(self) -> dict[str, str]:
        """Return the values of the specimen that the model does not use, name -> why."""
        return unused_values(self.built_specimen(), {u.label: u.effect for u in self.uses})

    def built_specimen(self) -> Specimen:
        """Return the specimen as the effects on ports `rig` and `girder` leave it."""
        specimen = self.specimen
        for entry in self.with_hook("rig"):
            specimen = entry.effect.hooks["rig"](specimen, target=entry.target, **entry.values)
        return specimen

    def _headline(self) -> str:
        return f"{self.specimen.name} with {', '.join(u.label for u in self.uses) or 'no effect'}"

    def _rows(self) -> list[dict[str, Any]]:
        return [row for entry in self.uses for row in entry._rows()]


def _check_parts(specimen: Specimen, use: EffectUse) -> None:
    """Refuse an effect that names a pad or a buffer which the specimen has not, and friction of what does not slide."""
    if not specimen.slides and use.effect.port in FRICTION_PORTS:
        raise SettingError(
            f'{use.label} is friction of the pads, and those of {specimen.name} do not slide (friction = "none"); '
            "leave it out, or give the specimen pads that slide"
        )
    part, name = part_of(use.target)
    names = {"pad": specimen.pads, "buffer": tuple(buffer.name for buffer in specimen.buffers)}
    if part and name not in names[part]:
        raise unknown_name(f"{part} of {specimen.name}", name, names[part], f"{use.label} names it.")
    for pad in use.own:
        if pad not in specimen.pads:
            raise unknown_name(f"pad of {specimen.name}", pad, specimen.pads, f"{use.label} names it.")


def base_model(rig: str | Path | Specimen, effects: Sequence[str | Effect | EffectUse] | None = None) -> Model:
    """Make a model of a rig with the paper's law, or with damped springs where its pads do not slide.

    Args:
        rig: a name, the path of an MJCF file or of a specimen.toml, or a specimen.
        effects: names or effects (typical values) or uses; when not given the paper's law, eqs. (7) and (8), or linear
            damping of the buffers where the specimen says that its pads do not slide.

    Raises:
        SettingError: effects that cannot go together, or a stated value of the specimen that the model does not use.
    """
    specimen = rig if isinstance(rig, Specimen) else load_specimen(rig)
    usual = base_effects("law") if specimen.slides else (_linear_damping(specimen),)
    chosen = usual if effects is None else effects
    model = Model(specimen, tuple(e if isinstance(e, EffectUse) else use(e) for e in chosen))
    refuse_stated(model.specimen, model.unused_values)
    return model


def _linear_damping(specimen: Specimen) -> EffectUse:
    """Return dashpots at the buffers with a usual fraction of critical damping; no fit makes them less linear."""
    damping = find_effect("buffer_damping").parameter("damping")
    critical = 2.0 * np.sqrt(sum(specimen.buffer_stiffness) * specimen.carried_mass)
    each = float(np.clip(_USUAL_DAMPING * critical / len(specimen.buffers), damping.low, damping.high))
    return replace(use("buffer_damping", damping=each), held=("exponent", "relaxation"))
