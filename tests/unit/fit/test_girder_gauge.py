"""A gauge of the girder whose filter has no inverse, and one whose noise comes down as load."""

from dataclasses import replace

import numpy as np
import pytest

from bench import build_campaign
from measured import as_campaign
from slipwise.campaign import Campaign
from slipwise.diagnose.refit import polished, refit
from slipwise.effects import catalogue
from slipwise.fit.balance_noise import heave_level
from slipwise.fit.base import BaseFit, fit_base
from slipwise.fit.terms import Term

LAG, ORDER = 0.019, 2.0


@pytest.fixture(scope="module")
def campaign() -> Campaign:
    return as_campaign(build_campaign(61, effects=(), rig="bridge1"))


@pytest.fixture(scope="module")
def base(campaign: Campaign) -> BaseFit:
    return fit_base(campaign)


def test_a_strong_filter_of_the_girder_is_put_on_what_the_balance_predicts(campaign: Campaign) -> None:
    """12 Hz takes reversals out of the accelerometer for good: sharpening it left 2.7 floors in the balance."""
    effect = catalogue()["channel_filter"]
    filtered = [
        replace(run, record=effect.hooks["gauge"](record=run.record, target="girder_ax", lag=LAG, order=ORDER))
        for run in campaign.runs
    ]
    base = fit_base(replace(campaign, runs=tuple(filtered)))
    term = Term(effect, ("girder_ax",), "girder_ax")
    found = polished(refit(base, [term], {term.label: {"lag": LAG, "order": ORDER}}))
    assert base.solution.residuals.parts["girder"][0].std() > 5.0
    assert np.sqrt(found.account.level("girder", held_out=True)) < 1.1
    assert found.solution.values[f"{term.label}.lag"] == pytest.approx(LAG, rel=0.02)


def test_less_mass_is_not_bought_with_the_noise_of_the_accelerometer(base: BaseFit) -> None:
    """The noise that heave is judged by is what the fitted mass makes of the accelerometer's."""
    model, run = base.model, base.problem.runs[0]
    loads = np.linalg.norm(run.gauge_noise[1])
    for share in (0.5, 1.0, 2.0):
        specimen = replace(model.specimen, mass=share * model.specimen.mass)
        expected = np.hypot(loads, specimen.mass * run.noise["girder_az"])
        assert heave_level(replace(model, specimen=specimen), run) == pytest.approx(expected)
