"""The rows of the stacked residuals on which candidates are screened: all of them, or every so manieth sample.

Hundreds of columns are kept, and each would be as long as all runs together. Of a long campaign a thinned grid tells as
much; its rows are scaled so that sums of squares stay what they are. What is found is fitted to all samples.
"""

import numpy as np
from numpy.typing import NDArray

from slipwise.estimation.objective import Problem

Array = NDArray[np.float64]
#: Rows on which hundreds of columns may stand.
_MOST = 400_000


def thinning(problem: Problem) -> int:
    """Return the whole number of samples of which one is screened: 1 for an ordinary campaign."""
    rows = sum(problem.runs[i].judged[r].size for r in problem.relations for i in problem.fitted)
    return -(-rows // _MOST)


def on_screen(problem: Problem, stacked: Array) -> Array:
    """Return the screened rows of stacked residuals or slopes of the fitted runs, (m, ...) -> (q, ...), scaled."""
    step = thinning(problem)
    if step == 1:
        return stacked
    rows, start = list[NDArray[np.intp]](), 0
    for relation in problem.relations:
        for i in problem.fitted:
            shape = problem.runs[i].judged[relation].shape
            size = int(np.prod(shape, dtype=np.int64))
            rows.append(start + np.arange(size).reshape(shape)[::step].ravel())
            start += size
    return stacked[np.concatenate(rows)] * np.sqrt(step)


def rows_of(problem: Problem) -> dict[str, int]:
    """Return how many rows of each relation are screened, in the order in which they are stacked."""
    step = thinning(problem)
    out = dict[str, int]()
    for relation in problem.relations:
        judged = [problem.runs[i].judged[relation] for i in problem.fitted]
        out[relation] = sum(j[::step].size for j in judged)
    return out
