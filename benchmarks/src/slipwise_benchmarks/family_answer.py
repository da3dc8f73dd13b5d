"""The answer key of a family's campaign: what is there, how much it matters, and what else is off, as plain data.

    name, family, maker, seed, held_out_family
    missing         names that a verdict should give: of one limit of materiality and one floor or more
    effects         name -> {of_limit, floors {raw, after_fit}, importance, unnamed}, dirt of the catalogue's names too
    imperfections   what is off in the laboratory, with sizes
    first           faults that come before any balance
    details         law and numbers of everything that was planted
    alternatives    name -> what counts for it

Floors of a rig's effect are 0 where it is below half a limit: nobody asks.

A law outside the catalogue is called "unknown". What has no name in any catalogue is `unnamed` and stays immaterial.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

#: From which an effect must be named [limits of materiality], and from which it can be seen [floors].
MATTERS, SEEN = 1.0, 1.0


@dataclass(frozen=True)
class Facts:
    """What a campaign is.

    Attributes:
        name: of its folder.
        family, maker, seed: that made it.
        held_out_family: whether it is left out of all training.
    """

    name: str
    family: str
    maker: str
    seed: int
    held_out_family: bool


def needed(effects: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """Give the names that a verdict should give, the largest first."""
    names = [
        name
        for name, entry in effects.items()
        if entry["of_limit"] >= MATTERS and entry["floors"]["after_fit"] >= SEEN and not entry["unnamed"]
    ]
    return sorted(names, key=lambda name: -effects[name]["of_limit"])
