"""Best subset (abess) on the columns: base always in, size by the information criterion of its authors.

pip install abess scipy && python abess_subset.py FOLDER
"""

import sys
from pathlib import Path

import numpy as np
from abess.linear import LinearRegression
from columns import Problem, answer_all, named


def choose(problem: Problem) -> tuple[list[str], float | None]:
    """Give what best subset selection chooses."""
    kept = np.linalg.qr(problem.base)[0] * np.sqrt(problem.force.size)  # the base law's columns are nearly alike
    count = kept.shape[1]
    model = LinearRegression(
        support_size=range(count, count + min(12, problem.columns.shape[1]) + 1),
        always_select=list(range(count)), ic_type="gic", fit_intercept=False,
    )  # fmt: skip
    model.fit(np.column_stack([kept, problem.columns]), problem.force)
    return named(problem, np.asarray(model.coef_).ravel()[count:]), None


if __name__ == "__main__":
    answer_all(Path(sys.argv[1]), "abess", choose)
