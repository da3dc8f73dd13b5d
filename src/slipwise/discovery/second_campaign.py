"""A discovery with the data of further campaigns: one law, whose form is common and whose size each specimen has.

The law that was found in the first is fitted in each of the others, everything else of these free as well. Constants of
the form are weighed by their errors, and the law with these is held against every campaign again: what its strength is
there, and whether it holds.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from slipwise.diagnosis.result import Diagnosis
from slipwise.discovery.effect_file import can_be_written, write_law
from slipwise.discovery.law import Law, LawConstant, Origin
from slipwise.discovery.law_objective import STRENGTH
from slipwise.discovery.law_test import LawTest, hold_law_against
from slipwise.discovery.result import Discovery
from slipwise.effects import find_effect
from slipwise.estimation.intervals import compute_halfwidth, compute_standard_error

#: A law of which a campaign says one of these takes part in its constants.
_THERE = ("as it stands", "with another size", "with other constants")


def add_campaigns(found: Discovery, first: Diagnosis, others: Sequence[Diagnosis]) -> Discovery:
    """Return a discovery whose first law is that of several campaigns, held against each of them.

    Args:
        found: in the first campaign; one that claims no law, or one that no effect can be, stays as it is.
        first: the diagnosis of that campaign.
        others: of the other campaigns.
    """
    if not others or found.evidence not in ("law", "state") or not found.laws or not can_be_written(found.laws[0]):
        return found
    law = found.laws[0]
    alone = [_held(law, found.origin, other) for other in others]
    kept = [test for test in alone if test.holds in _THERE]
    if not kept:
        return replace(found, campaigns=tuple(alone))
    common = replace(law, constants=tuple(_weighed(c, kept) for c in law.constants))
    tests = tuple(_held(common, found.origin, each) for each in (first, *others))
    return replace(found, laws=(common, *found.laws[1:]), campaigns=tests)


def _held(law: Law, origin: Origin, found: Diagnosis) -> LawTest:
    with TemporaryDirectory() as folder:  # an effect is compiled from its file
        return hold_law_against(found, find_effect(str(write_law(law, origin, Path(folder), law.name, ""))))


def _weighed(own: LawConstant, tests: Sequence[LawTest]) -> LawConstant:
    """Return a constant of the form as all campaigns have it, by its errors; a strength stays that of the first."""
    every = [(own.value, own.low, own.high), *(t.constants[own.name] for t in tests if own.name in t.constants)]
    told = [(x, compute_standard_error(low, high)) for x, low, high in every if high > low]
    if own.name == STRENGTH or own.bound or len(told) < 2:
        return own
    values, errors = np.array(told).T
    weights = errors**-2.0
    value = float(weights @ values / weights.sum())
    # campaigns that differ by more than their errors say that these are too small (Birge 1932, Phys. Rev. 40)
    excess = float(np.sqrt(weights @ (values - value) ** 2 / (len(told) - 1)))
    half = compute_halfwidth(float(weights.sum() ** -0.5) * max(1.0, excess))
    return replace(own, value=value, low=value - half, high=value + half)
