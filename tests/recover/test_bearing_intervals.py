"""The intervals of a bearing's quantities hold the truth: 30 drawn sliders whose friction follows mu(V), in noise."""

from pathlib import Path

import numpy as np
import pytest

from slipwise.bearings.cycles import find_cycles
from slipwise.bearings.judge import judge_bearing
from slipwise.bearings.loops import Loop
from slipwise.bearings.quantities import measure_cycle
from unit.campaign.slider import text

pytestmark = pytest.mark.long

DRAWS, LOAD, AREA = 30, 10.0e3, 1.4522e-3
JUDGED = ("energy", "friction_mean", "friction_peak_speed", "effective_stiffness", "equivalent_damping",
          "characteristic_strength")  # fmt: skip


def write_slider(folder: Path, seed: int) -> dict[str, dict[str, float]]:
    """Write a campaign of three runs, and give the mean of the true quantities of each."""
    rng = np.random.default_rng([seed, 77])
    fast, rate = rng.uniform(0.04, 0.15), rng.uniform(20.0, 100.0)
    slow = fast * rng.uniform(0.3, 0.8)
    truth, runs = {}, ""
    for name, frequency, amplitude in (("slow", 0.1, 0.02), ("middle", 0.5, 0.02), ("quick", 1.0, 0.015)):
        time = np.arange(0.0, 5.0 / frequency, 1.0 / (200.0 * frequency))
        slip = -amplitude * np.cos(2.0 * np.pi * frequency * time)  # it begins at rest
        speed = np.gradient(slip, time)
        force = LOAD * (fast - (fast - slow) * np.exp(-rate * np.abs(speed))) * np.sign(speed)
        noise = rng.standard_normal((3, len(time))) * [[2e-6], [20.0], [3.0]]
        table = np.stack([time, 1e3 * (slip + noise[0]), 1e-3 * (LOAD + noise[1]), 1e-3 * (force + noise[2])], axis=1)
        (folder / f"{name}.csv").write_text(text(table))
        runs += f'[[run]]\nfile = "{name}.csv"\nrole = "fit"\n'
        velocity = np.stack([speed, np.zeros(len(time))], axis=1)
        loop = Loop("A", 0.0, slip, velocity, np.full(len(time), LOAD), AREA, force[:, None])
        cycles = [measure_cycle(loop.of(c)) for c in find_cycles(slip).cycles if c.closed]
        truth[name] = {key: float(np.mean([c[key] for c in cycles])) for key in JUDGED}
    (folder / "campaign.toml").write_text(f'name = "slider"\nrig = "pad"\n{runs}')
    return truth


def test_nine_of_ten_intervals_hold_the_truth(tmp_path):
    inside: dict[str, list[bool]] = {key: [] for key in JUDGED}
    for seed in range(DRAWS):
        folder = tmp_path / f"{seed}"
        folder.mkdir()
        truth = write_slider(folder, seed)
        found = judge_bearing(folder)
        for row in found.of("mean of cycles"):
            for key in JUDGED:
                value = row.values[key]
                inside[key].append(bool(value.low <= truth[row.run][key] <= value.high))
    shares = {key: float(np.mean(held)) for key, held in inside.items()}
    assert all(len(held) == 3 * DRAWS for held in inside.values())
    assert min(shares.values()) >= 0.9, shares
