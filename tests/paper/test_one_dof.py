"""One degree of freedom, as the paper analysed it."""

from dataclasses import replace

import numpy as np
import pytest

from shaking import coulomb
from slipwise.model import base_model, use
from slipwise.motion import TableMotion, load_motion
from slipwise.simulation.replay import replay
from slipwise.studies.paper.one_dof import one_dof

G = 9.80665


def half_range(model, spec):
    motion = load_motion(spec)
    answer, steady = one_dof(model, motion), motion.steady
    inside = (answer.time > steady.end - steady.period) & (answer.time < steady.end)
    return float(np.ptp(answer.slip[inside]) / 2)


@pytest.mark.parametrize(
    ("rig", "spec", "expected"),
    [("bridge1", "sine:2Hz,0.3g,cycles=24", 14.7959e-3), ("bridge2", "sine:4Hz,0.5g,cycles=24", 11.3766e-3),
     ("block", "sine:2Hz,0.3g,cycles=24", 15.0134e-3)],
)  # fmt: skip
def test_coulomb_friction_slides_as_far_as_an_event_driven_integrator_says(rig, spec, expected):
    assert half_range(coulomb(rig, 0.113085), spec) == pytest.approx(expected, rel=2e-3)


def test_the_papers_law_slides_as_far_as_with_rocking_because_rocking_cancels():
    # Eq. (7); the rocking of the rig is what one degree of freedom has not.
    assert half_range(base_model("bridge1"), "sine:2Hz,0.3g,cycles=24") == pytest.approx(14.4045e-3, rel=3e-3)


def test_below_the_slow_friction_nothing_slips():
    motion = load_motion("sine:2Hz,0.044g,cycles=12")
    assert np.ptp(one_dof(base_model("block"), motion).slip) < 1e-12


def test_friction_opposes_slip_and_is_lost_with_the_load():
    motion = load_motion("sine:2Hz,0.5g,cycles=12,vertical=3Hz,1.4g")
    answer = one_dof(base_model("bridge1"), motion)
    off = answer.load == 0.0
    assert off.any()
    assert np.all(answer.friction[off] == 0.0)
    rate = np.diff(answer.slip)
    slides = np.abs(rate) > 0.02 * np.abs(rate).max()  # a step in which slip turns has both signs
    assert np.all(answer.friction[1:][slides] * rate[slides] >= 0.0)


def test_work_of_the_table_goes_into_friction():
    motion = load_motion("sine:2Hz,0.3g,cycles=16")
    model = base_model("bridge1")
    answer = one_dof(model, motion)
    table = motion.acceleration[: len(answer.slip), 0]
    put_in = -model.specimen.mass * np.sum(0.5 * (table[1:] + table[:-1]) * np.diff(answer.slip))
    assert answer.energy == pytest.approx(put_in, rel=1e-4)  # a little stays in the buffers


def test_effects_with_memory_act_as_in_the_rig():
    model = base_model("bridge1").adding(use("heating"), use("run_in"))
    motion = load_motion("quake:seed=1,peak=0.7g,strong=2s")
    single, full = one_dof(model, motion), replay(model, motion)
    assert single.energy == pytest.approx(sum(full.pad_energy.values()), rel=0.01)
    plain = one_dof(base_model("bridge1"), motion).energy
    assert abs(single.energy / plain - 1.0) > 0.02


def test_half_the_step_changes_little():
    motion = load_motion("quake:seed=2,peak=0.7g,strong=2s,vertical=0.3g")
    coarse, fine = (one_dof(base_model("bridge1"), motion, dt) for dt in (5e-4, 2.5e-4))
    assert np.abs(fine.slip[::2] - coarse.slip).max() < 0.01 * np.ptp(fine.slip)


def test_a_push_that_ends_leaves_it_stuck_within_the_band_of_alpha():
    # It stops where the buffers cannot overcome alpha N, |x| <= 1.303 mm.
    values = np.zeros((8000, 3))
    values[200:600, 0] = 0.6 * G
    answer = one_dof(base_model("bridge1"), TableMotion(5e-4, values, "a push", ("", "", "")))
    assert np.ptp(answer.slip[-500:]) < 1e-9
    assert 0.0 < abs(answer.slip[-1]) <= 1.303e-3
    assert replace(base_model("bridge1")).specimen.weight * 0.046 / 3.4612e6 == pytest.approx(1.303e-3, abs=1e-6)
