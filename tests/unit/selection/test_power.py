"""Power on made columns: what shows is seen, what does not is not, and what looks alike is taken for the other."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.selection.power import compute_power
from slipwise.selection.twins import compute_posterior_of_twin, compute_statistics_of_twin, make_twin
from slipwise.selection.weighed_model import WeighedModel
from weighed import column, noise, waves, weigh


@pytest.fixture(scope="module")
def weighed() -> WeighedModel:
    """Columns of two floors a limit, of a tenth of one, and two that are nearly one."""
    x = waves(5)
    alike = x[:, 3] + 0.01 * x[:, 4]
    made = {"heating": x[:, 0], "run_in": 0.02 * x[:, 1], "guide_drag": x[:, 3], "slide_tilt": alike}
    return weigh(noise(), [column(name, values) for name, values in made.items()])


def test_a_twin_of_nothing_has_the_residual_of_the_campaign_again(weighed: WeighedModel) -> None:
    found = compute_statistics_of_twin(weighed, make_twin(weighed, 0, 0.0, 3))
    assert np.allclose(found.pulls, weighed.noise[3])
    assert np.allclose(found.squares, weighed.statistics.squares)


def test_what_a_twin_holds_stands_in_its_residual_the_other_way_round(weighed: WeighedModel) -> None:
    found = compute_statistics_of_twin(weighed, make_twin(weighed, 0, 2.0, 0))
    base = weighed.statistics.base
    expected = weighed.noise[0][0, base] - 2.0 * weighed.statistics.products[0, base, base]
    assert found.pulls[0, base] == pytest.approx(expected)


def test_power_tells_what_would_be_seen_and_for_what_it_would_be_taken(weighed: WeighedModel) -> None:
    power = compute_power(weighed, 6)
    assert power["heating"].seen == power["heating"].named == power["heating"].twins == 6
    assert power["run_in"].seen == 0
    pair = power["guide_drag"]
    assert pair.named < 6 and set(pair.taken_for) <= {"slide_tilt"}


def test_an_effect_that_has_a_planted_column_is_put_in_by_it_and_sought_by_its_own() -> None:
    x = waves(5)
    sought = [column("heating", x[:, 0]), column("guide_drag", x[:, 3])]
    weighed = replace(weigh(noise(), [column("heating", 0.02 * x[:, 1]), *sought]), planted=1)
    power = compute_power(weighed, 6)
    assert power["heating"].seen == 0 and power["guide_drag"].seen == 6
    strong = compute_posterior_of_twin(weighed, make_twin(weighed, 1, 1.0, 0))
    assert strong.strengths.shape[1] == 2 and strong.sizes[:, strong.labels.index("heating")].mean() > 0.5
