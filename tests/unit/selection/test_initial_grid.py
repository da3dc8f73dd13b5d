"""The grids of constants on which candidates are tried, and what is projected out of their columns."""

import numpy as np

from slipwise.effects import catalogue
from slipwise.regression.projection import make_projector
from slipwise.selection.initial_grid import is_placed, shapes, strengths, variants


def test_what_the_base_can_do_is_projected_out_and_the_rest_stays() -> None:
    rng = np.random.default_rng(1)
    base = rng.normal(size=(200, 4))
    base[:, 3] = 2.0 * base[:, 0]  # parameters that are one thing must not spoil the others
    project = make_projector(base)
    other = rng.normal(size=200)
    assert np.allclose(project(base @ np.array([1.0, -2.0, 0.5, 3.0])), 0.0, atol=1e-9)
    assert np.allclose(base.T @ project(other), 0.0, atol=1e-9)
    assert np.allclose(project(project(other)), project(other))


def test_every_effect_of_the_catalogue_has_a_strength_or_replaces_a_law() -> None:
    for effect in catalogue().values():
        assert strengths(effect) or effect.replaces or effect.name == "pad_compliance", effect.name


def test_shapes_stay_within_their_bounds() -> None:
    for effect in catalogue().values():
        for shape in shapes(effect):
            for name, value in shape.items():
                effect.parameter(name).check(value, effect.name)


def test_the_value_at_which_a_law_is_neutral_is_no_constant_of_its_shape() -> None:
    assert shapes(catalogue()["pressure_law"]) == [{}]


def test_a_constant_that_may_be_decades_off_is_tried_over_decades():
    tried = [point["length"] for point in shapes(catalogue()["rate_and_state"])]
    assert max(tried) / min(tried) > 300.0


def test_shapes_that_no_fit_reaches_from_another_are_tried_one_by_one() -> None:
    catalogued = catalogue()
    assert {point["horizontal"] for point in shapes(catalogued["cell_inertia"])} == {-1.0, 1.0}
    assert {point["zeroed"] for point in shapes(catalogued["load_crosstalk"])} == {0.0, 1.0}
    orders = [v["order"] for v in variants(catalogued["channel_filter"], {"lag": 3e-3, "order": 2.0})]
    assert sorted(orders) == [1.0, 2.0]


def test_laws_of_a_place_or_a_frequency_are_told_from_those_of_lengths_and_times() -> None:
    placed = {name for name, effect in catalogue().items() if effect.port != "gauge" and is_placed(effect)}
    assert placed == {"position_patch", "girder_bending", "table_pitch"}
