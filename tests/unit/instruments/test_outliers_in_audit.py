"""A glitch that is too small to be called wild moves no lag, gain, sign or floor."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.campaign import Campaign
from slipwise.instruments.audit import audit
from slipwise.preparation.outliers import bridge_outliers
from slipwise.preparation.signs import find_wrong_signs
from slipwise.preparation.synchronisation import find_late_cells
from slipwise.signals.shift import shift
from slipwise.signals.short_bursts import short_bursts
from slipwise_benchmarks import Fault

CHANNELS = ("slip_x", "girder_ax", "table_ax", "pad_A_Fx", "pad_A_N")


def with_glitches(campaign: Campaign, size: float, length: int) -> Campaign:
    """Give a campaign with a glitch in each of five channels, of a share of its range, in one run of three."""
    campaign = replace(campaign, runs=campaign.runs[:3])
    rng = np.random.default_rng(11)
    run = campaign.runs[1]
    changed = {}
    for name in CHANNELS:
        values = run.record[name].copy()
        start = int(rng.integers(600, len(values) - 600))
        values[start : start + length] += size * np.ptp(values)
        changed[name] = values
    glitches = replace(run, record=run.record.replaced(**changed))
    return replace(campaign, runs=tuple(glitches if r is run else r for r in campaign.runs))


@pytest.fixture(scope="module")
def small_gain(measured_with) -> Campaign:
    campaign = measured_with(Fault("channel_gain", ("pad_A_Fx",), 0.05))
    return replace(campaign, runs=campaign.runs[:3])


def test_gains_and_floors_are_those_without_glitches(small_gain):
    # three samples of .8 ranges lie below what is called wild
    glitches = with_glitches(small_gain, 0.8, 3)
    assert not any(short_bursts(glitches.runs[1].record[name]).any() for name in CHANNELS)
    before, after = audit(small_gain), audit(glitches)
    assert [f.name for f in after.findings] == [f.name for f in before.findings] == ["channel_gain:pad_A_Fx"]
    assert after.findings[0].size == pytest.approx(before.findings[0].size, rel=0.01)
    floors = {b.relation: b.floor for b in after.balances}
    for balance in before.balances:
        assert floors[balance.relation] == pytest.approx(balance.floor, rel=0.1)


def test_lags_are_those_without_glitches(sound):
    campaign = replace(sound, runs=sound.runs[:3])
    names = [name for name in campaign.runs[0].record.channels if name.startswith("pad_")]
    delay = 0.3
    late = replace(
        campaign,
        runs=tuple(
            replace(r, record=r.record.replaced(**{n: shift(r.record[n], r.record.dt, delay) for n in names}))
            for r in campaign.runs
        ),
    )
    before = find_late_cells(bridge_outliers(late))
    after = find_late_cells(bridge_outliers(with_glitches(late, 0.8, 3)))
    assert before is not None
    assert after is not None
    assert after.delay == pytest.approx(before.delay, abs=1e-4)


def test_signs_are_those_without_glitches(sound):
    turned = replace(
        sound,
        runs=tuple(replace(r, record=r.record.replaced(girder_ax=-r.record["girder_ax"])) for r in sound.runs),
    )
    assert find_wrong_signs(bridge_outliers(with_glitches(turned, 0.8, 3))) == ["girder_ax"]
