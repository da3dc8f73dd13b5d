"""The rows of the stacked residuals on which candidates are screened: all of them, or every n-th sample.

Hundreds of columns are kept, and each would be as long as all runs together. Of a long campaign a thinned grid tells as
much; its rows are scaled so that sums of squares stay what they are. What is found is fitted to all samples.
"""

import numpy as np

from slipwise.arrays import Array
from slipwise.estimation.objective import Objective

#: Rows on which hundreds of columns may stand.
_MOST = 400_000


def thinning(objective: Objective) -> int:
    """Return the whole number of samples of which one is screened: 1 for an ordinary campaign."""
    return -(-sum(of.value.size for of in objective.layout.blocks(runs=objective.fitted)) // _MOST)


def on_screen(objective: Objective, stacked: Array) -> Array:
    """Return the screened rows of stacked residuals or slopes of the fitted runs, (m, ...) -> (q, ...), scaled."""
    step = thinning(objective)
    if step == 1:
        return stacked
    every = objective.layout.rows(objective.fitted)
    rows = [np.arange(at.start, at.stop).reshape(of.value.shape)[::step].ravel() for at, of in every]
    return stacked[np.concatenate(rows)] * np.sqrt(step)


def rows_of(objective: Objective) -> dict[str, int]:
    """Return how many rows of each relation are screened, in the order in which they are stacked."""
    step = thinning(objective)
    out = dict[str, int]()
    for of in objective.layout.blocks(runs=objective.fitted):
        out[of.relation] = out.get(of.relation, 0) + of.value[::step].size
    return out
