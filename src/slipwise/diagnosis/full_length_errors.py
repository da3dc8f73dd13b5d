"""The held-out runs whole, where a campaign is too long to be fitted whole: what stretches have shown is confirmed.

Nothing is fitted here, and slopes are what takes memory: each run is predicted from its first sample to its last. It
starts as it was put on its pads; what the runs before it have worn or heated is not carried over, for they were cut.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from slipwise.campaign import Campaign
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.estimation.objective import make_objective
from slipwise.relations.run_data import FitRun, fit_runs
from slipwise.selection.hypothesis import Hypothesis


def compute_full_length_errors(
    uncut: Campaign, invalid: InvalidSamples, fitted: Campaign, found: Sequence[Hypothesis]
) -> dict[str, tuple[float, ...]]:
    """Return the held-out error of every balance over all samples [floors], relation -> one of each hypothesis.

    Args:
        uncut: the campaign as it was before stretches were cut from it.
        invalid: run -> channel -> samples (n,) at which it is no measurement.
        fitted: what was fitted, with the logger and the rig as the fit has them.
        found: hypotheses.

    Returns:
        Nothing where every held-out run was judged whole.
    """
    lengths = {run.name: len(run.record) for run in fitted.runs}
    longer = tuple(run for run in uncut.with_role("holdout") if len(run.record) > lengths[run.name])
    squares, counts = dict[str, list[float]](), dict[str, int]()
    for one in longer:  # one after another: two at once would be twice the memory
        (run,) = fit_runs(replace(fitted, runs=(one,)), {one.name: invalid.get(one.name, {})})
        for place, hypothesis in enumerate(found):
            for relation, square in _squares(run, hypothesis).items():
                squares.setdefault(relation, [0.0] * len(found))[place] += square
        for relation in squares:
            counts[relation] = counts.get(relation, 0) + int(np.count_nonzero(run.judged[relation]))
    return {r: tuple(float(np.sqrt(s / counts[r])) for s in sums) for r, sums in squares.items() if counts[r]}


def _squares(run: FitRun, found: Hypothesis) -> dict[str, float]:
    """Return the squared residuals of a whole run, weighed as those of the hypothesis are, relation -> sum."""
    values, one = found.solution.values, found.objective.run(0)
    # gauges are as noisy as all runs together have shown
    objective = make_objective(
        [replace(run, fine=one.fine, noise=one.noise)], found.objective.specimen, found.objective.terms
    )
    objective = objective.with_yaw() if found.objective.yaw else objective
    left = objective.weigh(values).residuals(values)
    return {relation: left.squares(relation, [0]) for relation in objective.relations}
