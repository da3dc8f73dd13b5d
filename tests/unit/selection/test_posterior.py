"""The posterior on made columns, whose causes are known."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.arrays import Array
from slipwise.evidence.posterior import Posterior, compute_posterior
from slipwise.evidence.statistics import scale_columns
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.columns import CandidateColumn
from slipwise.selection.statistics import compute_statistics

ROWS = 3000


def rows_of(count: int = ROWS) -> AveragedRows:
    """Give rows of one relation."""
    zeros = np.zeros(count, np.int64)
    return AveragedRows((), ("pads",), zeros, zeros, np.ones(count), np.array([float(count)]))


def column(label: str, values: Array, *, form: int = 0, gauge: bool = False, two_sided: bool = True) -> CandidateColumn:
    """Give a column that changes the residual as it stands by one limit of materiality."""
    effect = label.partition("[")[0]
    return CandidateColumn(label, effect, gauge, form, "size", {}, 0.0, two_sided, 1.0, values.astype(np.float32))


def waves(count: int, seed: int = 0) -> Array:
    """Give columns (q, count) that hardly resemble each other, of two floors each."""
    return 2.0 * np.random.default_rng(seed).standard_normal((ROWS, count))


def posterior_of(
    left: Array, slopes: Array, columns: list[CandidateColumn], tolerances: dict | None = None
) -> Posterior:
    """Give the posterior of a residual, all slopes being numbers of the base."""
    of_base = np.ones(slopes.shape[1], bool)
    statistics = compute_statistics(rows_of(), left, left, slopes, of_base, columns)
    return compute_posterior(statistics, columns, tolerances or {})


def chance(found: Posterior, label: str) -> float:
    """Give how likely a term is more than a trifle."""
    return float(np.mean(found.sizes[:, found.labels.index(label)] > 0.0))


def noise(seed: int = 9) -> Array:
    """Give noise of one floor."""
    return np.random.default_rng(seed).standard_normal(ROWS)


def test_noise_alone_has_no_cause() -> None:
    x = waves(8)
    found = posterior_of(noise(), waves(2, 5), [column(f"effect{i}", x[:, i]) for i in range(8)])
    assert max(chance(found, label) for label in found.labels) < 0.1


def test_two_causes_are_found_with_their_sizes() -> None:
    x = waves(8)
    left = noise() - 3.0 * x[:, 1] - 6.0 * x[:, 4]  # what is left is what the model lacks, the other way round
    found = posterior_of(left, waves(2, 5), [column(f"effect{i}", x[:, i]) for i in range(8)])
    assert [label for label in found.labels if chance(found, label) > 0.5] == ["effect1", "effect4"]
    assert found.sizes[:, 1].mean() == pytest.approx(3.0, rel=0.1)
    assert found.sizes[:, 4].mean() == pytest.approx(6.0, rel=0.1)
    assert found.seen[:, 1].mean() == pytest.approx(6.0, rel=0.1)  # three limits of two floors


def test_what_two_columns_explain_alike_is_shared_between_them() -> None:
    x = waves(4)
    x[:, 1] = x[:, 0] + 0.002 * x[:, 1]
    found = posterior_of(noise() - 4.0 * x[:, 0], waves(1, 5), [column(f"effect{i}", x[:, i]) for i in range(4)])
    one, other = chance(found, "effect0"), chance(found, "effect1")
    assert one + other == pytest.approx(1.0, abs=0.1)
    assert min(one, other) > 0.2


def test_many_trifles_are_no_cause() -> None:
    x = waves(40)
    sizes = 0.12 * np.random.default_rng(3).standard_normal(40)
    left = noise() - x @ sizes  # 1.5 floors together
    found = posterior_of(left, waves(1, 5), [column(f"effect{i}", x[:, i]) for i in range(40)])
    assert max(chance(found, label) for label in found.labels) < 0.3


def test_what_the_base_can_do_is_not_seen() -> None:
    x = waves(3)
    slopes = np.column_stack([x[:, 0] + 0.05 * x[:, 2]])
    found = posterior_of(noise() - 5.0 * x[:, 0], slopes, [column(f"effect{i}", x[:, i]) for i in range(2)])
    at = found.labels.index("effect0")
    assert chance(found, "effect0") < 0.5 or found.seen[:, at].max() < 1.5


def test_a_rated_number_keeps_its_tolerance() -> None:
    x = waves(2)
    left = noise() - 5.0 * x[:, 0]
    columns = [column("effect0", x[:, 0] + 0.1 * x[:, 1])]
    assert chance(posterior_of(left, x[:, :1], columns), "effect0") < 0.2
    assert chance(posterior_of(left, x[:, :1], columns, {0: (0.0, 0.01)}), "effect0") > 0.8


def test_a_strength_of_one_sign_is_not_found_with_the_other() -> None:
    x = waves(2)
    columns = [column("effect0", x[:, 0], two_sided=False), column("effect1", x[:, 1])]
    wrong = posterior_of(noise() + 5.0 * x[:, 0], waves(1, 5), columns)
    assert chance(wrong, "effect0") < 0.1
    assert np.mean(wrong.forms[:, 0] != -1) < 0.1  # nor does it take a place where it can explain nothing
    assert chance(posterior_of(noise() - 5.0 * x[:, 0], waves(1, 5), columns), "effect0") > 0.9


def test_the_form_that_fits_is_found() -> None:
    x = waves(4)
    columns = [column("effect", x[:, i], form=i) for i in range(3)] + [column("other", x[:, 3])]
    found = posterior_of(noise() - 4.0 * x[:, 2], waves(1, 5), columns)
    forms = found.forms[:, found.labels.index("effect")]
    assert np.mean(forms == 2) > 0.9


def test_explanations_that_share_nothing_are_weighed_although_no_step_leads_from_one_to_the_other() -> None:
    x = waves(3)
    both = 4.0 * x[:, 0] + 4.0 * x[:, 1]
    columns = [column("pair0", x[:, 0]), column("pair1", x[:, 1]), column("single", both / 5.0)]
    found = posterior_of(noise() - both, waves(1, 5), columns)
    assert chance(found, "single") > 0.9  # one cause is likelier than two
    assert chance(found, "pair0") < 0.2


def test_scaled_columns_give_what_columns_taken_so_would() -> None:
    x = waves(3)
    left, slopes = noise() - 3.0 * x[:, 1], waves(1, 5)
    factors = np.array([2.0, 0.5, 1.0])
    raw = [column(f"effect{i}", x[:, i]) for i in range(3)]
    scaled = [column(f"effect{i}", factors[i] * x[:, i]) for i in range(3)]
    of_base = np.ones(1, bool)
    one = scale_columns(compute_statistics(rows_of(), left, left, slopes, of_base, raw), factors)
    other = compute_statistics(rows_of(), left, left, slopes, of_base, scaled)
    assert np.allclose(one.products, other.products, rtol=1e-5)
    assert np.allclose(one.pulls, other.pulls, rtol=1e-5, atol=1e-3)


def test_what_excludes_each_other_is_never_in_one_model() -> None:
    x = waves(3)
    columns = [column(f"effect{i}", x[:, i]) for i in range(3)]
    left, of_base, slopes = noise() - 4.0 * x[:, 0] - 4.0 * x[:, 1], np.ones(1, bool), waves(1, 5)
    statistics = compute_statistics(rows_of(), left, left, slopes, of_base, columns)
    free = compute_posterior(statistics, columns, {})
    apart = compute_posterior(statistics, columns, {}, {("effect0", "effect1"), ("effect1", "effect0")})
    together = [np.mean((p.sizes[:, 0] > 0.0) & (p.sizes[:, 1] > 0.0)) for p in (free, apart)]
    assert together == [1.0, 0.0]
    assert max(chance(apart, "effect0"), chance(apart, "effect1")) > 0.9


def test_of_two_that_explain_alike_the_one_that_was_fitted_with_fewer_numbers_is_likelier() -> None:
    x = waves(2)
    few, many = column("few", x[:, 0]), replace(column("many", x[:, 0]), numbers=3)
    found = posterior_of(noise() - 4.0 * x[:, 0], waves(1, 5), [few, many])
    assert chance(found, "few") > 0.9 > 0.1 > chance(found, "many")
