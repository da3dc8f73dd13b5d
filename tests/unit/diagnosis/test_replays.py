"""Replays for the viewer stand on the clock of the measurement."""

from dataclasses import replace

import pytest

from slipwise.diagnosis.replays import replays
from slipwise.estimation.base_fit import fit_base
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


def test_a_record_that_begins_late_is_replayed_at_its_own_times() -> None:
    campaign = as_campaign(build_campaign(31, effects=(), rig="bridge1"))
    late = [replace(run, record=replace(run.record, time=run.record.time + 3.186)) for run in campaign.runs]
    base = fit_base(replace(campaign, runs=tuple(late)))
    measured, [(label, record)] = replays(base, base, ())
    assert label == "base model" and measured.time[0] == pytest.approx(3.186)
    assert record.time[0] == pytest.approx(measured.time[0]) and record.dt == pytest.approx(measured.dt)
