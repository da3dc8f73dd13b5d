"""A slider on a prescribed slip, as its owner would write it down."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

HEADER = "time [s],slip_x [mm],pad_A_N [kN],pad_A_Fx [kN]"
RUNS = '[[run]]\nfile = "one.csv"\nrole = "fit"\n[[run]]\nfile = "two.csv"\nrole = "holdout"\n'


def slider(seed: int, count: int = 400) -> np.ndarray:
    """Give time [s], slip [mm], load [kN], force [kN] of a slider, (n, 4)."""
    rng = np.random.default_rng(seed)
    time = 0.01 * np.arange(count)
    slip = 20.0 * np.sin(2.0 * np.pi * 0.5 * time) + 0.01 * rng.standard_normal(count)
    force = 1.2 * np.sign(np.cos(2.0 * np.pi * 0.5 * time)) + 0.01 * rng.standard_normal(count)
    return np.stack([time, slip, 10.0 + 0.05 * rng.standard_normal(count), force], axis=1)


def text(table: np.ndarray, header: str = HEADER) -> str:
    rows = "\n".join(",".join(f"{value:.6g}" for value in row) for row in table)
    return f"{header}\n{rows}\n"


def write_at_loads(folder: Path, loads: Mapping[str, float], power: float) -> None:
    """Write one run for each steady load [kN]; friction grows with its power, and the last run is held out."""
    runs = []
    for seed, (name, load) in enumerate(loads.items()):
        rng = np.random.default_rng(seed)
        time = np.arange(0.0, 4.0, 0.005)
        phase = 2.0 * np.pi * 0.5 * time
        friction = 1.0 * (load / 10.0) ** power * np.sign(np.cos(phase))
        noise = rng.standard_normal((3, len(time)))
        columns = [time, 15.0 * np.sin(phase) + 0.005 * noise[0], load + 0.02 * noise[1], friction + 0.005 * noise[2]]
        (folder / f"{name}.csv").write_text(text(np.stack(columns, axis=1)))
        role = "holdout" if name == list(loads)[-1] else "fit"
        runs.append(f'[[run]]\nfile = "{name}.csv"\nrole = "{role}"\n')
    (folder / "campaign.toml").write_text('name = "slider"\nrig = "pad"\n' + "".join(runs))
