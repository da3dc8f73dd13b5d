"""What a screen's straight line promises must be there, or it is not refitted."""

from dataclasses import replace

import pytest

from bench import build_campaign
from measured import as_campaign, fit_base
from slipwise.diagnosis.bound_check import keeps_its_gain, with_bounds_checked
from slipwise.diagnosis.candidates import list_candidates
from slipwise.diagnosis.screening import Screened, screen
from slipwise.estimation.base_fit import BaseFit


def screened(base: BaseFit, *labels: str) -> dict[str, Screened]:
    terms = [t for t in list_candidates(base)[0] if t.label in labels]
    return {s.term.label: s for s in screen(base, terms)}


@pytest.fixture(scope="module")
def complete() -> BaseFit:
    return fit_base(as_campaign(build_campaign(45048, effects=())))


def test_a_gauge_at_midspan_of_a_girder_that_does_not_bend_hides_noise_only(complete: BaseFit) -> None:
    found = screened(complete, "girder_bending")["girder_bending"]
    samples = len(complete.solution.residuals.of("heave")[0])
    assert found.gain > 0.1 * samples and found.values["midspan"] == 1.0
    assert not keeps_its_gain(complete, found)
    assert with_bounds_checked(complete, [found], 0.1 * samples)[0].gain == 0.0
    assert with_bounds_checked(complete, [found], 2.0 * found.gain)[0].gain == found.gain, (
        "what is not refitted is not looked at"
    )


@pytest.mark.slow
def test_what_is_there_is_kept_and_the_opposite_of_it_is_not() -> None:
    base = fit_base(as_campaign(build_campaign(45005, effects=("girder_bending",), size="medium")))
    found = screened(base, "girder_bending")["girder_bending"]
    assert keeps_its_gain(base, found)
    assert not keeps_its_gain(base, replace(found, values={**found.values, "frequency": 5.0, "share": 0.4}))


@pytest.mark.slow
def test_slopes_of_the_base_that_lead_astray_take_nothing_away() -> None:
    base = fit_base(as_campaign(build_campaign(45005, effects=("girder_bending",), size="medium")))
    found = screened(base, "girder_bending")["girder_bending"]
    astray = replace(base, solution=replace(base.solution, jacobian=1e-6 * base.solution.jacobian))
    assert keeps_its_gain(astray, found)
