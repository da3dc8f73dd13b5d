"""Campaigns that nobody made for this library load as they are: a practice rig, and three measured sliders."""

import numpy as np
import pytest

from shaking import needs_shared
from slipwise.campaign import load_campaign, measured_states


@pytest.mark.parametrize("name", ["p01", "p07"])
def test_a_practice_campaign_loads_in_si(name):
    campaign = load_campaign(needs_shared("practice", name))
    assert [run.role for run in campaign.runs] == ["fit", "fit", "fit", "repeat", "holdout"]
    assert all(run.rest_before == pytest.approx(1800.0) for run in campaign.runs)
    weight = sum(np.median(campaign.runs[0].record[f"pad_{pad}_N"]) for pad in "ABCD")
    assert weight == pytest.approx(campaign.specimen.weight, rel=0.05)


@pytest.mark.parametrize(
    ("name", "runs", "holdout", "friction"),
    [("band_brake", 4, 1, (500.0, 50e3)), ("tribometer", 2, 1, (0.2, 5.0)), ("oring_seal", 4, 1, (0.5, 60.0))],
)
def test_a_measured_slider_loads_with_speed_load_and_force(name, runs, holdout, friction):
    campaign = load_campaign(needs_shared("friction", name))
    assert len(campaign.runs) == runs and len(campaign.with_role("holdout")) == holdout
    states = measured_states(campaign.runs[0], campaign)
    assert np.isfinite(states.load[:, 0]).all() and np.isfinite(states.velocity).all()
    force, speed = states.force[states.valid, 0, 0], states.velocity[states.valid, 0]
    low, high = friction
    assert low < np.median(np.abs(force[states.sliding[states.valid]])) < high
    # backlash and elastic travel give some of it back, but friction takes energy out of every stroke
    assert np.sum(force * speed) > 0.5 * np.sum(np.abs(force * speed))
