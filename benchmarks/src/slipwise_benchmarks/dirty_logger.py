"""A laboratory's chain as it is: any rate, unknown causal filters, coloured noise, hum of the mains, few bits."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from slipwise_benchmarks.gauges import NOISE, Logger, sensor
from slipwise_benchmarks.noise import full_scale

Array = NDArray[np.float64]
#: Rate [Hz] -> its share of laboratories [1] and cut-offs that go with it [Hz].
_RATES: dict[float, tuple[float, tuple[float, ...]]] = {
    200.0: (0.15, (40.0, 50.0, 60.0, 80.0)),
    500.0: (0.50, (80.0, 100.0, 120.0, 150.0)),
    1000.0: (0.20, (80.0, 100.0, 150.0, 200.0, 250.0)),
    2000.0: (0.15, (100.0, 150.0, 200.0, 300.0, 400.0)),
}
_BITS = {12: 0.25, 16: 0.5, 0: 0.25}


def draw_dirty_logger(rng: np.random.Generator, names: Sequence[str]) -> Logger:
    """Draw a chain; the ranges of its converter come when the runs are known."""
    rate = float(rng.choice(list(_RATES), p=[share for share, _ in _RATES.values()]))
    noise = {kind: sd * float(np.exp(rng.normal(0.0, 0.35))) for kind, sd in NOISE.items()}
    colour = str(rng.choice(["white", "correlated", "pink", "both"], p=[0.25, 0.3, 0.25, 0.2]))
    return Logger(
        lowpass=float(rng.choice(_RATES[rate][1])),
        order=int(rng.choice([2, 4, 4, 6, 8])),
        phase="causal" if rng.random() < 0.6 else "zero",
        stated=bool(rng.random() < 0.4),
        noise=noise,
        correlation=float(rng.uniform(0.2, 0.9)) if colour in ("correlated", "both") else 0.0,
        pink=float(rng.uniform(0.1, 0.6)) if colour in ("pink", "both") else 0.0,
        hum=float(rng.uniform(0.1, 1.0)) if rng.random() < 0.5 else 0.0,
        mains=float(rng.choice([50.0, 60.0])),
        rate=rate,
        bits=int(rng.choice(list(_BITS), p=list(_BITS.values()))),
    )


def with_ranges(logger: Logger, true: Mapping[str, Mapping[str, Array]], names: Sequence[str]) -> Logger:
    """Give the converter ranges that suit every gauge over all runs, gravity in an accelerometer included."""
    ranges = {}
    for name in names:
        largest = max(float(np.abs(run[name]).max()) for run in true.values())
        if "_az" in name:
            largest += 9.80665
        ranges[name] = full_scale(max(largest, 20.0 * logger.noise[sensor(name)]))
    return replace(logger, ranges=ranges)
