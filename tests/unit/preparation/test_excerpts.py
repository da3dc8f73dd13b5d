"""Of a campaign that is too long to be fitted whole a stretch of each run is taken, from before its first slip."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from slipwise.campaign import Campaign, Logger, Run
from slipwise.model import base_model
from slipwise.preparation.excerpts import cut_excerpts
from slipwise.record import Record

#: Samples a second, below the rate at which a record is thinned out.
RATE = 200.0


def campaign(*seconds: float, rest: float = 20.0) -> Campaign:
    """Make runs that rest and then slide, each so long."""
    runs = []
    for number, length in enumerate(seconds):
        time = np.arange(round(length * RATE)) / RATE
        slip = np.where(time > rest, 0.01 * np.sin(6.0 * (time - rest)), 0.0)
        record = Record(time, {"slip_x": slip, "pad_A_Fx": slip + 1.0})
        runs.append(Run(f"run{number}", "fit", record, None, None, f"run{number}.csv", ""))
    return Campaign("long", "bridge1", base_model("bridge1").specimen, Logger(), tuple(runs), Path())


def test_a_campaign_that_is_short_enough_stays_as_it_is():
    given = campaign(30.0, 30.0)
    found, _ = cut_excerpts(given, {}, most=20000)
    assert found is given


def test_what_short_runs_leave_goes_to_long_ones_which_begin_before_they_slide():
    found, _ = cut_excerpts(campaign(30.0, 300.0), {}, most=20000)
    short, long = (run.record for run in found.runs)
    assert (len(short), len(long)) == (6000, 14000)
    assert 16.0 <= long.time[0] < 16.1
    assert np.abs(long["slip_x"][:700]).max() == 0.0
    assert np.abs(long["slip_x"]).max() > 0.009


def test_a_run_that_slides_only_at_its_end_keeps_its_end():
    found, _ = cut_excerpts(campaign(100.0, rest=98.0), {}, most=10000)
    assert found.runs[0].record.time[-1] == campaign(100.0).runs[0].record.time[-1]


def test_samples_that_are_no_measurement_are_cut_alike_and_the_notes_say_what_is_fitted():
    given = campaign(30.0, 300.0)
    bad = {"run1": {"slip_x": given.runs[1].record["slip_x"] > 0.005}}
    found, masks = cut_excerpts(given, bad, most=20000)
    np.testing.assert_array_equal(masks["run1"]["slip_x"], found.runs[1].record["slip_x"] > 0.005)
    assert found.notes[-1] == "too long to be fitted whole: fits use run1 from 16 to 86 s of 300 s"


def test_a_run_without_slip_begins_where_it_was_recorded():
    given = campaign(300.0)
    record = Record(given.runs[0].record.time, {"pad_A_Fx": given.runs[0].record["pad_A_Fx"]})
    found, _ = cut_excerpts(replace(given, runs=(replace(given.runs[0], record=record),)), {}, most=20000)
    assert found.runs[0].record.time[0] == 0.0
