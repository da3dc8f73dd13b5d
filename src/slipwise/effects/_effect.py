"""The contract that every effect keeps.

An effect is one file: a docstring with the equation, `Valid:` and `Source:`; one or more *hooks*, plain functions whose
names say what they change; and `EFFECT`, what a person and the fit need to know. A hook asks for what it needs by
the names of its arguments: quantities of `HOOKS`, `memory`, and its own parameters.

What most effects need. Hooks of one instant (plain scalars in, scalars out; compiled into the step and into the loops
over records, so only arithmetic, `math` and `memory[...]` may be used):

    shear(shear, ...) -> shear                 coefficient(coefficient, ...) -> coefficient of friction
    pad(...) -> (force_x, force_y)             advance(...) -> None, changes memory[...] after the force is known
    spring(force, ...) -> force (of a buffer)  drag(...) -> (force_x, force_y) on the girder

Hooks of whole arrays (numpy):

    rig(specimen, ...) -> Specimen             table(acceleration (n, 4), dt, ...) -> acceleration
    gauge(record, target, ...) -> Record       undo(record, target, ...) -> Record (its inverse, where `gauge` has one)
    rest(memory, seconds, ...) -> None         what a pause between runs leaves of the memory
    balance(states, ...) -> {"heave" | "pitch" | "roll" | "warp" | "warp_2" ...: (n,), "girder": (n,)} added to what is
                        predicted
    disturb(records, specimen) -> forms, each a list of free numbers: what each adds to the balances by which an audit
                        compares gauges, in every record; see `_disturbances`

Rare hooks, each of one or two effects of the catalogue; a new effect seldom needs one. Of one instant:

    area(real_area, ...) -> real_area          stick(bound, ...) -> (force_x, force_y)
    face(face) -> curvature of the sliding face [1/m], on which the girder rises and swings as a pendulum
    deflection(deflection, ...) -> deflection  stretch(force, ...) -> stretch of the loading train between gauge and
                                               contact, of one slider
    lift(force_x, force_y, ...) -> force_z (of all shear keys, which share it as they share the horizontal force)

Of whole arrays:

    sharpen(record, target, ...) -> Record (its inverse as far as noise bears it, where there is no exact one)
    begin(memory, share_x, share_y, bound, ...) -> None    what is remembered where a slider's record begins, by the
                                               share of the bound [1] that its force was then
    flat(coefficient, ...) -> {parameter: value}   at which a law over speed is a constant coefficient of friction
    corner(...) -> frequency [Hz]                  of a gauge's filter: it takes what is above

`EFFECT` declares in blocks what hooks cannot say: `ForDiagnosis`, `Gauges` for a fault of a gauge, and rarely `Rare`.
No other file knows an effect by its name, so that a user's own file has every right that a file of the catalogue has,
but for a role in the base model and faults that are found in samples.
"""

import fnmatch
import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from slipwise.channels import CHANNELS
from slipwise.display import Drawn, Tabular
from slipwise.effects._fields import COMPONENT_NEEDS, NEEDS, ForDiagnosis, Gauges, Rare
from slipwise.effects._flat_fields import BlockFields, takes_flat_fields, what_to_write
from slipwise.effects._hooks import DERIVED, HOOKS, PAD_HOOKS
from slipwise.errors import unknown_name
from slipwise.params import Parameter

#: Channels of girder, pads and buffers: what any change of the physics moves. The table follows its command.
RESPONSE: tuple[str, ...] = (
    "pad_*", "buffer_*", "girder_*", "slip_*", "yaw", "pitch", "roll", "heave",
)  # fmt: skip

#: The contract of this version. What an effect file of contract 1 says stays possible as long as this is 1.
CONTRACT = 1


@takes_flat_fields
@dataclass(frozen=True, repr=False)
class Effect(BlockFields, Drawn, Tabular):
    """What a person and the fit need to know of an effect, in blocks.

    A law gives port, parameters and `diagnosis`, perhaps `memory`; a fault of a gauge `gauges` as well; few need
    `rare`. The fields of the blocks are read from the effect itself: `effect.moves` is `effect.diagnosis.moves`.

    Attributes:
        port: where it acts, one of `PORTS`.
        parameters: with unit, bounds, typical and neutral value, source.
        diagnosis: what a diagnosis needs to know of it.
        memory: names of the numbers it remembers, per pad or per buffer and direction; they start at zero.
        contract: the contract that the file was written for, `CONTRACT` of that day; 0 where it does not say.
        gauges: what a fault of a gauge says.
        rare: what few effects say.
        name: the file's name; set when the file is read, as all below.
        summary: first line of the file's docstring.
        text: the whole docstring.
        hooks: the file's functions.
        path: the file.
        flat: names of what the file gives beside its blocks, as files before 0.2 do.
        original: for an effect with the parameters that a rig's pads can have, see `for_pads`: the one with all.
    """

    port: str
    parameters: tuple[Parameter, ...]
    diagnosis: ForDiagnosis
    memory: tuple[str, ...] = ()
    contract: int = 0
    gauges: Gauges = field(default_factory=Gauges)
    rare: Rare = field(default_factory=Rare)
    name: str = ""
    summary: str = ""
    text: str = ""
    hooks: Mapping[str, Callable[..., Any]] = field(default_factory=dict[str, Callable[..., Any]])
    path: Path = Path()
    flat: tuple[str, ...] = ()
    original: "Effect | None" = None

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """Names of the parameters in order."""
        return tuple(p.name for p in self.parameters)

    @property
    def instant_hooks(self) -> dict[str, Callable[..., Any]]:
        """The hooks that are compiled into the step."""
        return {n: f for n, f in self.hooks.items() if HOOKS[n].instant}

    @property
    def differs_by_pad(self) -> bool:
        """Whether pads may have values of their own: it acts on single pads and on nothing that all have in common.

        How friction turns round is one for all pads: an explicit force, or a bound.
        """
        hooks = self.instant_hooks.keys()
        return bool(hooks) and hooks <= PAD_HOOKS - {"stick"} and "balance" not in self.hooks

    @property
    def derived(self) -> tuple[str, ...]:
        """The derived states that its hooks of one instant ask for, in the order of `DERIVED`."""
        asked = {name for hook in self.instant_hooks.values() for name in inspect.signature(hook).parameters}
        return tuple(name for name in DERIVED if name in asked)

    @property
    def reverses(self) -> bool:
        """Whether it says over which slip friction turns round after a reversal: a stick, or a loading train."""
        return not {"stick", "stretch"}.isdisjoint(self.hooks)

    @property
    def delays_channel(self) -> bool:
        """Whether it delays a channel, as lost samples do whose gap was closed."""
        return self.shifts or bool(self.lag)

    @property
    def all_needs(self) -> tuple[str, ...]:
        """What a campaign must have to test it, its component's needs included, in the order of `NEEDS`."""
        own = {*self.needs, *COMPONENT_NEEDS.get(self.component, ())}
        return tuple(n for n in NEEDS if n in own)

    def without(self, need: str) -> str:
        """Say why it cannot be tested in a campaign that has not what it needs, of `NEEDS`.

        Args:
            need: of `NEEDS`.
        """
        return NEEDS[need].format(steady=self.steady)

    def parameter(self, name: str) -> Parameter:
        """Look a parameter up, also one that a pad has of its own: strength[A].

        Args:
            name: of the parameter, strength or strength[A].

        Raises:
            UnknownNameError: no such parameter.
        """
        plain, bracket, pad = name.partition("[")
        for parameter in self.parameters:
            if parameter.name == name:
                return parameter
        for parameter in self.parameters:
            if parameter.name == plain:
                return parameter.of_pad(pad.removesuffix("]")) if bracket else parameter
        raise unknown_name(
            f"parameter of {self.name}", plain, self.parameter_names, f"`slipwise effects {self.name}` lists them."
        )

    def neutral(self) -> dict[str, float]:
        """Values at which the effect changes nothing (typical values for shape constants)."""
        return {p.name: p.typical if p.neutral is None else p.neutral for p in self.parameters}

    def typical(self) -> dict[str, float]:
        """A first guess for the reference rig."""
        return {p.name: p.typical for p in self.parameters}

    @property
    def advice(self) -> tuple[str, ...]:
        """What to change in its file although it works as it is, a sentence each."""
        advice = [what_to_write(self.path.name, self.flat)] if self.flat else []
        if self.contract != CONTRACT:
            advice.append(
                f"{self.path.name} does not say for which contract it was written: add contract={CONTRACT} to EFFECT, "
                "so that a later Slipwise reads it as it is meant"
            )
        return tuple(advice)

    def _headline(self) -> str:
        return f"{self.name}: {self.summary}"

    def _rows(self) -> list[dict[str, Any]]:
        return [p.row() for p in self.parameters]


def moved_channels(effect: Effect, among: Iterable[str] = CHANNELS) -> frozenset[str]:
    """Return the names of the channels that an effect may change, of those that a record has, or that are listed.

    Args:
        effect: that may change them.
        among: names of channels; all that there are if not given.
    """
    return frozenset(c for c in among if any(fnmatch.fnmatchcase(c, pattern) for pattern in effect.moves))
