"""A ladder of lmfit fits: from the base law, add the effect whose fit has the lowest AIC, until AIC falls no more.

    pip install lmfit scipy && python lmfit_ladder.py FOLDER

AIC counts rows as independent, which residuals of a wrong law are not; that is what its users do. The probability is
the Akaike weight of the ladder's end among the fits of its last step.
"""

import sys
from pathlib import Path

import lmfit
import numpy as np
from columns import Problem, answer_all, named

STEPS = 6


def fit(problem: Problem, chosen: list[int]) -> lmfit.minimizer.MinimizerResult:
    """Fit the base law's changes and the sizes of the chosen columns."""
    q = np.linalg.qr(problem.base)[0] * np.sqrt(problem.force.size)
    table = np.column_stack([q, problem.columns[:, chosen]])
    values = lmfit.Parameters()
    for i in range(table.shape[1]):
        values.add(f"c{i}", value=0.0)
    return lmfit.minimize(lambda p: problem.force - table @ np.array(list(p.valuesdict().values())), values,
                          method="least_squares", jac=lambda p: -table)  # fmt: skip


def choose(problem: Problem) -> tuple[list[str], float | None]:
    """Climb the ladder."""
    chosen: list[int] = []
    best = fit(problem, chosen)
    chance = None
    for _ in range(STEPS):
        fits = {i: fit(problem, [*chosen, i]) for i in range(problem.columns.shape[1]) if i not in chosen}
        aic = np.array([best.aic, *(one.aic for one in fits.values())])
        weights = np.exp(-0.5 * (aic - aic.min()))
        nearest = min(fits, key=lambda i: fits[i].aic)
        if fits[nearest].aic >= best.aic:
            break
        chance = float(weights.max() / weights.sum())
        chosen, best = [*chosen, nearest], fits[nearest]
    sizes = np.zeros(problem.columns.shape[1])
    sizes[chosen] = list(best.params.valuesdict().values())[len(best.params) - len(chosen) :]
    return named(problem, sizes), chance


if __name__ == "__main__":
    answer_all(Path(sys.argv[1]), "lmfit", choose)
