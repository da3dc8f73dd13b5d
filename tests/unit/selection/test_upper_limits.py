"""Upper limits of what was not named, on made columns whose true sizes are known."""

import numpy as np
import pytest

from slipwise.selection.units import Moved
from slipwise.selection.upper_limits import compute_upper_limits
from weighed import STRENGTHS, column, noise, terms_of, waves, weigh

NAMES = tuple(STRENGTHS)


def test_sizes_of_imperfections_lie_below_their_limits_about_as_often_as_is_said() -> None:
    below, count = 0, 0
    for seed in range(6):
        x = waves(5, seed)
        true = 0.6 * np.abs(np.random.default_rng(seed).standard_normal(5))
        columns = [column(name, x[:, i]) for i, name in enumerate(NAMES)]
        limits = compute_upper_limits(weigh(noise(seed) - x @ true, columns), terms_of(columns))
        below += sum(limits[name].size > size for name, size in zip(NAMES, true, strict=True))
        count += len(true)
    assert below >= 0.9 * count
    assert all(limit.measured for limit in limits.values())


def test_a_limit_is_not_held_down_by_what_imperfections_usually_are() -> None:
    x = waves(2)
    columns = [column("heating", x[:, 0]), column("run_in", 1e-4 * x[:, 1])]
    limits = compute_upper_limits(weigh(noise(), columns), terms_of(columns))
    assert limits["heating"].measured and not limits["heating"].may_matter
    assert limits["heating"].size < 0.4
    assert not limits["run_in"].measured and limits["run_in"].may_matter
    assert limits["run_in"].as_json()["size"] is None and limits["heating"].as_json()["size"] < 1.0
    assert list(limits) == ["run_in", "heating"], "the largest first"


def test_forms_that_look_either_way_are_one_size() -> None:
    x = waves(2)
    one = [column("heating", x[:, 0])]
    both = [*one, column("heating", -x[:, 0], form=1, unit=-0.02)]
    alone, together = (compute_upper_limits(weigh(noise(), c), terms_of(c))["heating"] for c in (one, both))
    assert together.size == pytest.approx(alone.size, rel=0.25)


def test_a_limit_is_told_in_its_own_unit_and_in_what_it_moves() -> None:
    columns = [column("heating", waves(1)[:, 0], unit=0.02)]
    moved = Moved(0.5, {"peak_slip": -1e-4, "energy": 3.0})  # half of what matters moves this much
    limit = compute_upper_limits(weigh(noise(), columns, {("heating", "share"): moved}), terms_of(columns))["heating"]
    assert limit.value == pytest.approx(0.02 * limit.size, rel=1e-6)
    assert limit.responses["peak_slip"] == pytest.approx(-2e-4 * limit.size, rel=1e-6)
    assert limit.responses["energy"] == pytest.approx(6.0 * limit.size, rel=1e-6)
    assert limit.as_json()["of"] == "heating"


def test_what_was_named_has_no_limit() -> None:
    x = waves(2)
    columns = [column("heating", x[:, 0]), column("run_in", x[:, 1])]
    assert set(compute_upper_limits(weigh(noise(), columns), terms_of(columns), ["run_in"])) == {"heating"}
