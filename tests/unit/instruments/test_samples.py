"""Faults of samples are seen without any fit."""

from dataclasses import replace

import numpy as np
import pytest

from measured import mended_for_balances, mended_for_fits
from slipwise.campaign import Campaign, Logger, Run, load_campaign
from slipwise.instruments.audit import audit
from slipwise.instruments.suspects import effect_of
from slipwise.preparation.sample_fault import SampleFault
from slipwise.preparation.sample_faults import find_sample_faults
from slipwise.record import Record
from slipwise.rig import load_specimen


def _campaign(**changed: np.ndarray) -> Campaign:
    """A girder that slides back and forth under rigid balances, with noise on every gauge."""
    rng = np.random.default_rng(4)
    time = np.arange(3000) * 0.002
    slip = 0.02 * np.sin(2.0 * np.pi * 1.5 * time)
    bend = -((2.0 * np.pi * 1.5) ** 2) * slip
    table = 3.0 * np.sin(2.0 * np.pi * 1.5 * time + 0.4)
    vertical = 1.5 * np.sin(2.0 * np.pi * 4.0 * time)
    noisy = {
        "table_ax": table + rng.normal(0.0, 0.02, time.size),
        "girder_ax": table + bend + rng.normal(0.0, 0.03, time.size),
        "girder_az": vertical + rng.normal(0.0, 0.03, time.size),
        "slip_x": slip + rng.normal(0.0, 2e-5, time.size),
    }
    for pad in "ABCD":
        noisy[f"pad_{pad}_N"] = 2500.0 * (9.80665 + vertical) + rng.normal(0.0, 40.0, time.size)
        noisy[f"pad_{pad}_Fx"] = 2400.0 * np.tanh(np.gradient(slip, time) / 0.01) + rng.normal(0.0, 15.0, time.size)
    record = Record(time, {**noisy, **changed})
    specimen = load_specimen("bridge1")
    run = Run("only", "fit", record, 0.0, None, "only.csv", "")
    return Campaign("made", "bridge1", specimen, Logger(), (run,), specimen.path.parent)


def named(faults: list[SampleFault]) -> list[tuple[str, str]]:
    return list(dict.fromkeys((effect_of(fault.kind).name, name) for fault in faults for name in fault.channels))


def test_sound_gauges_show_no_fault() -> None:
    assert find_sample_faults(_campaign()) == []


@pytest.mark.parametrize("name", ["slip_x", "girder_ax", "table_ax", "girder_az", "pad_C_Fx", "pad_B_N"])
def test_a_gauge_wired_the_wrong_way_round_is_named_and_turned_back(name: str) -> None:
    campaign = _campaign()
    wrong = replace(campaign.runs[0], record=campaign.runs[0].record.replaced(**{name: -campaign.runs[0].record[name]}))
    broken = replace(campaign, runs=(wrong,))
    faults = find_sample_faults(broken)
    assert named(faults) == [("channel_sign", name)]
    whole, _ = mended_for_fits(broken, faults)
    assert np.array_equal(whole.runs[0].record[name], campaign.runs[0].record[name])
    (run,) = mended_for_balances(broken, faults).campaign.runs
    assert np.array_equal(run.record[name], campaign.runs[0].record[name])


def test_four_cells_that_are_wired_the_wrong_way_round_are_one_card() -> None:
    record = _campaign().runs[0].record
    cells = {f"pad_{pad}_Fx": -record[f"pad_{pad}_Fx"] for pad in "ABCD"}
    (fault,) = find_sample_faults(_campaign(**cells))
    assert (fault.kind, fault.channels) == ("turned", tuple(cells))


def test_a_girder_that_hardly_slides_says_nothing_of_the_signs_along_it() -> None:
    rng = np.random.default_rng(8)
    record = _campaign().runs[0].record
    stuck = {"slip_x": rng.normal(0.0, 2e-5, len(record)), "girder_ax": record["table_ax"]}
    stuck |= {f"pad_{pad}_Fx": record["table_ax"] for pad in "ABCD"}
    assert "table_ax" not in {name for _, name in named(find_sample_faults(_campaign(**stuck)))}


def test_a_rail_is_told_from_a_peak() -> None:
    force = _campaign().runs[0].record["pad_A_Fx"]
    faults = find_sample_faults(_campaign(pad_A_Fx=np.minimum(force, 2380.0)))
    assert named(faults) == [("channel_clipping", "pad_A_Fx")]


def test_lost_samples_are_told_and_left_out() -> None:
    load = _campaign().runs[0].record["pad_B_N"].copy()
    lost = np.arange(100, 2900, 40)
    load[lost] = load[lost - 1]
    broken = _campaign(pad_B_N=load)
    faults = find_sample_faults(broken)
    assert named(faults) == [("dropped_samples", "pad_B_N")]
    assert faults[0].size == pytest.approx(lost.size / load.size, rel=0.3)
    whole, invalid = mended_for_fits(broken, faults)
    assert invalid["only"]["pad_B_N"][lost].all()
    np.testing.assert_allclose(whole.runs[0].record["pad_B_N"][lost], 0.5 * (load[lost - 1] + load[lost + 1]))


def test_samples_that_were_lost_for_good_show_where_the_record_had_to_be_filled_up() -> None:
    slip = _campaign().runs[0].record["slip_x"]
    kept = np.delete(slip, [700, 701, 702, 1500, 1501, 2200, 2201, 2202, 2600])
    moved = np.concatenate([kept, np.full(9, kept[-1])])
    assert named(find_sample_faults(_campaign(slip_x=moved))) == [("dropped_samples", "slip_x")]
    record = _campaign().runs[0].record
    cut = {name: np.concatenate([x[:-20], np.full(20, x[-21])]) for name, x in record.channels.items()}
    assert find_sample_faults(_campaign(**cut)) == [], "every channel ends so: the record was cut"
    few = slip.copy()
    few[-4:] = few[-5]  # as many as a coarse card repeats now and then
    assert find_sample_faults(_campaign(slip_x=few)) == []


def test_a_peak_that_is_held_is_no_rail_where_other_samples_are_held_too() -> None:
    load = _campaign().runs[0].record["pad_C_N"].copy()
    starts = [int(np.argmax(load)), *range(100, 2900, 90)]
    for start in starts:
        load[start : start + 5] = load[start]
    assert named(find_sample_faults(_campaign(pad_C_N=load))) == [("dropped_samples", "pad_C_N")]


def test_what_a_clipped_accelerometer_does_to_the_velocity_is_left_out_widely() -> None:
    campaign = _campaign(girder_ax=np.clip(_campaign().runs[0].record["girder_ax"], -1.5, 1.5))
    faults = find_sample_faults(campaign)
    assert named(faults) == [("channel_clipping", "girder_ax")]
    _, invalid = mended_for_fits(campaign, faults)
    rail = np.abs(campaign.runs[0].record["girder_ax"]) == 1.5
    assert invalid["only"]["girder_ax"][np.convolve(rail, np.ones(61), mode="same") > 0.5].all()


def test_a_slip_that_is_integrated_from_its_speed_is_never_called_rounded(tmp_path):
    time = 0.02 * np.arange(240)
    speed = 75.0 + 0.05 * np.random.default_rng(1).standard_normal(240)
    rows = "".join(f"{t:.2f},{v:.4f},1.44,9\n" for t, v in zip(time, speed, strict=True))
    (tmp_path / "run.csv").write_text("time [s],slip_vx [mm/s],pad_A_Fx [N],pad_A_N [N]\n" + rows)
    (tmp_path / "campaign.toml").write_text('rig = "pad"\n[[run]]\nfile = "run.csv"\nrole = "fit"\n')
    report = audit(load_campaign(tmp_path))
    assert not [note for note in report.notes if note.startswith("slip_x is rounded")]
    steps = [(f"{t:.2f}", round(20.0 * np.sin(9.0 * t) + 0.2 * v)) for t, v in zip(time, speed - 75.0, strict=True)]
    rows = "".join(f"{t},{x},1.44,9\n" for t, x in steps)
    (tmp_path / "run.csv").write_text("time [s],slip_x [mm],pad_A_Fx [N],pad_A_N [N]\n" + rows)
    report = audit(load_campaign(tmp_path))
    assert [note for note in report.notes if note.startswith("slip_x is rounded")]
