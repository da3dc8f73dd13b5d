"""Mean friction of an unseen run, and how far one run may be from another."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from slipwise.estimation.prediction_interval import predicted_friction


def _fit(ratios: list[float], held: float) -> Any:
    """Runs whose measured friction is 100 N times a ratio, while the law says 100 N."""
    velocity = np.array([0.1, 0.1, -0.1, -0.1])
    said = 100.0 * np.sign(velocity)[:, None]
    roles = [*("fit" for _ in ratios), "holdout"]
    runs = [
        SimpleNamespace(name=f"run{i}", role=role, sliding=np.ones(4, bool), velocity=velocity, force=ratio * said)
        for i, (role, ratio) in enumerate(zip(roles, [*ratios, held], strict=True))
    ]
    problem = SimpleNamespace(runs=runs, fitted=list(range(len(ratios))), held_out=[len(ratios)])
    residuals = SimpleNamespace(pad_forces=[said] * len(runs))
    return cast(Any, SimpleNamespace(problem=problem, solution=SimpleNamespace(residuals=residuals)))


def test_an_unseen_run_like_the_others_is_foretold():
    last = predicted_friction(_fit([0.98, 1.0, 1.02], 1.01))[-1]
    assert (last.measured, last.said) == (pytest.approx(101.0), pytest.approx(100.0))
    # t(0.975, 2) = 4.303, scatter 0.02, one further run: 4.303 * 0.02 * sqrt(1 + 1/3)
    assert last.high - last.low == pytest.approx(200.0 * 4.3027 * 0.02 * np.sqrt(4.0 / 3.0), rel=1e-4)
    assert last.inside


def test_an_unseen_run_far_from_the_others_is_not():
    assert predicted_friction(_fit([0.98, 1.0, 1.02], 1.3))[-1].inside is False


def test_one_fitted_run_says_nothing_of_scatter():
    assert predicted_friction(_fit([1.0], 1.3))[-1].inside is None
