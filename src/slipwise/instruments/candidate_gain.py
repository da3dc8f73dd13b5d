"""How much each candidate would add to a joint fit, by its columns alone: only the best few are then fitted."""

from collections.abc import Mapping, Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.instruments.joint_fit import EVIDENCE, LEAST_FLOOR, PER_NUMBER, Case, JointFit, off_rated
from slipwise.regression.normal_equations import (
    Block,
    build_equations,
    get_left_over,
    invert_regularised,
    weigh_equations,
)

#: Part of a column's power below which what is left of it is rounding [1].
_NOTHING = 1e-6


def supports(
    fitted: JointFit,
    case: Case,
    candidates: Sequence[Block],
    itself: Sequence[Mapping[str, float]],
    one_sided: Sequence[bool],
) -> Array:
    """Return about how much each candidate would add to the score, everything fitted again.

    Args:
        fitted: the fit so far.
        case: what is judged.
        candidates: their columns.
        itself: for each candidate what `noise_with_itself` gives.
        one_sided: whether its size cannot be below zero.
    """
    parts, first = build_equations([*fitted.columns, *candidates], fitted.left)
    known, count = int(first[len(fitted.columns)]), int(first[-1])
    weight = {n: 1.0 / s for n, s in fitted.scale.items()}
    squares, along = weigh_equations(parts, weight, count)
    if "mass" in fitted.stack.base:
        number = list(fitted.stack.base).index("mass")
        squares[number, number] += 1.0 / (case.mass_error * case.specimen.mass) ** 2 / EVIDENCE
    free = invert_regularised(squares[:known, :known])
    carried = free @ squares[:known, known:]
    apart, found = off_rated(case, fitted.constants), np.zeros(len(candidates))
    least = {n: LEAST_FLOOR * floor for n, floor in fitted.floor.items()}
    now = {n: max(float(np.sqrt(part.power / max(part.count, 1))), least[n]) for n, part in parts.items()}
    for k in range(len(candidates)):
        own = slice(int(first[len(fitted.columns) + k]), int(first[len(fitted.columns) + k + 1]))
        mine = slice(own.start - known, own.stop - known)
        left = squares[own, own] - squares[own, :known] @ carried[:, mine]
        # columns that are known already, but for rounding, get no step
        known_already = np.diag(left) <= _NOTHING * np.maximum(np.diag(squares)[own], 1e-300)
        if known_already.all():
            continue
        left[known_already], left[:, known_already] = 0.0, 0.0
        noise = sum(weight[n] ** 2 * power for n, power in itself[k].items())
        step = invert_regularised(left) @ (along[own] - carried[:, mine].T @ along[:known] - noise)
        if one_sided[k] and step[0] < 0.0:
            continue
        solution = np.zeros(count)
        solution[own] = step
        solution[:known] = free @ along[:known] - carried[:, mine] @ step
        for name, part in parts.items():
            after = max(float(np.sqrt(get_left_over(part, solution))), least[name])
            found[k] += EVIDENCE * part.count * np.log(now[name] / after)
        if "mass" in fitted.stack.base:
            moved = solution[list(fitted.stack.base).index("mass")] / (case.mass_error * case.specimen.mass)
            found[k] += 0.5 * (apart**2 - (apart - moved) ** 2)
        # what shrinking its own noise would gain is no evidence, and every free number costs
        found[k] -= EVIDENCE * noise * float(np.sum(step)) + PER_NUMBER * (own.stop - own.start)
    return found
