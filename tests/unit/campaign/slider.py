"""A slider on a prescribed slip, as its owner would write it down."""

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
