"""Campaigns of a rig's own replay, with what a logger and gauges add: nothing else is missing in them."""

from pathlib import Path

import numpy as np

import slipwise as sw
from slipwise.model import Model
from slipwise.record import write_record
from slipwise.signals.filters import LowPass, lowpass

#: Motion and role of each run; a sine off the frequency of bridge1 on its buffers.
RUNS = (
    ("quake:seed=1,peak=0.7g,f=3Hz,strong=4s,vertical=0.3g", "fit"),
    ("sine:3Hz,0.4g,cycles=20,vertical=5Hz,0.2g", "fit"),
    ("quake:seed=4,peak=0.6g,f=3Hz,strong=4s,vertical=0.3g", "holdout"),
)
OTHER_SINE = {"bridge1": "sine:2Hz,0.3g,cycles=12,vertical=5Hz,0.2g"}
STEP = 5e-4
#: End of a channel's name -> noise of a laboratory's gauge [SI].
NOISE = {"ax": 0.02, "az": 0.02, "slip_x": 2e-5, "N": 60.0, "Fx": 15.0}


def noise_of(name: str) -> float | None:
    """Give the noise of a channel; None: it is not measured."""
    if name == "slip_x" or name.startswith(("table_a", "girder_a", "pad_", "storey_")):
        return NOISE.get(name if name == "slip_x" else name.rpartition("_")[2])
    return None


def campaign_of(
    folder: Path, rig: str, corner: float | None, *, model: Model | None = None, rate: float = 500.0, runs: int = 3,
    noisy: bool = True,
) -> Path:  # fmt: skip
    """Replay a rig, filter, sample and add noise as a logger and gauges do, and write it as a campaign.

    Args:
        folder: that is made.
        rig: its name.
        corner: of the logger's filter [Hz]; None for a logger without one.
        model: of the rig where it is not as rated.
        rate: at which it is logged [Hz], a whole part of 2000.
        runs: how many there are, from the first on.
        noisy: whether gauges have noise; a simulation has none.
    """
    folder.mkdir()
    rng = np.random.default_rng(20261127)
    every = round(1.0 / (STEP * rate))
    lines = []
    for number, (motion, role) in enumerate(RUNS[:runs]):
        motion = OTHER_SINE.get(rig, motion) if motion.startswith("sine") else motion
        record = sw.replay(rig if model is None else model, motion, output_dt=STEP).record
        channels = {}
        for name, values in record.channels.items():
            if (noise := noise_of(name)) is not None:
                smooth = lowpass(values, record.dt, LowPass(corner)) if corner else values
                channels[name] = smooth[::every] + noisy * rng.normal(0.0, noise, len(values[::every]))
        write_record(sw.Record(record.time[::every], channels), folder / f"run{number}.parquet")
        lines.append(f'[[run]]\nfile = "run{number}.parquet"\nrole = "{role}"\n')
    logger = f"{corner:g} Hz" if corner else "none"
    start = f'name = "own"\nrig = "{rig}"\n[logger]\nlowpass = "{logger}"\n\n'
    (folder / "campaign.toml").write_text(start + "\n".join(lines))
    return folder
