"""Curves and effects of the catalogue in one system: each is told beside the other, and neither for the other."""

from collections.abc import Sequence

import numpy as np
import pytest

from slipwise.discovery.curve_columns import CurveColumns
from slipwise.discovery.curve_posterior import Weighed, curve_by_blocks, list_alike, sizes_of, weigh
from slipwise.discovery.curve_system import CurveProducts, CurveSystem, make_curve_system, take_curve_products
from slipwise.residual_map.splines import SplineBasis, choose_knots
from slipwise.selection.averaged_rows import AveragedRows
from slipwise.selection.columns import CandidateColumn

COUNT, SIZE = 4000, 5.0
RNG = np.random.default_rng(3)
STATE, OTHER, BASE = RNG.uniform(-1.0, 1.0, (3, COUNT))
BLOCK = np.repeat(np.arange(4), COUNT // 4)
ROWS = AveragedRows((), ("pads",), np.zeros(COUNT, int), np.zeros(COUNT, int), np.ones(COUNT), np.array([float(COUNT)]))
SPLINES = SplineBasis((choose_knots(STATE, 10),), 1)
CURVE = CurveColumns(SPLINES, -SPLINES.columns([STATE]).toarray(), np.full(SPLINES.shape[0], 100))
LEVEL = np.array([30.0])


def effect(name: str, column: np.ndarray) -> CandidateColumn:
    return CandidateColumn(name, name, False, 0, "strength", {}, 0.0, True, 1.0, column.astype(np.float32))


def system(left: np.ndarray, columns: Sequence[CandidateColumn]) -> CurveSystem:
    measured = left + np.random.default_rng(4).standard_normal(COUNT)
    return make_curve_system(ROWS, measured, BASE[:, None], ["rig.mass"], columns, {}, (), BLOCK)


def products(of: CurveSystem) -> CurveProducts:
    return take_curve_products(of, "pads", CURVE.columns, SPLINES.shape)


def both_ways(of: CurveSystem) -> tuple[Weighed, Weighed]:
    """Give the likeliest model without the curve, and with it."""
    return weigh(of, None, {}, LEVEL), weigh(of, products(of), {}, LEVEL)


def test_a_curve_that_no_effect_makes_is_found_with_its_heights() -> None:
    of = system(SIZE * STATE**2, [effect("heating", OTHER)])
    without, found = both_ways(of)
    assert found.evidence - without.evidence > 20.0 and not found.active
    curve, excess = curve_by_blocks(of, found, products(of), CURVE)
    assert curve.carried_over() / excess == pytest.approx(1.0, abs=0.05)
    np.testing.assert_allclose(curve.heights(), SIZE * curve.knots[0] ** 2, atol=0.35)


def test_what_base_numbers_can_do_is_no_curve() -> None:
    of = make_curve_system(
        ROWS, SIZE * STATE + RNG.standard_normal(COUNT), STATE[:, None], ["rig.mass"], [effect("heating", OTHER)], {},
        (), BLOCK,
    )  # fmt: skip
    without, found = both_ways(of)
    assert found.evidence - without.evidence < 3.0


def test_an_effect_stands_beside_a_curve() -> None:
    of = system(SIZE * STATE**2 - 4.0 * OTHER, [effect("heating", OTHER), effect("run_in", BASE + STATE)])
    without, found = both_ways(of)
    assert found.evidence - without.evidence > 20.0
    (size,) = sizes_of(of, found).values()
    assert size == pytest.approx(4.0, rel=0.1)


def test_what_an_effect_makes_needs_no_curve_and_is_told_as_alike() -> None:
    of = system(-6.0 * STATE**2, [effect("heating", STATE**2), effect("run_in", OTHER)])
    without, found = both_ways(of)
    assert list(sizes_of(of, without).values()) == [pytest.approx(6.0, rel=0.05)]
    assert found.evidence < without.evidence
    alone = weigh(of, products(of), {}, LEVEL, moves=0)
    assert set(list_alike(of, alone, products(of))) == {"heating"}
    assert list_alike(of, alone, products(of))["heating"] > 0.9


def test_noise_is_no_curve() -> None:
    without, found = both_ways(system(np.zeros(COUNT), [effect("heating", OTHER)]))
    assert found.evidence - without.evidence < 3.0
