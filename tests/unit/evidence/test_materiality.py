"""When a step is worth a name: squared residuals before and after decide, on fitted and on held-out runs."""

import pytest

from slipwise.evidence.materiality import is_near, material, score
from slipwise.evidence.residual_summary import ResidualSummary

COUNT = 10_000


def left(pads: float, girder: float = 1.0, held_out: float | None = None) -> ResidualSummary:
    """Mean squared residuals in fitted and held-out runs, alike unless told otherwise."""
    total = {"pads": pads * COUNT, "girder": girder * COUNT}
    held = {**total, "pads": (pads if held_out is None else held_out) * COUNT}
    return ResidualSummary(total, held, {name: (COUNT, COUNT) for name in total})


def test_what_does_not_hold_on_other_runs_is_worth_nothing() -> None:
    base = left(9.0)
    assert material(base, base, left(1.0))
    assert not material(base, base, left(1.0, held_out=9.0))
    assert score(base, left(1.0, held_out=12.0)) < 0.0 < score(base, left(1.0))


@pytest.mark.parametrize(("after", "worthy"), [(1.02, True), (6.0, False)])
def test_a_second_law_beside_a_huge_one_must_explain_nearly_all_that_is_left(after: float, worthy: bool) -> None:
    """Half of the little that a huge effect leaves may be its own wrong form; all of it is another effect."""
    assert material(left(400.0), left(8.0), left(after)) == worthy


@pytest.mark.parametrize(("touched", "worthy"), [(1.15, True), (1.6, False)])
def test_beside_an_effect_that_left_a_relation_alone_a_law_is_worth_there_what_it_is_alone(
    touched: float, worthy: bool
) -> None:
    """Had the first effect changed that relation, the second might be no more than its wrong form."""
    assert material(left(touched, girder=3.0), left(1.15, girder=1.0), left(1.0, girder=1.0)) == worthy


def test_what_repairs_only_what_the_effect_before_it_made_worse_is_no_effect() -> None:
    assert not material(left(2.0, girder=9.0), left(6.0, girder=1.0), left(2.0, girder=1.0))


def test_a_further_law_that_hardly_changes_anything_is_not_fitted_on_and_one_that_is_worth_a_name_is() -> None:
    base, first = left(9.0), left(8.0)
    assert not is_near(base, first, left(8.0))
    assert is_near(base, first, left(1.0)) and material(base, first, left(1.0))
