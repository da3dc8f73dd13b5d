"""A gauge that stands for the sum of small faults of many keeps little of its size; one that is really at fault all."""

import pytest

from bench import Fault, build_campaign, with_faults
from measured import as_campaign, fit_base
from slipwise.campaign.materiality import Materiality
from slipwise.diagnosis.gauge_error_shrinkage import shares_that_stay
from slipwise.diagnosis.hypothesis import polish, refit
from slipwise.diagnosis.screening import screen
from slipwise.effects import catalogue
from slipwise.relations.parameters import Term

CELLS = tuple(f"pad_{p}_N" for p in "ABCD")
GAINS = tuple(Term(catalogue()["channel_gain"], (cell,), cell) for cell in CELLS)


def share_of_one(faults: list[Fault]) -> tuple[float, float]:
    """Give what the first cell's gain is fitted to where it alone is asked, and the share of it that stays."""
    base = fit_base(as_campaign(with_faults(build_campaign(61, effects=(), rig="bridge1"), faults, 5)))
    term = GAINS[0]
    found = polish(refit(base, [term], {term.label: term.effect.typical()}))
    size = found.solution.values[f"{term.label}.gain"]
    stays = shares_that_stay(found, {"channel_gain": abs(size) / 0.01}, screen(base, GAINS), Materiality())
    return size, stays["channel_gain"]


def test_a_gain_that_is_there_alone_stays() -> None:
    size, stays = share_of_one([Fault("channel_gain", CELLS[:1], 0.03)])
    assert size == pytest.approx(0.03, rel=0.1)
    assert stays > 0.95


def test_a_gain_that_stands_for_those_of_other_cells_does_not_stay() -> None:
    size, stays = share_of_one([Fault("channel_gain", CELLS[3:], 0.006), Fault("channel_gain", CELLS[1:2], -0.006)])
    assert size * stays == pytest.approx(0.0, abs=0.001)
