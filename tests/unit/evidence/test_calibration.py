"""Logistic chances, and those that ship."""

import pytest

from slipwise.evidence.calibration import Logistic, compute_log_odds, load_calibration


@pytest.mark.parametrize("chance", [0.02, 0.3, 0.5, 0.97])
def test_log_odds_and_a_logistic_of_them_are_the_chance_again(chance: float) -> None:
    assert Logistic(0.0, {"odds": 1.0})({"odds": compute_log_odds(chance), "unused": 7.0}) == pytest.approx(chance)


def test_nothing_is_surer_than_one_in_a_hundred() -> None:
    steep = Logistic(0.0, {"odds": 1.0})
    assert (steep({"odds": -1e3}), steep({"odds": 1e3})) == (0.01, 0.99)
    assert compute_log_odds(0.0) == pytest.approx(-compute_log_odds(1.0)) == pytest.approx(-13.8, abs=0.1)


def test_what_ships_says_where_it_comes_from_and_grows_with_what_speaks_for_it() -> None:
    shipped = load_calibration()
    for number in ("lead", "gauge"):
        assert shipped.present.weights[number] > 0.0
    # an effect that moves when one motion is left out is believed less
    assert shipped.present.weights["spread"] < 0.0 and shipped.matters.weights["spread"] < 0.0
    assert shipped.leads(0.0) < shipped.leads(3.0)
    assert shipped.whole(0.2, 0.0) < shipped.whole(0.9, 0.0)
    # what leaves floors is less sure to be right
    assert shipped.whole(0.9, 1.0) < shipped.whole(0.9, 0.0)
    rest = {"explained": 0.5, "left": 0.3, "relative": -3.0}
    assert shipped.family({**rest, "explained": 0.1}) < shipped.family({**rest, "explained": 0.9})
    # what a state organises is a law, the larger the likelier
    assert shipped.family({**rest, "left": 0.9}) < shipped.family(rest) < shipped.family({**rest, "relative": -5.0})
