"""How much of an effect stays where every gauge may be a little off: one gauge must not stand for the sum of many.

A forward selection takes what helps most alone. Where four cells read half a per cent wrong and the pads sit unevenly,
one cell with two per cent may do nearly as well, and is accused. So the fit is asked once more, as a straight line from
where it ended: every effect that was found and every fault of a gauge at once, each with a normal prior about its
absence. It is half of what matters wide, and for what was found as wide as that is large. What the data tell apart
stays as it was, what they do not is shared out.

Source: Hoerl, Kennard (1970), Ridge regression, Technometrics 12; as a prior: Lindley, Smith (1972), Bayes estimates
for the linear model, Journal of the Royal Statistical Society B 34.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.materiality import Materiality
from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.diagnosis.importance import compute_share_of_channel
from slipwise.diagnosis.initial_grid import strengths
from slipwise.diagnosis.pairs import at_odds
from slipwise.diagnosis.rescreening import row_weights
from slipwise.diagnosis.row_subset import on_screen, rows_of
from slipwise.diagnosis.screening import Screened
from slipwise.errors import SlipwiseError
from slipwise.noise.independent_samples import sum_correlations
from slipwise.relations.measurement import apply_gauge_faults
from slipwise.relations.parameters import Free
from slipwise.relations.run_data import FitRun

#: Share of an independent sample that counts: the errors of a modeller, too small to be seen beside the noise, are the
#: same in all samples, and a gauge that takes them up is not known the better for it; assumed [1].
_COUNTED = 0.1
#: Usual size of an imperfection, over what matters [1].
_USUAL = 0.5


def shares_that_stay(
    found: Hypothesis, importances: Mapping[str, float], screened: Sequence[Screened], limits: Materiality
) -> dict[str, float]:
    """Return for every effect of a hypothesis the share of its size that stays beside small faults of all gauges [1].

    Args:
        found: the final hypothesis.
        importances: effect -> its importance over what matters.
        screened: candidates with their columns.
        limits: what matters.
    """
    if not found.objective.balanced:
        return dict.fromkeys(importances, 1.0)
    solution, weights = found.solution, row_weights(found) * np.sqrt(_COUNTED / _samples_for_one(found))
    kept = _linear_numbers(found)
    free = [solution.free[j] for j in kept]
    whose = {f"{t.label}.{p.name}": (t.effect.name, p) for t in found.terms for p in strengths(t.effect)}
    owned = {n: [i for i, f in enumerate(free) if f.key in whose and whose[f.key][0] == n] for n in importances}
    off = [solution.values[f.key] - float(whose[f.key][1].neutral or 0.0) if f.key in whose else 0.0 for f in free]
    places = np.array([size / f.scale for size, f in zip(off, free, strict=True)])
    precision = np.zeros(len(free))
    for name, own in owned.items():
        size = float(np.max(np.abs(places[own]), initial=0.0))
        width = max(_USUAL, importances[name])  # what was found may well be as large as it was found
        precision[own] = (max(importances[name], 1e-6) / (width * max(size, 1e-12))) ** 2
    small = _small_columns(found, screened, limits)
    objective = found.objective
    slopes = np.column_stack([on_screen(objective, solution.jacobian[:, kept]), *small]) * weights[:, None]
    precision = np.concatenate([precision, np.full(len(small), _USUAL**-2)])
    places = np.concatenate([places, np.zeros(len(small))])
    left = weights * on_screen(objective, solution.residuals.stacked(objective.fitted))
    normal = slopes.T @ slopes
    held = np.diag(precision + 1e-12 * float(np.diag(normal).max()))
    ended = places + np.linalg.solve(normal + held, -(slopes.T @ left) - precision * places)
    return {name: _share(places[own], ended[own]) for name, own in owned.items()}


def _samples_for_one(found: Hypothesis) -> Array:
    """Return how many screened rows stand for one independent one, row by row (q,): neighbours share their errors."""
    objective, left = found.objective, found.solution.residuals
    sums = {r: sum_correlations([b.value for b in left.blocks(r, objective.fitted)]) for r in objective.relations}
    return np.concatenate([np.full(rows, sums[r]) for r, rows in rows_of(objective).items()])


def _share(fitted: Array, ended: Array) -> float:
    """Return the share of the sizes of an effect's strengths that stays; all of it where it has none to lose."""
    whole = float(np.sum(np.abs(fitted)))
    return float(np.clip(np.sum(ended * np.sign(fitted)) / whole, 0.0, 1.0)) if whole > 0.0 else 1.0


def _linear_numbers(found: Hypothesis) -> list[int]:
    """Return places of the strengths, and of the base's numbers inside their bounds; a shape is no straight line."""
    ends = set(found.solution.at_bounds)
    labels = {t.label for t in found.terms}
    strong = {f"{t.label}.{p.name}" for t in found.terms for p in strengths(t.effect)}

    def is_linear(f: Free) -> bool:
        return f.key in strong or (f.key not in ends and f.key.rpartition(".")[0] not in labels)

    return [j for j, f in enumerate(found.solution.free) if is_linear(f)]


def _small_columns(found: Hypothesis, screened: Sequence[Screened], limits: Materiality) -> list[Array]:
    """Return what each further fault of a gauge changes in the residual when it is as large as what matters."""
    run = found.objective.run(found.objective.fitted[0])
    out: list[Array] = []
    for s in screened:
        if s.term.effect.port != "gauge" or any(at_odds(s.term, t) for t in found.terms):
            continue
        share = _share_changed(s, run)
        if share > 0.0 and s.length > 0.0:
            out.append(s.column * (s.length * limits.gauge / share))
    return out


def _share_changed(candidate: Screened, run: FitRun) -> float:
    """Return by how much a fault changes the channel that it changes most, see `compute_share_of_channel` [1]."""
    values = {f"{candidate.term.label}.{k}": v for k, v in candidate.values.items()}
    try:
        changed = apply_gauge_faults([candidate.term], values, run.record)
    except SlipwiseError:
        return 0.0
    shares = [
        compute_share_of_channel(changed[n] - run.record[n], run.record[n])
        for n in candidate.term.targets
        if n in run.record and n in changed
    ]
    return max(shares, default=0.0)
