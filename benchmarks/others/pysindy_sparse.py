"""PySINDy's sequentially thresholded least squares on the columns, with the base law's columns beside them.

    pip install pysindy && python pysindy_sparse.py FOLDER

Its threshold is the share of a force that is material; the base law's columns are fitted before, so that no threshold
takes them out.
"""

import sys
from pathlib import Path

import numpy as np
from columns import MATERIAL, Problem, answer_all, named, without_base
from pysindy.optimizers import STLSQ


def choose(problem: Problem) -> tuple[list[str], float | None]:
    """Give what is left above the threshold."""
    force, columns = without_base(problem)
    fit = STLSQ(threshold=MATERIAL, alpha=1e-6).fit(columns, force[:, None])
    return named(problem, np.asarray(fit.coef_).ravel()), None


if __name__ == "__main__":
    answer_all(Path(sys.argv[1]), "pysindy", choose)
