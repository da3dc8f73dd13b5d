"""What the search asks to be fitted, and that no fit ends worse than what it contains."""

from dataclasses import replace

import pytest

from bench import build_campaign
from measured import as_campaign, fit_base
from slipwise.diagnosis.candidates import list_candidates
from slipwise.diagnosis.hypothesis import STICK_LENGTH, make_base_hypothesis, polish, refit
from slipwise.diagnosis.initial_grid import places, shapes
from slipwise.diagnosis.initial_guesses import longer_stick, starting_points
from slipwise.diagnosis.screening import screen_shapes
from slipwise.diagnosis.search_state import Search
from slipwise.effects import catalogue
from slipwise.estimation.base_fit import BaseFit, evaluate_at_rated
from slipwise.relations.parameters import Term


@pytest.fixture(scope="module")
def base() -> BaseFit:
    return fit_base(as_campaign(build_campaign(41041, effects=("pressure_law",), size="medium", rig="bridge1")))


@pytest.mark.slow
def test_a_fit_never_ends_worse_than_what_it_contains(base: BaseFit) -> None:
    """The base hides nearly all of another dependence on pressure, and must move far when it is added."""
    term = Term(catalogue()["pressure_law"])
    for slope in (-0.4, -0.2, 0.2, 0.4):
        start = {**term.effect.typical(), "slope": slope, "bend": 0.05}
        assert refit(base, [term], {term.label: start}).solution.cost < base.solution.cost


def test_a_longer_stick_is_asked_for_where_that_of_the_base_is_at_its_bound(base: BaseFit) -> None:
    found = make_base_hypothesis(base)
    state = Search(base, {}, list_candidates(base)[0], (), (found,))
    most = next(f.high for f in base.free if f.key == STICK_LENGTH)
    for share, asked in ((0.5, 0), (1.0, 1)):
        values = {**found.solution.values, STICK_LENGTH: share * most}
        longer = longer_stick(state, replace(found, solution=replace(found.solution, values=values)))
        assert len(longer) == asked
        for those, starts in longer:
            assert [t.effect.name for t in those] == ["presliding"]
            assert starts["presliding"]["length"] == pytest.approx(4.0 * most)


def test_a_law_whose_strength_ran_against_its_bound_is_begun_again_from_every_shape(base: BaseFit) -> None:
    found, term = make_base_hypothesis(base), Term(catalogue()["buffer_softening"])
    state = Search(base, {}, [term], (), (found,))
    fit = refit(base, [term], {term.label: term.effect.typical()}, most=1)
    for rise, begun in ((1.0, len(shapes(term.effect))), (0.2, 0)):
        values = {**fit.solution.values, f"{term.label}.rise": rise}
        *_, again = starting_points(state, [], [replace(fit, solution=replace(fit.solution, values=values))])
        assert len(again) == begun
        assert all(starts[term.label]["rise"] == 0.2 for _, starts in again)


@pytest.mark.slow
def test_a_patch_is_found_at_its_place_where_the_small_grid_takes_another() -> None:
    made = build_campaign(41161, effects=("position_patch",), size="small", rig="bridge2")
    base = fit_base(as_campaign(made))
    place = made.truth.hidden.settings["patch_place"]
    term = next(t for t in list_candidates(base)[0] if t.effect.name == "position_patch")
    small, whole = (screen_shapes(base, term, grid(term.effect))[0] for grid in (shapes, places))
    assert abs(small.values["place"] - place) > 8e-3
    assert abs(whole.values["place"] - place) < 4e-3 and whole.gain > small.gain


@pytest.mark.long
def test_a_table_that_rocks_is_found_from_rated_numbers_where_the_base_is_bent_by_it() -> None:
    """Fitted with another pitch and late gauges the base was 90 floors off, and every fit from there ended at 14."""
    base = fit_base(as_campaign(build_campaign(61043, effects=("table_pitch",), size="large", rich=True)))
    term = next(t for t in list_candidates(base)[0] if t.effect.name == "table_pitch")
    left = {}
    for begun in (base, evaluate_at_rated(base)):
        values = screen_shapes(begun, term, shapes(term.effect))[0].values
        found = polish(refit(begun, [term], {term.label: values}))
        left[begun is base] = found.solution.cost / sum(fitted for fitted, _ in found.summary.counts.values())
    assert left[True] > 10.0
    assert left[False] < 1.2
