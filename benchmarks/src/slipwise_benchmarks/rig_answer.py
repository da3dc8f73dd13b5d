"""The answer key of a family's campaign of a rig; its form is told in `slipwise_benchmarks.family_answer`."""

from dataclasses import asdict
from typing import Any

from slipwise_benchmarks.dirty import DirtyCampaign
from slipwise_benchmarks.family_answer import Facts, needed
from slipwise_benchmarks.more_dirt import UNNAMED


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
