"""When a step is kept: by what it does to motions that it was not fitted to."""

import numpy as np
import pytest

from slipwise.evidence.acceptance import LEAST, does_worsen, is_kept
from slipwise.evidence.residual_summary import ResidualSummary
from slipwise.evidence.score import compute_lead, compute_score, find_largest_drop

COUNT = 10_000


def left(
    pads: float, girder: float = 1.0, fitted: float | None = None, constants: int = 20, **others: float
) -> ResidualSummary:
    """Mean squared residuals of left-out motions, and of the fitted ones where those are others."""
    levels = {"pads": pads, "girder": girder, **others}
    total = {name: level * COUNT for name, level in levels.items()}
    own = {**total, "pads": (pads if fitted is None else fitted) * COUNT}
    blocks = {name: np.full(100, level * COUNT / 100) for name, level in levels.items()}
    return ResidualSummary(
        own, total, dict.fromkeys(total, np.inf), dict.fromkeys(total, (COUNT, 0)), constants, blocks
    )


def test_what_does_not_hold_on_motions_left_out_is_not_kept() -> None:
    base = left(9.0)
    assert is_kept(base, base, left(1.0), LEAST.law)
    assert not is_kept(base, base, left(9.5, fitted=1.0), LEAST.law)
    assert compute_score(base, left(12.0, fitted=1.0)) < 0.0 < compute_score(base, left(1.0))


def test_held_out_runs_take_no_part() -> None:
    """They are infinitely bad here, and nothing becomes infinite."""
    assert np.isfinite(compute_score(left(9.0), left(1.0)))


@pytest.mark.parametrize(("after", "kept"), [(7.8, False), (7.0, True)])
def test_a_step_must_take_a_share_of_what_is_left(after: float, kept: bool) -> None:
    assert is_kept(left(400.0), left(8.0), left(after), LEAST.law) == kept


def test_a_balance_counts_by_what_is_left_of_it() -> None:
    """A tenth of a floor in a quiet balance outweighs a percent of thirty floors in a loud one."""
    before = left(900.0, girder=1.2)
    quiet, loud = left(900.0, girder=1.0), left(891.0, girder=1.2)
    assert compute_score(before, quiet) > 10.0 * compute_score(before, loud)


def test_what_repairs_only_what_the_effect_before_it_made_worse_is_not_kept() -> None:
    assert not is_kept(left(2.0, girder=9.0), left(6.0, girder=1.0), left(2.0, girder=1.0), LEAST.law)


def test_constants_cost_what_chance_would_gain_with_them() -> None:
    assert compute_score(left(1.0), left(0.9999, constants=22)) < 0.0


def test_a_step_that_repairs_one_balance_at_the_cost_of_another_worsens() -> None:
    assert does_worsen(left(9.0, girder=1.0), left(1.0, girder=1.2))
    assert not does_worsen(left(9.0, girder=1.0), left(1.0, girder=1.01))
    assert not does_worsen(left(9.0, girder=4.0), left(1.0, girder=4.4)), "something else is hidden there"
    assert does_worsen(left(9.0, girder=4.0), left(8.0, girder=4.4))
    assert find_largest_drop(left(9.0), left(3.0)) == (pytest.approx(2.0 / 3.0), "pads")


def test_a_lead_is_counted_in_standard_errors_of_blocks_of_time() -> None:
    """The same gain from one block alone is one standard error, from every block many."""
    rng = np.random.default_rng(1)
    one, every = left(1.0), left(1.0)
    single = np.array(one.blocks["pads"])
    single[0] += 1000.0
    spread = every.blocks["pads"] + 10.0 + rng.normal(0.0, 5.0, 100)
    others = [
        ResidualSummary(one.fitted, one.left_out, one.held_out, one.counts, 20, {**one.blocks, "pads": blocks})
        for blocks in (single, spread)
    ]
    alone, throughout = (compute_lead(one, other) for other in others)
    assert alone == pytest.approx(1.0, abs=0.1)
    assert throughout > 10.0


def test_warps_are_one_relation_that_a_step_may_make_worse() -> None:
    """One pad that stands high moves all of them: of three, the first step leaves two worse than they were."""
    before, after = left(1.0, warp=1900.0, warp_2=25.0, warp_3=4.0), left(1.0, warp=10.0, warp_2=30.0, warp_3=100.0)
    assert not does_worsen(before, after)
    assert does_worsen(before, left(1.0, warp=1900.0, warp_2=25.0, warp_3=100.0))


def test_a_relation_below_its_noise_has_nothing_to_explain() -> None:
    """A record of three pads without a filter, whose noise at reversals was thought too large."""
    assert not is_kept(left(0.61, girder=1.14), left(0.61, girder=1.14), left(0.53, girder=1.14), LEAST.law)
    assert is_kept(left(1.2, girder=1.14), left(1.2, girder=1.14), left(0.9, girder=1.14), LEAST.law)
