"""Slopes and residuals of hypotheses that are kept: each is as long as all runs together, and dozens are tried.

An ordinary campaign's are all kept. Of a long one those of the best are, as far as there is room; the others keep what
they found and are told by, and take their slopes anew where a search comes back to them.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from slipwise.estimation.least_squares import Solution, with_slopes
from slipwise.relations.table import Residuals
from slipwise.selection.hypothesis import Hypothesis

#: Bytes that slopes and residuals of all that was tried may take together.
ROOM = 400 * 2**20


def size_of(solution: Solution) -> int:
    """Return the bytes that slopes and residuals of a solution take."""
    return solution.jacobian.nbytes + solution.residuals.nbytes


def drop_jacobian(solution: Solution) -> Solution:
    """Return a solution without slopes and residuals."""
    return replace(solution, residuals=Residuals(), jacobian=np.empty((0, len(solution.free))))


def complete_jacobian(found: Hypothesis) -> Hypothesis:
    """Return a hypothesis with slopes and residuals, taken anew where they were not kept."""
    solution = found.solution
    if not solution.residuals.is_empty:
        return found
    solution = replace(solution, residuals=found.objective.residuals(solution.values))
    return replace(found, solution=with_slopes(found.objective, solution))


def lightened(
    tried: Sequence[Hypothesis], worth: Callable[[Hypothesis], float], room: int | None = None
) -> tuple[Hypothesis, ...]:
    """Return hypotheses of which the best keep slopes and residuals, as far as there is room.

    Args:
        tried: hypotheses.
        worth: by which the best are kept.
        room: bytes that they may take together; `ROOM` if not given.
    """
    left = ROOM if room is None else room
    sizes = [size_of(h.solution) for h in tried]
    if sum(sizes) <= left:
        return tuple(tried)
    out = list(tried)
    for place in sorted(range(len(tried)), key=lambda i: -worth(tried[i])):
        left -= sizes[place]
        if left < 0:
            out[place] = replace(tried[place], solution=drop_jacobian(tried[place].solution))
    return tuple(out)
