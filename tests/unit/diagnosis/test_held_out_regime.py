"""A held-out run that goes beyond what was fitted confirms nothing, and is told by name."""

from dataclasses import replace

from hypotheses import measured
from slipwise.campaign import Campaign
from slipwise.diagnosis.held_out_regime import find_untestable_reason
from slipwise.estimation.base_fit import fit_base
from slipwise.estimation.objective import Objective


def _objective(campaign: Campaign, factor: float) -> Objective:
    """The held-out run slides this many times as far and as fast."""
    objective = fit_base(campaign).objective
    runs = list(objective.runs)
    for i in objective.held_out:
        states = runs[i].states
        runs[i] = replace(runs[i], states=replace(states, slip=factor * states.slip, velocity=factor * states.velocity))
    return replace(objective, measurements=replace(objective.measurements, runs=tuple(runs)))


def test_a_run_within_what_was_fitted_can_be_tested():
    assert find_untestable_reason(_objective(measured(), 1.0)) == {}


def test_a_run_that_goes_beyond_is_told_with_what_it_reaches():
    objective = _objective(measured(), 3.0)
    found = find_untestable_reason(objective)
    assert list(found) == objective.held_out
    assert "speeds reach" in found[objective.held_out[0]] and "strokes reach" in found[objective.held_out[0]]
    assert "loads" not in found[objective.held_out[0]]
