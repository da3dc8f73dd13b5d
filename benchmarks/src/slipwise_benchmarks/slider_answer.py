"""The answer key of a family's test of a single slider; its form is told in `slipwise_benchmarks.family_answer`."""

from dataclasses import asdict
from typing import Any

from slipwise_benchmarks.family_answer import Facts, needed
from slipwise_benchmarks.sliders import SliderCampaign


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
