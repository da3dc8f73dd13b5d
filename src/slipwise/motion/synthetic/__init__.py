"""Synthetic motions, one kind a file: sine, multisine, triangle, quake."""

import re
from collections.abc import Callable
from dataclasses import dataclass

from slipwise.errors import unknown_name
from slipwise.motion.synthetic import multisine, quake, sine, triangle
from slipwise.motion.synthetic.spec import Spec, parse_spec
from slipwise.motion.table_motion import TableMotion
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class SyntheticMotion:
    """One kind of synthetic motion, as `slipwise motions` prints it.

    Attributes:
        name: what stands before the colon.
        syntax: how it is written.
        meaning: what it does, with its defaults.
        example: one that works.
        options: names of its options.
        build: makes it.
    """

    name: str
    syntax: str
    meaning: str
    example: str
    options: tuple[str, ...]
    build: Callable[[Spec], TableMotion]


def synthetic_motions() -> tuple[SyntheticMotion, ...]:
    """List the kinds of synthetic motions."""
    return tuple(
        SyntheticMotion(name, kind.SYNTAX, kind.MEANING, kind.EXAMPLE, kind.OPTIONS, kind.build)
        for name, kind in (("sine", sine), ("multisine", multisine), ("triangle", triangle), ("quake", quake))
    )


def looks_synthetic(text: str) -> bool:
    """Return whether this is written as a synthetic motion: a word of two letters or more and a colon."""
    # A single letter before a colon is a drive of Windows.
    return bool(re.match(r"\s*[A-Za-z][A-Za-z_]+\s*:", text))


def parse_motion(text: str) -> TableMotion:
    """Make a synthetic motion from its description, e.g. "sine:2Hz,0.3g,cycles=30,vertical=5Hz,0.2g".

    The same description always gives the same motion.

    Raises:
        UnknownNameError: no such kind, or no such option; the nearest one is named.
        InputError: a value is missing, given twice or not possible.
        UnitError: a unit is missing, unknown or of the wrong dimension.
    """
    kinds = {kind.name: kind for kind in synthetic_motions()}
    name = text.partition(":")[0].strip()
    if name not in kinds:
        raise unknown_name("synthetic motion", name, kinds, "`slipwise motions` lists them.")
    return kinds[name].build(parse_spec(text, kinds[name].options))
