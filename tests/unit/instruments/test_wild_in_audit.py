"""One glitch of a logger moves no floor, lag, gain or sign of an audit, and accuses nobody."""

from dataclasses import replace

import numpy as np
import pytest

from measured import mended_for_fits
from slipwise.campaign import Campaign, as_campaign
from slipwise.campaign.invalid_samples import add_wild_samples
from slipwise.errors import SlipwiseWarning
from slipwise.instruments.audit import audit
from slipwise.preparation.sample_fault import SampleFault
from slipwise.preparation.sample_faults import find_sample_faults

pytestmark = pytest.mark.filterwarnings("ignore::slipwise.errors.SlipwiseWarning")


def with_burst(campaign: Campaign, name: str, at: slice, size: float) -> Campaign:
    run = campaign.runs[1]
    values = run.record[name].copy()
    values[at] += size
    wild = replace(run, record=run.record.replaced(**{name: values}))
    return replace(campaign, runs=tuple(wild if r is run else r for r in campaign.runs))


@pytest.mark.parametrize(
    ("name", "at", "size"),
    [
        ("pad_A_Fx", slice(700, 701), 1e5),
        ("pad_A_Fx", slice(700, 701), 1e12),
        ("girder_ax", slice(1500, 1520), 1e6),
        ("slip_x", slice(1500, 1510), 0.5),
        ("table_ax", slice(1400, 1420), -500.0),
        ("pad_C_N", slice(30, 45), 1e9),
    ],
)
def test_a_burst_accuses_nobody_and_moves_no_balance(sound, sound_report, name, at, size):
    report = audit(with_burst(sound, name, at, size))
    assert [f.name for f in report.findings] == [f.name for f in sound_report.findings]
    assert any(note.startswith(name) and "wild sample" in note for note in report.notes)
    after = {b.relation: b for b in report.balances}
    for balance in sound_report.balances:
        assert after[balance.relation].floor == pytest.approx(balance.floor, rel=0.05)
        assert after[balance.relation].left == pytest.approx(balance.left, rel=0.05)


def test_samples_around_a_wild_one_are_not_judged(sound):
    run = as_campaign(with_burst(sound, "slip_x", slice(1500, 1510), 0.5)).runs[1]
    kept = ~add_wild_samples(run, {})["slip_x"]
    assert not kept[1480:1530].any()
    assert kept[:1400].all()
    assert kept[1600:].all()


def test_marks_move_with_a_channel_that_is_brought_into_step(sound):
    marked = as_campaign(with_burst(sound, "pad_A_Fx", slice(700, 703), 1e9))
    run = marked.runs[1]
    late = SampleFault("late", ("pad_A_Fx",), 100.0 * run.record.dt, {}, (run.name,))
    moved, _ = mended_for_fits(marked, [late])
    assert moved.runs[1].invalid["pad_A_Fx"][600:603].all()


def test_a_channel_that_is_wild_too_often_is_faulty(sound):
    rng = np.random.default_rng(4)
    run = sound.runs[1]
    campaign = sound
    for one in sound.runs:
        values = one.record["pad_B_Fx"].copy()
        values[rng.choice(len(values), len(values) // 30, replace=False)] = 1e8
        changed = replace(one, record=one.record.replaced(pad_B_Fx=values))
        campaign = replace(campaign, runs=tuple(changed if r.name == one.name else r for r in campaign.runs))
    with pytest.warns(SlipwiseWarning, match="pad_B_Fx"):
        campaign = as_campaign(campaign)
    (fault,) = [fault for fault in find_sample_faults(campaign) if fault.kind == "wild"]
    assert fault.channels == ("pad_B_Fx",)
    assert fault.size == pytest.approx(1.0 / 30.0, rel=0.2)
    assert run.name in fault.runs
    (finding,) = [finding for finding in audit(campaign).findings if finding.channel == "pad_B_Fx"]
    assert "faulty" in finding.words
