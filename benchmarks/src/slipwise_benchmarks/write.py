"""A campaign's folder in the form of the contract: campaign.toml, one CSV for each run, and the answer apart."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise_benchmarks.gauges import Logger

Array = NDArray[np.float64]
RUNS: tuple[tuple[str, str], ...] = (
    ("sine_hv", "fit"),
    ("quake_h", "fit"),
    ("quake_hv", "fit"),
    ("quake_hv_again", "repeat"),
    ("quake2_hv", "holdout"),
)


def unit_of(channel: str) -> tuple[str, float]:
    """Give the unit a channel is written in and how many of it one SI unit is."""
    if channel == "time":
        return "s", 1.0
    if channel.startswith("slip"):
        return "mm", 1.0e3
    if channel == "yaw":
        return "mrad", 1.0e3
    if channel.startswith(("pad_", "buffer_")):
        return "kN", 1.0e-3
    return "m/s^2", 1.0


def write_csv(path: Path, channels: Mapping[str, Array]) -> None:
    """Write channels (SI) with five digits, time with eight, units in the header."""
    units = {name: unit_of(name) for name in channels}
    header = ",".join(f"{name} [{unit}]" for name, (unit, _) in units.items())
    table = np.stack([values * units[name][1] for name, values in channels.items()], axis=1)
    row = ",".join("%.8g" if name == "time" else "%.5g" for name in channels)
    lines = [row % tuple(one) for one in table.tolist()]
    path.write_text("\n".join([header, *lines]) + "\n", encoding="utf-8")


def campaign_toml(
    name: str, rig: str, logger: Logger, runs: Sequence[tuple[str, str]] = RUNS, mass: float | None = None
) -> str:
    """Give the text of campaign.toml; the logger is described where the laboratory knows it.

    Args:
        name: of the campaign.
        rig: that it says it is.
        logger: the chain.
        runs: file without suffix, role.
        mass: that it says the girder has [kg]. None: it does not say.
    """
    lines = [f'name = "{name}"', f'rig = "{rig}"', ""]
    if mass is not None:
        lines += ["[specimen]", f'mass = "{mass:.5g} kg"', ""]
    if logger.stated:
        lines += [
            "[logger]",
            f'lowpass = "{logger.lowpass:g} Hz"',
            f"order = {logger.order}",
            f'phase = "{logger.phase}"',
            "",
        ]
    count = {2: "two", 3: "three", 4: "four", 5: "five"}[len(runs)]
    lines += [f"# One specimen, {count} runs. The girder was at rest before each run.", ""]
    for run, role in runs:
        lines += ["[[run]]", f'file = "{run}.csv"', f'role = "{role}"', 'rest_before = "30 min"', ""]
    return "\n".join(lines)


def write_campaign(
    folder: Path,
    rig: str,
    logger: Logger,
    runs: Mapping[str, Mapping[str, Array]],
    roles: Sequence[tuple[str, str]] = RUNS,
    mass: float | None = None,
) -> None:
    """Write campaign.toml and the runs' CSV files into `folder`, which is made when it is not there.

    Args:
        folder: of the campaign; its name becomes the campaign's.
        rig: as in `campaign_toml`.
        logger: as there.
        runs: file without suffix -> channels [SI].
        roles: file without suffix, role.
        mass: as in `campaign_toml`.
    """
    folder.mkdir(parents=True, exist_ok=True)
    text = campaign_toml(folder.name, rig, logger, roles, mass)
    (folder / "campaign.toml").write_text(text, encoding="utf-8")
    for run, channels in runs.items():
        write_csv(folder / f"{run}.csv", channels)


def write_truth(path: Path, answer: dict[str, Any]) -> None:
    """Write the answer: "missing", "settings" and "instruments" as in practice campaigns, and more."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(answer, indent=1) + "\n", encoding="utf-8")
