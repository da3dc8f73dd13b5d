"""An invalid gauge spoils what is made of it, and nothing else."""

from dataclasses import replace

import numpy as np
import pytest

from measured import mended_for_fits
from slipwise.estimation.objective import make_objective
from slipwise.preparation.sample_faults import find_sample_faults
from slipwise.relations.kinematics import YAW
from slipwise.relations.run_data import FitRun, fit_runs
from slipwise.relations.sample_masks import (
    make_sample_masks,
    mask_away_from_cuts,
    mask_before_uplift,
    mask_ringing_after_uplift,
)
from slipwise.rig import load_specimen, pad_frequencies
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign

COUNT = 6
ALL = np.ones(COUNT, dtype=bool)
LATE = np.arange(COUNT) > 3


def test_a_clipped_friction_gauge_leaves_the_other_pads_and_the_loads() -> None:
    kept = make_sample_masks(ALL, ALL, ALL, ALL, ("A", "B"), {"pad_B_Fx": LATE})
    assert kept["pads"][:, 0].all() and np.array_equal(kept["pads"][:, 1], ~LATE)
    assert kept["heave"].all() and kept["roll"].all() and kept["motion"].all() and kept["across"].all()
    assert np.array_equal(kept["girder"], ~LATE) and np.array_equal(kept["pitch"], ~LATE)


@pytest.mark.parametrize("name", ["slip_x", "girder_ax", "table_ax"])
def test_a_gauge_of_motion_spoils_every_pad(name: str) -> None:
    kept = make_sample_masks(ALL, ALL, ALL, ALL, ("A", "B"), {name: LATE})
    assert all(np.array_equal(kept["pads"][:, i], ~LATE) for i in range(2))
    assert kept["heave"].all()


def test_no_relation_is_judged_off_the_ground_or_stuck() -> None:
    kept = make_sample_masks(LATE, LATE & (np.arange(COUNT) > 4), ALL, ALL, ("A",), {})
    assert all(np.array_equal(kept[r], LATE) for r in ("girder", "heave", "pitch", "roll", "warp", "motion"))
    assert kept["pads"][:, 0].sum() == 1


def test_the_yaw_of_unequal_pads_is_seen_though_one_of_their_gauges_is_clipped() -> None:
    made = build_campaign(35110, effects=("pad_spread",), size="large")
    campaign = as_campaign(made)
    runs = []
    for run in campaign.runs:
        force = run.record["pad_C_Fx"]
        rail = 0.5 * float(np.abs(force).max())
        runs.append(replace(run, record=run.record.replaced(pad_C_Fx=np.clip(force, -rail, rail))))
    clipped = replace(campaign, runs=tuple(runs))
    whole, invalid = mended_for_fits(clipped, find_sample_faults(clipped))
    ready = fit_runs(whole, invalid)
    assert all(r.judged["pads"][:, 0].sum() > 1.5 * r.judged["pads"][:, 2].sum() for r in ready)
    specimen, truth = campaign.specimen, made.truth.as_dict()["settings"]
    fitted = {"rig.mass": truth["mass"], "rig.centre_height": truth["h"], "rig.buffer_stiffness": 2.0 * truth["Kb"]}

    def yaw(runs: list[FitRun]) -> list[np.ndarray]:
        return [angle for angle, _ in make_objective(runs, specimen, ()).with_yaw().evaluation(fitted).of(YAW)]

    for seen, true in zip(yaw(ready), yaw(fit_runs(campaign)), strict=True):
        assert np.std(true) > 1e-4, "it must be seen at all"
        assert np.std(seen - true) < 0.1 * np.std(true)


@pytest.mark.parametrize(("begins", "ends"), [(True, True), (False, True), (True, False)])
def test_slip_is_not_held_against_accelerometers_where_a_record_was_cut(begins: bool, ends: bool) -> None:
    at_rest = np.zeros(500, dtype=bool)
    at_rest[0], at_rest[-1] = begins, ends
    whole = mask_away_from_cuts(at_rest, 0.002)
    assert (whole[0], whole[-1]) == (begins, ends)
    assert whole[100:400].all() and whole.sum() == 500 - 60 * (not begins) - 60 * (not ends)


@pytest.mark.parametrize("rig", ["bridge1", "three_pads", "pendulum"])
def test_pitch_is_left_out_for_as_long_as_a_girder_rings_that_has_lifted(rig: str) -> None:
    specimen, dt = load_specimen(rig), 1e-3
    lifted = np.zeros(3000, dtype=bool)
    lifted[500:510] = True
    ringing = mask_ringing_after_uplift(lifted, dt, specimen)
    turn = 2.0 * np.pi * pad_frequencies(specimen)["pitch"]
    damping = 0.5 * turn * specimen.pad_damping / specimen.pad_stiffness
    left = np.exp(-damping * turn * dt * np.count_nonzero(ringing[510:]))
    assert ringing[500:510].all() and not ringing[:500].any()
    assert left == pytest.approx(1.0 / 700.0, rel=0.2), "what was 700 times its floor is then no more than that"
    ahead = mask_before_uplift(lifted, dt)
    assert ahead[400:500].all() and not ahead[510:].any()


def test_a_girder_that_never_lifts_is_judged_throughout() -> None:
    never = np.zeros(300, dtype=bool)
    assert not mask_ringing_after_uplift(never, 2e-3, load_specimen("three_pads")).any()
    assert not mask_before_uplift(never, 2e-3).any()
