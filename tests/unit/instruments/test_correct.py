"""A correction is made only where it is named; it takes the fault out, and the campaign says that it was made."""

import numpy as np
import pytest

from slipwise.errors import InputError, UnknownNameError
from slipwise.instruments.audit import audit
from slipwise.instruments.corrections import correct
from slipwise_benchmarks import GROUPS, Fault


def test_an_audit_changes_no_data(late_slip):
    before = {run.name: run.record["slip_x"].copy() for run in late_slip.runs}
    audit(late_slip)
    assert all(np.array_equal(before[run.name], run.record["slip_x"]) for run in late_slip.runs)


def test_a_named_delay_is_taken_out_and_written_down(late_slip, late_slip_report, sound):
    mended, done = correct(late_slip, late_slip_report, ["channel_delay:slip_x"])
    assert audit(mended).findings == ()
    assert mended.notes[-1] == done[0] and "slip_x" in done[0] and "late" in done[0]
    here, true = mended.run("quake_hv").record["slip_x"], sound.run("quake_hv").record["slip_x"]
    noise = 1.5 * np.sqrt(2.0) * 3e-5
    assert np.std((here - true)[20:-20]) < noise < np.std(late_slip.run("quake_hv").record["slip_x"] - true)
    other = mended.run("quake_hv").record["girder_ax"]
    assert np.array_equal(other, late_slip.run("quake_hv").record["girder_ax"])


def test_the_kind_of_a_fault_alone_names_all_findings_of_that_kind(late_slip, late_slip_report):
    _, done = correct(late_slip, late_slip_report, ["channel_delay"])
    assert len(done) == 1


def test_repeated_samples_are_bridged(measured_with):
    held = measured_with(Fault("dropped_samples", GROUPS["forces"], 0.02, "held", seed=3))
    mended, _ = correct(held, audit(held), ["dropped_samples"])
    values = mended.run("quake_hv").record["pad_A_Fx"]
    assert np.mean(values[1:] == values[:-1]) < 1e-3


def test_what_a_rail_has_cut_off_cannot_be_brought_back(measured_with):
    clipped = measured_with(Fault("channel_clipping", ("pad_A_Fx",), 0.6))
    with pytest.raises(InputError, match="cannot be brought back"):
        correct(clipped, audit(clipped), ["channel_clipping"])


def test_a_correction_of_what_was_not_found_names_what_was(late_slip, late_slip_report):
    with pytest.raises(UnknownNameError, match="channel_delay:slip_x"):
        correct(late_slip, late_slip_report, ["channel_delay:slip_y"])
