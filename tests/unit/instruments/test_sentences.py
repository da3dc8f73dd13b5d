"""What a fault of a gauge did, in words."""

import pytest

from slipwise.effects import catalogue
from slipwise.instruments.sentences import sentence


@pytest.mark.parametrize(
    ("effect", "size", "unit", "words"),
    [
        ("channel_gain", 0.05, "1", "girder_az reads 5 % too much"),
        ("channel_gain", -0.2, "1", "girder_az reads 20 % too little"),
        ("channel_delay", -0.004, "s", "girder_az comes 4 ms early"),
        ("channel_offset", -0.1, "m/s^2", "girder_az has its zero off by -0.1 m/s^2"),
    ],
)
def test_a_size_below_zero_is_told_as_the_other_way(effect: str, size: float, unit: str, words: str) -> None:
    assert sentence(catalogue()[effect], "girder_az", size, unit) == words
