"""An invalid gauge spoils what is made of it, and nothing else."""

from dataclasses import replace

import numpy as np
import pytest

from bench import build_campaign
from measured import as_campaign
from slipwise.estimation.judged_samples import away_from_cuts, sample_masks
from slipwise.estimation.kinematics import Kinematics
from slipwise.estimation.recent_results import Recent
from slipwise.estimation.run_data import FitRun, fit_runs
from slipwise.instruments.repairs import for_fits
from slipwise.instruments.sample_faults import sample_faults

COUNT = 6
ALL = np.ones(COUNT, dtype=bool)
LATE = np.arange(COUNT) > 3


def test_a_clipped_friction_gauge_leaves_the_other_pads_and_the_loads() -> None:
    kept = sample_masks(ALL, ALL, ALL, ALL, ("A", "B"), {"pad_B_Fx": LATE})
    assert kept["pads"][:, 0].all() and np.array_equal(kept["pads"][:, 1], ~LATE)
    assert kept["heave"].all() and kept["roll"].all() and kept["motion"].all() and kept["across"].all()
    assert np.array_equal(kept["girder"], ~LATE) and np.array_equal(kept["pitch"], ~LATE)


@pytest.mark.parametrize("name", ["slip_x", "girder_ax", "table_ax"])
def test_a_gauge_of_motion_spoils_every_pad(name: str) -> None:
    kept = sample_masks(ALL, ALL, ALL, ALL, ("A", "B"), {name: LATE})
    assert all(np.array_equal(kept["pads"][:, i], ~LATE) for i in range(2))
    assert kept["heave"].all()


def test_no_relation_is_judged_off_the_ground_or_stuck() -> None:
    kept = sample_masks(LATE, LATE & (np.arange(COUNT) > 4), ALL, ALL, ("A",), {})
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
    whole, invalid = for_fits(clipped, sample_faults(clipped))
    ready = fit_runs(whole, invalid)
    assert all(r.judged["pads"][:, 0].sum() > 1.5 * r.judged["pads"][:, 2].sum() for r in ready)
    specimen, truth = campaign.specimen, made.truth.as_dict()["settings"]
    fitted = {"rig.mass": truth["mass"], "rig.centre_height": truth["h"], "rig.buffer_stiffness": 2.0 * truth["Kb"]}

    def yaw(runs: list[FitRun]) -> list[np.ndarray]:
        return [angle for angle, _ in Kinematics(runs, specimen, (), True, True, Recent()).yaw_of_runs(fitted)]

    for seen, true in zip(yaw(ready), yaw(fit_runs(campaign)), strict=True):
        assert np.std(true) > 1e-4, "it must be seen at all"
        assert np.std(seen - true) < 0.1 * np.std(true)


@pytest.mark.parametrize(("begins", "ends"), [(True, True), (False, True), (True, False)])
def test_slip_is_not_held_against_accelerometers_where_a_record_was_cut(begins: bool, ends: bool) -> None:
    at_rest = np.zeros(500, dtype=bool)
    at_rest[0], at_rest[-1] = begins, ends
    whole = away_from_cuts(at_rest, 0.002)
    assert (whole[0], whole[-1]) == (begins, ends)
    assert whole[100:400].all() and whole.sum() == 500 - 60 * (not begins) - 60 * (not ends)
