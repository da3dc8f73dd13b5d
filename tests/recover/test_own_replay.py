"""A rig's own replay with the noise of gauges lacks nothing, however many pads the rig has."""

from pathlib import Path

import numpy as np
import pytest

import slipwise as sw
from slipwise.record import write_record
from slipwise.signals.filters import LowPass, lowpass

pytestmark = pytest.mark.slow
#: Motion and role of each run; a sine off the frequency of bridge1 on its buffers.
RUNS = (
    ("quake:seed=1,peak=0.7g,f=3Hz,strong=4s,vertical=0.3g", "fit"),
    ("sine:3Hz,0.4g,cycles=20,vertical=5Hz,0.2g", "fit"),
    ("quake:seed=4,peak=0.6g,f=3Hz,strong=4s,vertical=0.3g", "holdout"),
)
OTHER_SINE = {"bridge1": "sine:2Hz,0.3g,cycles=12,vertical=5Hz,0.2g"}
EVERY = 4
#: End of a channel's name -> noise of a laboratory's gauge [SI].
NOISE = {"ax": 0.02, "az": 0.02, "slip_x": 2e-5, "N": 60.0, "Fx": 15.0}


def noise_of(name: str) -> float | None:
    """Give the noise of a channel; None: it is not measured."""
    if name == "slip_x" or name.startswith(("table_a", "girder_a", "pad_", "storey_")):
        return NOISE.get(name if name == "slip_x" else name.rpartition("_")[2])
    return None


def campaign_of(folder: Path, rig: str, corner: float | None) -> Path:
    """Replay a rig, filter, sample at 500 Hz and add noise as a logger and gauges do, and write it as a campaign."""
    folder.mkdir()
    rng = np.random.default_rng(20261127)
    runs = []
    for number, (motion, role) in enumerate(RUNS):
        motion = OTHER_SINE.get(rig, motion) if motion.startswith("sine") else motion
        record = sw.replay(rig, motion, output_dt=5e-4).record
        channels = {}
        for name, values in record.channels.items():
            if (noise := noise_of(name)) is not None:
                smooth = lowpass(values, record.dt, LowPass(corner)) if corner else values
                channels[name] = smooth[::EVERY] + rng.normal(0.0, noise, len(values[::EVERY]))
        write_record(sw.Record(record.time[::EVERY], channels), folder / f"run{number}.parquet")
        runs.append(f'[[run]]\nfile = "run{number}.parquet"\nrole = "{role}"\n')
    logger = f"{corner:g} Hz" if corner else "none"
    start = f'name = "own"\nrig = "{rig}"\n[logger]\nlowpass = "{logger}"\n\n'
    (folder / "campaign.toml").write_text(start + "\n".join(runs))
    return folder


@pytest.mark.parametrize(
    ("rig", "corner"),
    [
        ("three_pads", 100.0),
        ("six_pads", 100.0),
        *(pytest.param(rig, 100.0, marks=pytest.mark.long) for rig in ("pendulum", "building")),
        *(pytest.param(rig, None, marks=pytest.mark.long) for rig in ("bridge1", "three_pads", "pendulum")),
    ],
)
def test_a_rigs_own_replay_lacks_nothing(tmp_path: Path, rig: str, corner: float | None) -> None:
    """Without a filter too, where nobody knows at which instant between two samples friction turned round."""
    found = sw.diagnose(campaign_of(tmp_path / "own", rig, corner))
    assert found.verdict.kind == "complete", found.sentence
