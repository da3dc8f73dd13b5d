"""What gauges of friction lost must not make the girder ring."""

import pytest

from slipwise.evidence.residual_summary import summarise_residuals
from slipwise.preparation.prepare import prepare
from slipwise.preparation.prepared import fit_prepared
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.campaign import with_faults
from slipwise_benchmarks.faults import Fault
from slipwise_benchmarks.in_memory import as_campaign


@pytest.mark.slow
def test_pitch_does_not_ring_with_samples_that_gauges_of_friction_have_lost() -> None:
    """At a reversal a held sample is off by kilonewtons, and pitch rings with it: by 8.6 noise variances once."""
    made = build_campaign(61, effects=(), rig="bridge2")
    gauges = tuple(f"pad_{p}_Fx" for p in "ABCD")
    ready = prepare(as_campaign(with_faults(made, [Fault("dropped_samples", gauges, 0.06, "held")], 5)))
    assert {name for fault in ready.faults for name in fault.channels} == set(gauges)
    base = fit_prepared(ready)
    levels = summarise_residuals(base.objective, base.solution)
    assert max(levels.fitted_level("pitch"), levels.held_out_level("pitch")) < 1.25
