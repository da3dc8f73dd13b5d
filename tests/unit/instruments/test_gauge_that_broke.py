"""A gauge that breaks in the last run is seen in that run by itself, where an audit of all runs sees a part of it."""

from slipwise.monitoring.gauges import find_faults_of_runs
from slipwise_benchmarks import Fault


def test_a_cell_that_reads_too_much_in_the_last_run_alone_is_accused_there(measured_with):
    campaign = measured_with(Fault("channel_gain", ("pad_B_N",), 0.06, runs=(4,)))
    names = [run.name for run in campaign.runs]
    assert not find_faults_of_runs(campaign, names[:4])
    assert [f.name for f in find_faults_of_runs(campaign, names[4:])] == ["channel_gain:pad_B_N"]
