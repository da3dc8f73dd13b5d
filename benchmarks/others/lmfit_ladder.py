"""A ladder of lmfit fits: from the base law, add the effect whose fit has the lowest AIC, until AIC falls no more.

    pip install lmfit scipy && python lmfit_ladder.py FOLDER

AIC counts rows as independent, which residuals of a wrong law are not; that is what its users do. The probability is
the Akaike weight of the ladder's end among the fits of its last step.
"""

import sys
from pathlib import Path

import lmfit
import numpy as np
from columns import Problem, answer_all, named, without_base

STEPS = 6


def fit(force: np.ndarray, columns: np.ndarray, chosen: list[int]) -> lmfit.minimizer.MinimizerResult:
    """Fit the sizes of the chosen columns, all without what changes of the base law can do."""
    table = columns[:, chosen]
    values = lmfit.Parameters()
    for i in range(len(chosen)):
        values.add(f"c{i}", value=0.0)
    return lmfit.minimize(lambda p: force - table @ np.array(list(p.valuesdict().values())), values,
                          method="least_squares", jac=lambda p: -table)  # fmt: skip


def choose(problem: Problem) -> tuple[list[str], float | None]:
    """Climb the ladder."""
    force, columns = without_base(problem)
    chosen: list[int] = []
    least, chance = force.size * np.log(np.mean(force**2)), None  # AIC as lmfit counts it, of no column
    sizes = np.zeros(columns.shape[1])
    for _ in range(STEPS):
        fits = {i: fit(force, columns, [*chosen, i]) for i in range(columns.shape[1]) if i not in chosen}
        aic = np.array([least, *(one.aic for one in fits.values())])
        nearest = min(fits, key=lambda i: fits[i].aic)
        if fits[nearest].aic >= least:
            break
        weights = np.exp(-0.5 * (aic - aic.min()))
        chance = float(weights.max() / weights.sum())
        chosen, least = [*chosen, nearest], fits[nearest].aic
        sizes[chosen] = list(fits[nearest].params.valuesdict().values())
    return named(problem, sizes), chance


if __name__ == "__main__":
    answer_all(Path(sys.argv[1]), "lmfit", choose)
