"""A campaign as a laboratory with fewer gauges would have recorded it, and its answer key.

The records lose columns, nothing else changes. What is missing is judged by what is left: an effect matters where it
changes a channel that is left, or the largest slip, energy or load; a fault of gauges that were dropped is no answer.
"""

import csv
import re
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from slipwise_benchmarks.importance import MATERIAL

#: What a laboratory may lack: every gauge of the pads, or their force gauges.
DROPPED = {"pads": re.compile(r"pad_"), "forces": re.compile(r"pad_\w+_F[xy]")}
Answer = Mapping[str, Any]


def write_without(campaign: Path, out: Path, lacking: str) -> None:
    """Write a campaign's files without the columns of some gauges.

    Args:
        campaign: folder with CSV files whose columns are channels, and campaign.toml.
        out: folder to write.
        lacking: one of `DROPPED`.
    """
    out.mkdir(parents=True, exist_ok=True)
    for file in campaign.iterdir():
        if file.suffix != ".csv":
            shutil.copy(file, out / file.name)
            continue
        with file.open(newline="", encoding="utf-8") as stream:
            rows = list(csv.reader(stream))
        kept = [i for i, name in enumerate(rows[0]) if not DROPPED[lacking].match(name)]
        with (out / file.name).open("w", newline="", encoding="utf-8") as stream:
            csv.writer(stream).writerows([row[i] for i in kept] for row in rows)


def answer_without(answer: Answer, lacking: str) -> dict[str, Any]:
    """Return the answer key of what such a laboratory recorded."""

    def is_left(name: str) -> bool:
        return not DROPPED[lacking].match(name)

    effects = {}
    for name, entry in answer["effects"].items():
        if _channels_of(answer["details"].get(name, {})) and not any(
            map(is_left, _channels_of(answer["details"][name]))
        ):
            continue
        worth = entry["importance"]
        figures = [abs(worth.get(key, 0.0)) for key in ("peak_slip", "energy", "largest_load")]
        limit = max([*(v for c, v in worth["channels"].items() if is_left(c)), *figures]) / MATERIAL
        effects[name] = {**entry, "of_limit": min(limit, entry["of_limit"])}
    first = [one for one in answer["first"] if any(map(is_left, one["channels"]))]
    kinds = {one["kind"] for one in answer["first"]} - {one["kind"] for one in first}
    missing = [
        name
        for name in answer["missing"]
        if (name in effects and effects[name]["of_limit"] >= 1.0)
        or (name not in answer["effects"] and name not in kinds)
    ]
    return {**answer, "effects": effects, "first": first, "missing": missing}


def _channels_of(details: Mapping[str, Any]) -> Sequence[str]:
    """Return the channels of a fault of gauges."""
    parts = [details, *details.get("faults", ())]
    return [channel for part in parts for channel in part.get("channels", ())]
