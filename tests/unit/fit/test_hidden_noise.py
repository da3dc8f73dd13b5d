"""Noise that an effect hides is counted as if it were still there, without jumps that a slope would take for signal."""

import numpy as np
import pytest

from slipwise.fit.weights import with_hidden


def test_each_sample_carries_its_part_of_what_is_hidden() -> None:
    part = np.random.default_rng(1).standard_normal(500)
    part[:100] = 0.0  # masked
    counted = with_hidden(part, 0.3)
    assert float(counted @ counted) == pytest.approx(float(part @ part) + 0.3 * 400)
    assert not counted[:100].any()


def test_a_residual_that_changes_sign_does_not_jump() -> None:
    part = np.random.default_rng(2).standard_normal(500)
    shifted = part - (part[7] + 1e-6)
    moved = with_hidden(shifted + 2e-6, 0.3) - with_hidden(shifted, 0.3)
    assert np.abs(moved).max() < 1e-5
