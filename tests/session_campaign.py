"""A campaign of the second simulator that lies on disk as a user has it: pads that run in, one run held out."""

from pathlib import Path

from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.write import write_campaign

#: What is missing in it.
MISSING = "run_in"
ROLES = (("sine_hv", "fit"), ("quake_hv", "fit"), ("quake2_hv", "holdout"))


def write_session_campaign(folder: Path) -> Path:
    """Write it; gives the folder."""
    made = build_campaign(7, name=folder.name, effects=(MISSING,), size="large", rig="bridge1")
    runs = {name: made.recorded[name] for name, _ in ROLES}
    write_campaign(folder, made.truth.rig, made.truth.logger, runs, ROLES)
    return folder
