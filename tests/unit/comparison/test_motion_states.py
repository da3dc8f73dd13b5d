"""States of motion of a sine: it turns where it turns, and the way since then is what geometry says."""

from dataclasses import replace

import numpy as np
import pytest

from hypotheses import base
from slipwise.comparison.motion_states import STATES, classify_motion_states
from slipwise.record import Record
from slipwise.relations.run_data import FitRun

AMPLITUDE, FREQUENCY, DT = 0.02, 1.0, 0.002


@pytest.fixture
def sine() -> FitRun:
    """A run of bridge 1 that slides as a sine from its first sample on, and never sticks."""
    run, time = base().objective.runs[0], np.arange(5000) * DT
    phase = 2.0 * np.pi * FREQUENCY * time
    slip = AMPLITUDE * np.cos(phase)
    velocity = -AMPLITUDE * 2.0 * np.pi * FREQUENCY * np.sin(phase)
    states = replace(
        run.states,
        time=time,
        record=Record(time, {"slip_x": slip}),
        slip=np.stack([slip, 0.0 * slip], axis=1),
        velocity=np.stack([velocity, 0.0 * velocity], axis=1),
        stuck=np.zeros(len(time), dtype=bool),
        uplift=np.zeros(len(time), dtype=bool),
    )
    return replace(run, states=states)


def test_the_way_since_a_reversal_is_what_the_slip_has_gone(sine):
    found = classify_motion_states(sine)
    later = sine.time > 0.6
    turned = np.where(found.direction > 0, sine.slip + AMPLITUDE, AMPLITUDE - sine.slip)
    assert np.abs(found.since_turn - turned)[later].max() < 1e-4


def test_a_sine_goes_two_amplitudes_between_turns_and_four_in_a_period(sine):
    found = classify_motion_states(sine)
    assert found.way == pytest.approx(2.0 * AMPLITUDE, rel=0.01)
    assert found.path[-1] == pytest.approx(4.0 * AMPLITUDE * FREQUENCY * sine.time[-1], rel=0.01)


def test_fast_samples_are_steady_in_their_direction_and_turning_ones_are_reversals(sine):
    label = classify_motion_states(sine).label
    fast = np.abs(sine.velocity) > 0.05
    assert set(label[fast & (sine.velocity > 0)]) == {STATES.index("steady +")}
    assert set(label[fast & (sine.velocity < 0)]) == {STATES.index("steady −")}
    slow = (np.abs(sine.velocity) < 0.005) & (sine.time > 0.6) & (sine.time < 9.0)
    assert set(label[slow]) == {STATES.index("reversal")}


def test_stuck_and_lifted_samples_are_labelled_as_such(sine):
    sine.states.stuck[1000:1200] = True
    sine.states.uplift[3000:3100] = True
    label = classify_motion_states(sine).label
    assert set(label[1000:1200]) == {STATES.index("stick")}
    assert label[1201] == STATES.index("breakaway")
    assert set(label[3000:3100]) == {STATES.index("uplift")}
