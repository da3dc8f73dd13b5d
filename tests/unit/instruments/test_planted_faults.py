"""A fault that is planted is found: what, on which channel, how large; and a sound campaign accuses nobody."""

from dataclasses import replace

import numpy as np
import pytest

from shaking import needs_shared
from slipwise.campaign import Campaign, Logger, load_campaign
from slipwise.instruments.audit import audit
from slipwise.preparation.logger import estimate_logger
from slipwise_benchmarks import GROUPS, Fault

CELLS = GROUPS["forces"] + GROUPS["loads"]


def test_a_sound_campaign_accuses_nobody_and_every_balance_leaves_only_noise(sound_report):
    report = sound_report
    assert report.findings == () and report.physics == ()
    balances = {b.relation: b.left for b in report.balances}
    assert {"heave", "girder_x", "pitch", "along", "upright"} <= set(balances)
    pairs = {name for name in balances if name.startswith("pair_")}  # pads do not turn round at the same instant
    assert all(left < 1.15 for name, left in balances.items() if name not in pairs), balances
    assert all(balances[name] < 1.5 for name in pairs), balances


@pytest.mark.parametrize(
    ("fault", "channel"),
    [
        (Fault("channel_delay", GROUPS["loads"], 5e-3), "pad_*_N"),
        (Fault("channel_gain", ("girder_ax",), -0.05), "girder_ax"),
        (Fault("channel_gain", ("pad_B_Fx",), 0.06), "pad_B_Fx"),
        (Fault("load_crosstalk", GROUPS["forces"], 0.01, "not zeroed"), "pad_*_Fx"),
        (Fault("load_crosstalk", ("pad_C_Fx",), -0.012, "not zeroed"), "pad_C_Fx"),
        (Fault("cell_inertia", CELLS, 30.0, "subtracted"), "pad_*"),
        (Fault("channel_offset", ("girder_ax",), 0.12), "girder_ax"),
    ],
    ids=lambda value: f"{value.effect} {value.channels[0]}" if isinstance(value, Fault) else "",
)
@pytest.mark.slow
def test_a_planted_fault_is_the_only_finding_with_its_size(measured_with, fault, channel):
    report = audit(measured_with(fault))
    (finding,) = report.findings
    assert (finding.what, finding.channel) == (fault.effect, channel)
    assert finding.size == pytest.approx(fault.size, rel=0.15)
    assert finding.low < finding.size < finding.high
    assert finding.probability > 0.5
    assert finding.settle_by and finding.mistaken_for
    # pads that are held against each other do not turn round at the same instant
    assert all(b.explained < (1.5 if b.relation.startswith("pair_") else 1.15) for b in report.balances)


def test_a_gauge_wired_the_wrong_way_round_is_found(measured_with):
    (finding,) = audit(measured_with(Fault("channel_sign", ("girder_ax",), -1.0))).findings
    assert (finding.what, finding.channel) == ("channel_sign", "girder_ax")
    assert "wrong sign" in finding.words


def test_a_small_fault_is_found_beside_a_large_one_that_hides_it(measured_with):
    faults = Fault("channel_delay", ("slip_x",), 4e-3), Fault("channel_gain", ("pad_B_Fx",), 0.06)
    findings = {f.name: f.size for f in audit(measured_with(*faults)).findings}
    assert set(findings) == {"channel_delay:slip_x", "channel_gain:pad_B_Fx"}
    assert findings["channel_delay:slip_x"] == pytest.approx(4e-3, rel=0.05)
    assert findings["channel_gain:pad_B_Fx"] == pytest.approx(0.06, rel=0.15)


def test_a_cell_whose_balance_is_too_noisy_to_tell_is_not_accused_but_mentioned(measured_with):
    report = audit(measured_with(Fault("load_crosstalk", ("pad_C_Fx",), -0.012, "zeroed at rest")))
    assert report.findings == ()
    assert any(note.startswith("pad_C_Fx from N, zeroed") and "too noisy" in note for note in report.notes)


def test_both_rails_of_a_gauge_are_found_and_harm_no_balance(measured_with, made):
    findings = audit(measured_with(Fault("channel_clipping", ("pad_A_Fx",), 0.6))).findings
    assert {f.name for f in findings} == {"channel_clipping:pad_A_Fx"}
    reach = 0.6 * max(np.abs(run["pad_A_Fx"] - run["pad_A_Fx"][0]).max() for run in made.true.values())
    assert sorted(f.size for f in findings) == pytest.approx([-reach, reach], rel=0.1)
    assert {key for f in findings for key in f.values} == {"upper", "lower"}


@pytest.mark.parametrize(
    ("fault", "channel", "share"),
    [
        (Fault("dropped_samples", GROUPS["forces"], 0.02, "held", seed=3), "pad_*_Fx", 0.02),
        (Fault("dropped_samples", ("slip_x",), 0.003, "lost", seed=3), "slip_x", 0.003),
    ],
    ids=["held", "lost"],
)
def test_samples_that_repeat_or_are_lost_are_found_with_their_share(measured_with, fault, channel, share):
    (finding,) = audit(measured_with(fault)).findings
    assert (finding.what, finding.channel) == ("dropped_samples", channel)
    # samples go in bursts, of which the last one may exceed the share by up to six
    assert 0.95 * share < finding.size < share + 6.0 / 3750.0
    assert finding.runs


def changed(campaign: Campaign, run: str, **channels) -> Campaign:
    return campaign.with_records({run: campaign.run(run).record.replaced(**channels)}, "changed")


def test_a_channel_that_is_dead_in_one_run_is_named_with_that_run(sound):
    dead = changed(sound, "quake_h", pad_D_N=np.full(len(sound.run("quake_h").record), 24.5e3))
    (finding,) = audit(dead).findings
    assert finding.channel == "pad_D_N" and finding.runs == ("quake_h",) and "dead" in finding.words


def test_samples_that_the_logger_lost_show_as_a_gap_of_time(sound):
    run = sound.run("quake_h")
    kept = np.ones(len(run.record), dtype=bool)
    kept[1000:1020] = False
    record = replace(
        run.record, time=run.record.time[kept], channels={n: v[kept] for n, v in run.record.channels.items()}
    )
    (finding,) = audit(sound.with_records({"quake_h": record}, "cut")).findings
    assert finding.what == "dropped_samples" and finding.channel == "all" and finding.runs == ("quake_h",)


def test_coarse_rounding_is_told_and_accuses_nobody(sound):
    records = {r.name: r.record.replaced(pad_A_Fx=100.0 * np.round(r.record["pad_A_Fx"] / 100.0)) for r in sound.runs}
    report = audit(sound.with_records(records, "rounded"))
    assert report.findings == ()
    assert any("pad_A_Fx is rounded to steps of 100 N" in note for note in report.notes)


def test_the_loggers_filter_is_estimated_within_a_tenth_where_it_is_not_given(sound, made):
    found = estimate_logger(replace(sound, logger=Logger()))
    assert found.lowpass is not None, found.why
    assert found.lowpass.frequency == pytest.approx(made.truth.logger.lowpass, rel=0.1)


def test_a_slider_of_its_own_has_no_balance_and_says_so(sound):
    names = ("slip_x", "pad_A_N", "pad_A_Fx")
    records = {r.name: replace(r.record, channels={n: r.record[n] for n in names}) for r in sound.runs}
    report = audit(sound.with_records(records, "one pad"))
    assert report.findings == ()
    assert any(words.startswith("girder_x: channel missing") for words in report.cannot)


def test_the_practice_campaign_with_right_gauges_accuses_nobody():
    assert audit(load_campaign(needs_shared("practice", "p01"))).findings == ()


def test_the_practice_campaign_with_cross_talk_shows_it_on_all_four_cells():
    (finding,) = audit(load_campaign(needs_shared("practice", "p07"))).findings
    assert (finding.what, finding.channel) == ("load_crosstalk", "pad_*_Fx")
    assert finding.size == pytest.approx(0.020, rel=0.1)
