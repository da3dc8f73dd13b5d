"""Which faults a system of equations shows and tells apart, by which unknowns stand in which equations alone.

The part of the equations that has more equations than unknowns (overdetermined, the Dulmage-Mendelsohn part M+) is what
can be checked. A fault is detectable where an equation that it breaks lies there; it is isolable from another where one
still does after the equations of the other were left out.

Source: Dulmage, Mendelsohn (1958), Canadian Journal of Mathematics 10; Krysander, Frisk (2008), Sensor placement for
fault diagnosis, IEEE Transactions on Systems, Man, and Cybernetics A 38; Blanke et al., Diagnosis and Fault-Tolerant
Control, 2016, chapter 5.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_bipartite_matching

from slipwise.short_repr import short_repr

Flags = NDArray[np.bool_]


@short_repr
@dataclass(frozen=True)
class Diagnosability:
    """What can be shown of faults, and told apart.

    Attributes:
        detectable: (f,) whether a fault can be seen.
        isolable: (f, f) whether the fault of the row stays visible where that of the column is allowed for; False on
            the diagonal.
    """

    detectable: Flags
    isolable: Flags


def find_overdetermined(incidence: Flags) -> Flags:
    """Return the equations (e,) of the overdetermined part.

    They are those that an alternating path reaches from an equation that a largest matching leaves without an unknown.

    Args:
        incidence: (e, u) whether an unknown stands in an equation.
    """
    if not incidence.size:
        return np.ones(len(incidence), bool)
    matched = maximum_bipartite_matching(csr_array(incidence), perm_type="column")
    holder = np.full(incidence.shape[1], -1)
    holder[matched[matched >= 0]] = np.flatnonzero(matched >= 0)
    reached = matched < 0
    while True:
        held = holder[incidence[reached].any(axis=0)]
        more = reached.copy()
        more[held] = True  # every unknown of a reached equation is matched, or the matching would not be a largest one
        if np.array_equal(more, reached):
            return reached
        reached = more


def analyse_structure(incidence: Flags, broken: Flags) -> Diagnosability:
    """Return which faults can be seen and told apart.

    Args:
        incidence: (e, u) whether an unknown stands in an equation.
        broken: (e, f) whether an equation does not hold where there is the fault.
    """
    count = broken.shape[1]
    detectable = np.asarray(broken[find_overdetermined(incidence)].any(axis=0))
    isolable = np.zeros((count, count), bool)
    alike: dict[bytes, NDArray[np.intp]] = {}
    for other in range(count):
        kept = ~broken[:, other]
        key = kept.tobytes()
        if key not in alike:
            alike[key] = np.flatnonzero(broken[kept][find_overdetermined(incidence[kept])].any(axis=0))
        isolable[alike[key], other] = True
    np.fill_diagonal(isolable, False)
    return Diagnosability(detectable, isolable)
