"""Windows that start from true states follow the free run that the states were taken from."""

import numpy as np
import pytest

from shaking import G, sine
from slipwise.model import base_model, use
from slipwise.simulation.simulator import simulate
from slipwise.simulation.windows import Windows, simulate_windows

DT = 5e-4


@pytest.mark.parametrize("effects", [(), ("presliding",)])
def test_windows_follow_the_free_run_whose_states_they_start_from(effects):
    model = base_model("bridge1").adding(*(use(e) for e in effects))
    motion = sine(2.0, 0.3 * G, 6.0)
    free = simulate(model, motion, dt=DT, output_dt=DT).record
    starts, length = [3000, 5500, 8000], 2000
    windows = Windows(
        acceleration=np.stack([motion[s : s + length] for s in starts]),
        slip=np.stack([[free["slip_x"][s], free["slip_y"][s]] for s in starts]),
        velocity=np.stack([[free["slip_vx"][s], free["slip_vy"][s]] for s in starts]),
        memory=None,
        start=np.array(starts) * DT,
    )
    for start, answer in zip(starts, simulate_windows(model, windows, every=1), strict=True):
        true = free["slip_x"][start : start + length]
        # The girder starts upright and nods on its pads; presliding starts with an empty bristle.
        assert np.abs(answer["slip_x"] - true).max() < (0.02 if not effects else 0.05) * np.ptp(free["slip_x"])


def test_windows_run_alike_on_one_thread_and_on_two():
    model = base_model("bridge2")
    motion = sine(2.0, 0.3 * G, 2.0)
    windows = Windows(
        np.stack([motion[:3000], motion[1000:4000]]), np.zeros((2, 2)), np.zeros((2, 2)), None, np.zeros(2)
    )
    one, two = (simulate_windows(model, windows, threads=n) for n in (1, 2))
    for a, b in zip(one, two, strict=True):
        assert all(np.array_equal(a[name], b[name]) for name in a)
