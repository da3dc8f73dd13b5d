"""Wild samples are found where a campaign is read, bridged, and named with channel, count, time and value."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from slipwise.campaign import Campaign, Run, as_campaign, load_campaign
from slipwise.campaign.wild_samples import without_wild_samples
from slipwise.campaign.wild_samples_of_runs import faulty_share
from slipwise.errors import SlipwiseWarning
from slipwise.preparation.decimation import decimate
from slipwise.preparation.excerpts import cut_excerpts
from slipwise.rig import load_specimen

DEMO = Path(__file__).parents[3] / "src" / "slipwise" / "demo_data"


@pytest.fixture(scope="module")
def sound() -> Campaign:
    return load_campaign(DEMO)


def with_values(campaign: Campaign, run: str, name: str, values: np.ndarray) -> Campaign:
    def changed(one: Run) -> Run:
        return replace(one, record=one.record.replaced(**{name: values})) if one.name == run else one

    return replace(campaign, runs=tuple(changed(one) for one in campaign.runs))


def wild_campaign(sound: Campaign, at: slice, size: float = 1e6, name: str = "pad_A_Fx") -> Campaign:
    values = sound.run("quake_h").record[name].copy()
    values[at] += size
    with pytest.warns(SlipwiseWarning, match=name):
        return as_campaign(with_values(sound, "quake_h", name, values))


def test_sound_campaigns_are_given_as_they_are(sound):
    assert as_campaign(sound) is sound
    assert all(run.wild == () for run in sound.runs)


def test_a_wild_sample_is_named_with_time_and_value(sound):
    campaign = wild_campaign(sound, slice(700, 701))
    (note,) = [note for note in campaign.notes if "pad_A_Fx" in note]
    time = sound.run("quake_h").record.time[700]
    assert "1 wild sample (" in note
    assert "quake_h" in note
    assert f"kN at {time:g} s" in note


def test_a_wild_sample_is_bridged_between_its_neighbours(sound):
    run = wild_campaign(sound, slice(700, 701)).run("quake_h")
    assert np.flatnonzero(run.invalid["pad_A_Fx"]).tolist() == [700]
    recorded = sound.run("quake_h").record["pad_A_Fx"]
    assert abs(run.record["pad_A_Fx"][700] - recorded[700]) < 0.05 * np.ptp(recorded)
    others = np.arange(len(recorded)) != 700
    assert np.array_equal(run.record["pad_A_Fx"][others], recorded[others])


def test_a_campaign_in_which_they_are_marked_is_not_marked_again(sound):
    campaign = wild_campaign(sound, slice(700, 720))
    assert as_campaign(campaign) is campaign


def test_what_is_thinned_out_or_cut_keeps_its_marks(sound):
    campaign = wild_campaign(sound, slice(700, 720))
    short = cut_excerpts(campaign, {}, 5000)[0].run("quake_h")
    assert all(len(one.bad) == len(short.record) for one in short.wild)
    fast = replace(
        campaign,
        runs=tuple(replace(r, record=replace(r.record, time=0.4 * r.record.time)) for r in campaign.runs),
    )
    thin = decimate(fast, {})[0].run("quake_h")
    assert len(thin.invalid["pad_A_Fx"]) == len(thin.record) < len(campaign.run("quake_h").record)
    assert thin.invalid["pad_A_Fx"].any()


def test_the_noise_of_a_gauge_does_not_see_them(sound):
    campaign = wild_campaign(sound, slice(30, 40))
    assert campaign.gauges["pad_A_Fx"].level == pytest.approx(sound.gauges["pad_A_Fx"].level, rel=0.02)


def girder(peak: float, *, glitch: bool) -> dict[str, np.ndarray]:
    """Loads and vertical acceleration of a girder that is hit once; or a glitch of one cell."""
    specimen, rng = load_specimen("bridge1"), np.random.default_rng(3)
    upward = 0.3 * np.sin(0.05 * np.arange(2000))
    hit = np.zeros(2000)
    hit[1200:1202] = peak
    loads = {f"pad_{pad}_N": specimen.carried_mass / 4.0 * (9.80665 + upward + hit) for pad in specimen.pads}
    channels = {"girder_az": upward + hit, **loads}
    if glitch:
        channels = {
            **channels,
            "girder_az": upward,
            **{n: v - specimen.carried_mass / 4.0 * hit for n, v in loads.items()},
        }
        channels["pad_B_N"] = channels["pad_B_N"] + specimen.carried_mass * hit
    return {name: values + rng.normal(0.0, 0.001 * np.ptp(upward), 2000) for name, values in channels.items()}


def test_a_blow_that_loads_and_acceleration_show_together_is_motion():
    specimen = load_specimen("bridge1")
    time = np.linspace(0.0, 3.998, 2000)
    assert without_wild_samples(time, girder(30.0, glitch=False), specimen)[1] == ()
    (wild,) = without_wild_samples(time, girder(30.0, glitch=True), specimen)[1]
    assert (wild.channel, np.flatnonzero(wild.bad).tolist()) == ("pad_B_N", [1200, 1201])


def test_a_file_is_read_without_them_and_what_is_computed_from_it_is_marked_too(tmp_path):
    time = 0.002 * np.arange(1500)
    speed = 0.1 * np.sin(9.4 * time) * (time > 0.3)
    force = 2.0 * np.sign(speed) + np.random.default_rng(2).normal(0.0, 0.01, time.size)
    force[800:803] = 1e7
    rows = [f"{t:.3f},{v:.6f},{f:.5f}" for t, v, f in zip(time, speed, force, strict=True)]
    (tmp_path / "a.csv").write_text("\n".join(["time [s],slip_vx [m/s],pad_A_Fx_raw [kN]", *rows]))
    (tmp_path / "campaign.toml").write_text(
        'name = "x"\nrig = "pad"\n[constants]\npad_A_N = "20 kN"\n[derived]\npad_A_Fx = "2 * pad_A_Fx_raw"\n'
        '[[run]]\nfile = "a.csv"\nrole = "fit"\n'
    )
    with pytest.warns(SlipwiseWarning, match=r"pad_A_Fx_raw .* 3 wild samples \(1e\+07 kN from 1.6 to 1.604 s\)"):
        campaign = load_campaign(tmp_path)
    (run,) = campaign.runs
    assert np.ptp(run.record["pad_A_Fx"]) < 1e4
    assert np.flatnonzero(run.invalid["pad_A_Fx"]).tolist() == [800, 801, 802]


def test_the_share_of_wild_samples_counts_all_runs(sound):
    campaign = wild_campaign(sound, slice(700, 720))
    assert faulty_share(campaign.runs, "pad_A_Fx") == pytest.approx(20 / sum(len(r.record) for r in campaign.runs))
    assert faulty_share(campaign.runs, "pad_B_Fx") == 0.0
