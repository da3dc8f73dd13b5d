"""What nobody can vouch for at a reversal is counted beside it too, and in balances where a fault hides the forces."""

import numpy as np
import pytest

from slipwise.effects import catalogue
from slipwise.model import base_model
from slipwise.relations.measurement import compute_change_by_faults
from slipwise.relations.noise import compute_noise_of_correction, compute_reversal_noise
from slipwise.relations.parameters import Term
from slipwise.relations.run_data import FitRun, fit_runs
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="module")
def run() -> FitRun:
    return fit_runs(as_campaign(build_campaign(36206, effects=(), rig="bridge1")))[0]


def test_a_reversal_is_unsure_for_half_a_period_of_the_logger_before_and_after(run: FitRun) -> None:
    assert run.filtered is not None
    turn, reach = len(run.time) // 2, int(np.ceil(0.5 / (run.filtered.frequency * run.dt)))
    plain = np.where(np.arange(len(run.time)) < turn, -1000.0, 1000.0)[:, None]
    unsure = compute_reversal_noise(run, plain, plain, plain)[:, 0]
    # the slope of a step is seen on the samples before and after it
    assert np.flatnonzero(unsure).tolist() == list(range(turn - 1 - reach, turn + reach + 1))
    assert unsure.max() == pytest.approx(1e-4 * 1000.0 / run.dt)


def test_a_reversal_is_as_unsure_whichever_way_x_points(run: FitRun) -> None:
    plain = 1000.0 * np.sign(np.sin(np.arange(len(run.time)) / 40.0))[:, None]
    slower, faster = np.roll(plain, 2, axis=0), np.roll(plain, -7, axis=0)
    unsure = compute_reversal_noise(run, plain, slower, faster)
    mirrored = compute_reversal_noise(run, -plain, -faster, -slower)
    assert unsure == pytest.approx(mirrored)
    turns = np.flatnonzero(np.diff(plain[:, 0]))
    assert (unsure[turns - 6] > 0.0).all() and (unsure[turns + 2] > 0.0).all()


def test_a_fault_lets_through_as_much_of_an_error_as_it_changes_a_pulse(run: FitRun) -> None:
    gain, behind = (
        Term(catalogue()["channel_gain"], ("pad_A_Fx",), "pad_A_Fx"),
        Term(catalogue()["channel_filter"], tuple(f"pad_{p}_Fx" for p in "ABCD"), "pad_*_Fx"),
    )
    assert compute_change_by_faults((), {}, run) == pytest.approx(np.zeros(4))
    by_gain = compute_change_by_faults([gain], {f"{gain.label}.gain": 0.03}, run)
    assert by_gain == pytest.approx([0.03, 0.0, 0.0, 0.0])
    by_filter = compute_change_by_faults([behind], {f"{behind.label}.lag": 3e-3, f"{behind.label}.order": 2.0}, run)
    assert (by_filter > 0.5).all()


def test_the_pitch_rings_with_what_the_law_must_make_up_for() -> None:
    specimen = base_model("bridge1").specimen
    reversal = np.zeros((101, 4))
    reversal[50] = 100.0
    ringing = np.zeros(101)
    ringing[50:60] = 0.8 ** np.arange(10)
    more = compute_noise_of_correction(specimen, reversal, np.array([1.0, 0.0, 0.0, 0.0]), ringing)
    assert more["girder"][50] == pytest.approx(100.0 / specimen.mass)
    lever = specimen.centre_height / specimen.half_spacing[0]
    assert more["pitch"][50:60] == pytest.approx(100.0 * lever * 0.8 ** np.arange(10))
    assert more["pitch"][40] == pytest.approx(0.0, abs=1e-6)
