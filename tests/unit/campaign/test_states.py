"""Measured states: stuck, near a reversal, sliding; loads from pressure; what is missing is said."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.campaign import Campaign, load_campaign, measured_states
from slipwise.campaign.same_specimen import check_same_specimen
from slipwise.errors import InputError, SlipwiseWarning
from slipwise.preparation.sample_faults import find_sample_faults
from slipwise.record import Record
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign
from slipwise_benchmarks.write import write_campaign
from unit.campaign.slider import HEADER, slider, text


@pytest.fixture(scope="module")
def made():
    return build_campaign(34, effects=(), rig="bridge1")


@pytest.fixture(scope="module")
def states(made):
    campaign = as_campaign(made)
    return measured_states(campaign.run("quake_hv"), campaign)


def without(campaign, *names: str):
    """Give a campaign whose runs lack some channels."""
    records = {
        run.name: Record(run.record.time, {n: v for n, v in run.record.channels.items() if n not in names})
        for run in campaign.runs
    }
    return campaign.with_records(records, "channels left out")


@pytest.mark.slow
def test_every_sample_is_in_one_state(states):
    assert np.all(states.stuck.astype(int) + states.near_reversal + states.sliding == 1)
    assert states.stuck.any() and states.near_reversal.any() and states.sliding.any()


def test_states_agree_with_the_true_speed(states, made):
    speed = np.abs(made.at_samples("quake_hv")["slip_vx"])
    assert np.quantile(speed[states.stuck & states.valid], 0.99) < 4e-3
    assert speed[states.sliding & states.valid].min() > 0.015
    assert speed[states.near_reversal].mean() < 0.5 * speed[states.sliding].mean()


def test_ends_of_a_run_and_samples_of_an_uplift_are_not_used(states, made):
    assert not states.valid[:8].any() and not states.valid[-8:].any() and states.valid[8:-8].all()
    campaign = as_campaign(made)
    run = campaign.run("quake_hv")
    load = run.record["pad_A_N"].copy()
    load[2000:2003] = 0.0
    lifted = replace(run, record=run.record.replaced(pad_A_N=load))
    uplift = measured_states(lifted, campaign).uplift
    assert uplift[2000:2100].all() and not uplift[:1900].any() and not uplift[2200:].any()


def test_shapes_and_signs_of_four_pads(states):
    count = len(states.time)
    assert states.load.shape == (count, 4) and states.force.shape == (count, 4, 2)
    assert np.isnan(states.force[:, :, 1]).all()
    pushed = np.sum(states.force[states.sliding][:, :, 0], axis=1)
    assert np.mean(np.sign(pushed) == np.sign(states.velocity[states.sliding, 0])) > 0.99


def test_pads_move_apart_where_the_girder_turns(states):
    turning = replace(states, yaw_rate=np.full(len(states.time), 0.01))
    apart = turning.pad_velocity[:, 0, 0] - turning.pad_velocity[:, 2, 0]
    across = states.specimen.pad_places[0][1] - states.specimen.pad_places[2][1]
    assert apart == pytest.approx(-0.01 * across)


def test_what_was_not_measured_is_said(made):
    campaign = without(as_campaign(made), "girder_ax")
    states = measured_states(campaign.runs[0], campaign)
    assert np.isnan(states.girder_acceleration[:, 0]).all()
    missing = " ".join(states.missing)
    assert "slip gauge alone" in missing and "slip_y" in missing and "yaw" in missing
    assert not states.has_y and not states.has_yaw


def test_a_run_without_slip_or_without_all_that_tells_a_load_has_no_states(made):
    every = ["girder_ax", *(f"pad_{pad}_{kind}" for pad in "ABCD" for kind in ("N", "Fx"))]
    for names, message in ((("slip_x",), "slip_x is needed"), (every, "no pad has a load")):
        campaign = without(as_campaign(made), *names)
        with pytest.raises(InputError, match=message):
            measured_states(campaign.runs[0], campaign)


def test_a_pressure_becomes_a_load_over_the_pads_area(campaign):
    header = HEADER.replace("pad_A_N [kN]", "pad_A_P [MPa]")
    read = load_campaign(campaign(one=text(slider(1), header), two=text(slider(2), header)))
    states = measured_states(read.runs[0], read)
    assert states.load[:, 0] == pytest.approx(1e6 * slider(1)[:, 2] * read.specimen.pad_area, rel=1e-5)
    assert any("pressure times the rig's pad area" in words for words in states.missing)


def test_runs_of_different_rigs_do_not_make_a_campaign(made, tmp_path):
    recorded = {name: dict(channels) for name, channels in made.recorded.items()}
    for name in recorded["quake2_hv"]:
        if name.endswith("_N"):
            recorded["quake2_hv"][name] = 1.5 * recorded["quake2_hv"][name]
    write_campaign(tmp_path / "mixed", "bridge1", made.truth.logger, recorded)
    with pytest.raises(InputError, match="runs of different rigs.*'quake2_hv'"):
        load_campaign(tmp_path / "mixed")


def test_load_cells_that_are_all_dead_are_no_other_rig(made):
    campaign = as_campaign(made)
    runs = []
    for run in campaign.runs:
        dead = {name: np.zeros(len(run.record)) for name in run.record.channels if name.endswith("_N")}
        runs.append(replace(run, record=run.record.replaced(**dead)))
    notes = check_same_specimen(replace(campaign, runs=tuple(runs)))
    assert any("carry 0 kN together" in note for note in notes)


def test_a_stated_mass_that_the_load_cells_contradict_is_warned_of(made):
    campaign = as_campaign(made)

    def with_mass(factor: float) -> Campaign:
        mass = factor * campaign.specimen.mass
        return replace(campaign, specimen=campaign.specimen.changed(mass=mass), known={"mass": mass})

    with pytest.warns(SlipwiseWarning, match="the load cells carry .* correct the mass in"):
        (told,) = check_same_specimen(with_mass(1.15))
    assert f"weighs {1.15 * campaign.specimen.weight / 1e3:.3g} kN" in told
    assert check_same_specimen(with_mass(1.03)) == ()


@pytest.mark.parametrize("noise", [0.001, 0.05])
def test_a_load_cell_that_is_dead_in_one_run_is_no_other_rig_and_found(made, noise: float) -> None:
    """However noisy it is: a run in which the others hardly move refused a campaign."""
    campaign = as_campaign(made)
    first, *others = campaign.runs
    spread = noise * float(np.std(first.record["pad_B_N"]))
    dead = np.random.default_rng(3).normal(0.0, spread, len(first.record))
    broken = replace(campaign, runs=(replace(first, record=first.record.replaced(pad_A_N=dead)), *others))
    assert not any("carry" in note for note in check_same_specimen(broken))
    (fault,) = [f for f in find_sample_faults(broken) if f.kind == "dead"]
    assert (fault.channels, fault.runs) == (("pad_A_N",), (first.name,))


def test_a_clipped_accelerometer_is_no_other_rig(made, tmp_path):
    recorded = {name: dict(channels) for name, channels in made.recorded.items()}
    clipped = recorded["sine_hv"]["girder_ax"]
    recorded["sine_hv"]["girder_ax"] = np.clip(clipped, 0.4 * clipped.min(), 0.4 * clipped.max())
    write_campaign(tmp_path / "clipped", "bridge1", made.truth.logger, recorded)
    assert len(load_campaign(tmp_path / "clipped").runs) == 5


@pytest.mark.parametrize(
    ("seed", "effects", "size", "rich"),
    [
        (39037, ("channel_clipping",), "large", False),
        (39104, ("channel_filter",), "large", False),
        (46280, ("table_pitch",), "medium", True),  # a table that rocks at its resonance, 78 floors of it
        (50211, ("table_pitch", "channel_gain"), "large", False),  # one that rocks as it is shaken
        (62139, ("position_patch", "dropped_samples"), "small", False),  # a gauge ever more out of step
        (60206, ("channel_drift",), "medium", True),  # a cell that drifts
    ],
)
@pytest.mark.slow
def test_faults_of_gauges_and_a_table_that_rocks_are_no_other_rig(
    seed: int, effects: tuple[str, ...], size: str, rich: bool
) -> None:
    campaign = as_campaign(build_campaign(seed, effects=effects, size=size, rich=rich))
    assert check_same_specimen(campaign) == ()


def test_a_rig_of_the_same_weight_with_another_lever_is_another_rig(made):
    campaign = as_campaign(made)
    run = campaign.run("quake2_hv")
    loads = {name: run.record[name] for name in run.record.channels if name.endswith("_N")}
    steeper = {name: np.median(load) + 2.0 * (load - np.median(load)) for name, load in loads.items()}
    other = replace(run, record=run.record.replaced(**steeper))
    runs = tuple(other if r is run else r for r in campaign.runs)
    with pytest.raises(InputError, match="lever of .* of the pad spacing"):
        check_same_specimen(replace(campaign, runs=runs))


def test_a_noisy_yaw_gauge_makes_the_velocities_of_the_pads_less_sure() -> None:
    campaign = as_campaign(build_campaign(35002, effects=(), rich=True))
    states = measured_states(campaign.runs[0], campaign)
    places = np.abs(np.array(campaign.specimen.pad_places))
    assert states.yaw_rate_error > 0.0
    expected = np.hypot(states.velocity_error, states.yaw_rate_error * places[:, ::-1])
    assert states.pad_velocity_error == pytest.approx(expected)


def test_a_recorded_velocity_is_that_of_the_sliding_plane(made):
    """The pads' pitch moves the accelerometer, not the gauge: beside its rate a perfect gauge must not get worse."""
    campaign = as_campaign(made)
    run = campaign.run("quake_hv")
    true = made.at_samples("quake_hv")["slip_vx"]
    recorded = replace(run, record=run.record.replaced(slip_vx=true))
    with_gauge = measured_states(recorded, campaign)
    error = (with_gauge.velocity[:, 0] - true)[with_gauge.sliding & with_gauge.valid]
    plain = measured_states(run, campaign)
    assert np.std(error) < 0.5 * np.std((plain.velocity[:, 0] - true)[plain.sliding & plain.valid])


def test_pads_are_known_by_their_names_where_only_some_were_measured(made):
    campaign = as_campaign(made)
    gone = [f"pad_{p}_{kind}" for p in "ABD" for kind in ("N", "Fx")]
    run = without(campaign, *gone).run("quake_hv")
    turned = replace(run, record=run.record.replaced(yaw=0.01 * np.sin(3.0 * run.record.time)))
    states = measured_states(turned, campaign)
    place = campaign.specimen.pad_places[campaign.specimen.pads.index("C")]
    assert states.pads == ("C",)
    expected = states.velocity[:, 0] - place[1] * states.yaw_rate
    np.testing.assert_allclose(states.pad_velocity[:, 0, 0], expected)
