"""The noise of the relations follows from the numbers by which it is weighed, whatever it was weighed by before."""

import numpy as np

from hypotheses import base


def test_weighing_forgets_what_was_weighed_before() -> None:
    fit = base()
    values = dict(fit.solution.values)
    other = {key: 1.3 * value for key, value in values.items()}
    once, again = fit.objective.weigh(values), fit.objective.weigh(other, finer=False).weigh(values)
    assert any(np.abs(lost).max() > 0.0 for lost in once.weighing.lost)
    for name in ("lost", "bounds"):
        for one, two in zip(getattr(once.weighing, name), getattr(again.weighing, name), strict=True):
            np.testing.assert_array_equal(one, two)
    for relation, sigmas in once.weighing.sigmas.items():
        for one, two in zip(sigmas, again.weighing.sigmas[relation], strict=True):
            np.testing.assert_array_equal(one, two)
