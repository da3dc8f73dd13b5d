"""Whether a law holds in another campaign follows from likelihoods and from the interval of its size there."""

import pytest

from slipwise.discovery.law_test import judge

CLEAR = (0.4, 0.6)


@pytest.mark.parametrize(
    ("nats", "size", "holds"),
    [
        ((-40.0, -5.0, -4.0, -4.0), (0.9, 1.1), "as it stands"),
        ((-40.0, -20.0, -4.0, -4.0), CLEAR, "with another size"),
        ((-40.0, -20.0, -20.0, -4.0), CLEAR, "with other constants"),
        ((-40.0, -60.0, -40.0, -40.0), (-0.1, 0.1), "not at all"),
        ((-40.0, -40.5, -40.0, -40.0), (-9.0, 9.0), "cannot tell"),
    ],
)
def test_likelihoods_tell_how_a_law_holds(nats, size, holds):
    assert judge(nats, size) == holds


def test_a_size_that_may_be_nothing_is_not_told_as_another_size():
    """A law that was not there, and goes with the one that is, held "with another size, 0.1 (-0.01 to 0.2)"."""
    nats = (-40.0, -60.0, -35.0, -35.0)
    assert judge(nats, CLEAR) == "with another size" and judge(nats, (-0.01, 0.2)) == "not at all"
