"""The oscillator that effects share, against the closed form of a steady sine."""

import numpy as np
import pytest

from slipwise.signals.oscillator import oscillator


@pytest.mark.parametrize("derivative", [0, 1, 2])
@pytest.mark.parametrize("push", [5.0, 14.0, 15.0, 30.0])
def test_a_sine_pushes_the_oscillator_as_theory_says_at_the_rate_of_a_logger(push: float, derivative: int) -> None:
    dt, frequency, damping = 2e-3, 15.0, 0.1
    time = dt * np.arange(4000)
    found = oscillator(np.sin(2 * np.pi * push * time), dt, frequency, damping, derivative)
    turn, natural = 2j * np.pi * push, 2 * np.pi * frequency
    gain = turn**derivative / (turn**2 + 2 * damping * natural * turn + natural**2)
    steady = (gain * np.exp(turn * time)).imag
    late = time > 2.0  # what began at the start has died away
    assert np.abs(found - steady)[late].max() < 1e-3 * abs(gain)
