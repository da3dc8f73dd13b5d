"""The answer key of a family's campaign: what is there, how much it matters, and what else is off, as plain data.

    name, family, maker, seed, held_out_family
    missing         names that a verdict should give: of one limit of materiality and one floor or more
    effects         name -> {of_limit, floors {raw, after_fit}, importance, unnamed}, dirt of the catalogue's names too
    imperfections   what is off in the laboratory, with sizes
    first           faults that come before any balance
    details         law and numbers of everything that was planted
    alternatives    name -> what counts for it

A law outside the catalogue is called "unknown". What has no name in any catalogue is `unnamed` and stays immaterial.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from bench.dirty import DirtyCampaign
from bench.more_dirt import UNNAMED
from bench.sliders import SliderCampaign

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


def answer_of_rig(facts: Facts, made: DirtyCampaign) -> dict[str, Any]:
    """Give the answer key of a campaign of a rig."""
    said = made.truth.as_dict()
    effects = {
        "unknown" if name == "law" else name: {
            **{key: entry[key] for key in ("of_limit", "floors", "importance")},
            "unnamed": name in UNNAMED,
        }
        for name, entry in said["effects"].items()
    }
    imperfections = {
        "dirt": {name: details for name, details in said["details"].items() if name.endswith("(dirt)")},
        "chain": said["logger"],
        "said": said["said"],
        "mass": said["settings"]["mass"],
    }
    return {
        **asdict(facts),
        "missing": needed(effects),
        "effects": effects,
        "imperfections": imperfections,
        "first": said["first"],
        "details": said["details"],
        "alternatives": {},
        "settings": said["settings"],
        **{key: said[key] for key in ("group", "rig", "rich", "runs")},
    }


def answer_of_slider(facts: Facts, made: SliderCampaign) -> dict[str, Any]:
    """Give the answer key of a test of a single slider."""
    effects = {name: {**entry, "unnamed": False} for name, entry in made.answer["effects"].items()}
    # without friction a spring is nothing that a bearing should have: it may be unknown, or a face that is curved
    springy = made.bearing.mu_fast == 0.0
    return {
        **asdict(facts),
        "missing": needed(effects),
        "effects": effects,
        "imperfections": made.answer["imperfections"],
        "first": [],
        "details": made.answer["details"],
        "alternatives": {"restrainer": ["slide_curvature", "unknown"]} if springy else {},
        "settings": made.answer["settings"],
        "group": "slider",
        "rig": "pad",
        "rich": False,
        "runs": list(made.roles.values()),
    }
