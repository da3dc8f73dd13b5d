"""Numbers of diagnosis.json keep the figures that their intervals need."""

import numpy as np
import pytest

from slipwise.diagnosis.result import written
from slipwise.estimation.intervals import Interval


@pytest.mark.parametrize("half", [3e-2, 2e-4, 7e-7])
def test_a_narrow_interval_is_not_rounded_to_nothing(half: float) -> None:
    value = 11.437263518
    out = written(Interval("girder_bending.frequency", value, value - half, value + half, 15.0, "Hz", ""))
    assert out["high"] - out["low"] == pytest.approx(2.0 * half, rel=0.1)
    assert abs(out["value"] - value) < 0.1 * half


def test_a_number_without_an_interval_has_four_figures() -> None:
    out = written(Interval("heating.cover", 0.123456, np.nan, np.nan, 1.0, "1", "upper"))
    assert (out["value"], out["low"], out["high"]) == (0.1235, None, None)
