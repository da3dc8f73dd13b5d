"""What could stand in the place of an effect that was found: candidates that do nearly the same beside all others."""

from collections.abc import Sequence

import numpy as np

from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.diagnosis.initial_grid import strengths
from slipwise.diagnosis.rescreening import row_weights
from slipwise.diagnosis.row_subset import on_screen
from slipwise.diagnosis.screening import Screened
from slipwise.regression.projection import basis_of, project_away

#: A substitute that a straight line sees explain this share of what an effect explains is worth a fit [1].
_NEARLY = 0.6


def substitutes(whole: Hypothesis, name: str, screened: Sequence[Screened]) -> list[Screened]:
    """Return candidates that nearly explain what an effect explains, beside all others of a hypothesis; best first.

    Args:
        whole: the hypothesis.
        name: of one of its effects.
        screened: candidates against the base.
    """
    terms = [t for t in whole.terms if t.effect.name == name]
    labels = {t.label for t in terms}
    solution = whole.solution
    stays = np.array([f.key.rpartition(".")[0] not in labels for f in solution.free], dtype=bool)
    if stays.all():
        return []
    weights = row_weights(whole)
    slopes = on_screen(whole.objective, solution.jacobian)
    basis = basis_of(slopes[:, stays] * weights[:, None])
    absent = {f"{t.label}.{p.name}": float(p.neutral or 0.0) for t in terms for p in strengths(t.effect)}
    own = [f for f, kept in zip(solution.free, stays, strict=True) if not kept]
    amounts = np.array([(solution.values[f.key] - absent.get(f.key, solution.values[f.key])) / f.scale for f in own])
    # what the effect does, the others making up for what they can
    step = project_away(basis, weights * (slopes[:, ~stays] @ amounts))
    total = float(step @ step)
    out: list[tuple[float, Screened]] = []
    for s in (s for s in screened if s.term.effect.name not in whole.names):
        column = project_away(basis, weights * s.column)
        length = float(column @ column)
        explained = float(step @ column) ** 2 / length if length > 1e-6 * float(s.column @ s.column) else 0.0
        if explained > _NEARLY * total:
            out.append((explained, s))
    return [s for _, s in sorted(out, key=lambda pair: -pair[0])]
