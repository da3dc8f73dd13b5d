"""The fields of an effect's blocks beside the blocks: everything reads them so, and files before 0.2 give them so."""

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from functools import wraps
from typing import Any, Generic, TypeVar

from slipwise.effects._fields import ForDiagnosis, Gauges, Rare

Value = TypeVar("Value")
Class = TypeVar("Class", bound=type)
#: Field of `Effect` -> the block that it is.
_BLOCKS: dict[str, type[ForDiagnosis] | type[Gauges] | type[Rare]] = {
    "diagnosis": ForDiagnosis, "gauges": Gauges, "rare": Rare,
}  # fmt: skip


class _Read(Generic[Value]):
    """A field of a block, read from the effect that has the block."""

    def __init__(self, read: "Callable[[BlockFields], Value]") -> None:
        self._read = read

    def __get__(self, effect: "BlockFields", owner: type | None = None) -> Value:
        return self._read(effect)


class BlockFields:
    """An effect's blocks, whose fields are read from the effect itself: `effect.moves` is `effect.diagnosis.moves`."""

    diagnosis: ForDiagnosis
    gauges: Gauges
    rare: Rare

    component = _Read(lambda effect: effect.diagnosis.component)
    equation = _Read(lambda effect: effect.diagnosis.equation)
    moves = _Read(lambda effect: effect.diagnosis.moves)
    signature = _Read(lambda effect: effect.diagnosis.signature)
    confused_with = _Read(lambda effect: effect.diagnosis.confused_with)
    needs = _Read(lambda effect: effect.diagnosis.needs)
    limits = _Read(lambda effect: effect.diagnosis.limits)

    target = _Read(lambda effect: effect.gauges.target)
    fault = _Read(lambda effect: effect.gauges.fault)
    shifts = _Read(lambda effect: effect.gauges.shifts)
    lag = _Read(lambda effect: effect.gauges.lag)
    plainer = _Read(lambda effect: effect.gauges.plainer)
    in_samples = _Read(lambda effect: effect.gauges.in_samples)

    steady = _Read(lambda effect: effect.rare.steady)
    exact = _Read(lambda effect: effect.rare.exact)
    replaces = _Read(lambda effect: effect.rare.replaces)
    adds = _Read(lambda effect: effect.rare.adds)
    same_unless = _Read(lambda effect: effect.rare.same_unless)
    turns = _Read(lambda effect: effect.rare.turns)
    base = _Read(lambda effect: effect.rare.base)
    stands_for = _Read(lambda effect: effect.rare.stands_for)
    single = _Read(lambda effect: effect.rare.single)


def takes_flat_fields(cls: Class) -> Class:
    """Let a class of blocks be made from their fields too; it remembers in `flat` which these were.

    Args:
        cls: a data class with the fields of `_BLOCKS` and `flat`.
    """
    made: Callable[..., None] = getattr(cls, "__init__")  # noqa: B009 - a type checker takes it for another class's

    @wraps(made)
    def make(self: object, *given: Any, **named: Any) -> None:
        made(self, *given, **_in_blocks(named))

    setattr(cls, "__init__", make)  # noqa: B010 - as above
    return cls


def _in_blocks(named: Mapping[str, Any]) -> dict[str, Any]:
    """Return arguments in which what belongs to a block lies in it."""
    own, flat = dict(named), list[str]()
    for name, block in _BLOCKS.items():
        if inside := {f.name: own.pop(f.name) for f in fields(block) if f.name in own}:
            own[name] = replace(own[name], **inside) if name in own else block(**inside)
            flat += inside
    return {**own, "flat": tuple(flat)} if flat else own


def what_to_write(file: str, flat: tuple[str, ...]) -> str:
    """Say how the fields that a file gives beside its blocks are given in them.

    Args:
        file: its name.
        flat: names of the fields.
    """
    blocks = (
        (name, block.__name__, [f"{f.name}=..." for f in fields(block) if f.name in flat])
        for name, block in _BLOCKS.items()
    )
    words = ", ".join(f"{name}={block}({', '.join(inside)})" for name, block, inside in blocks if inside)
    return (
        f"{file} works as it is, and gives the fields of EFFECT as files before 0.2 do: write them in blocks that "
        f"slipwise.effects has, {words}"
    )
