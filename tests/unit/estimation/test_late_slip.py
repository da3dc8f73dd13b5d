"""A slip gauge that lags behind the accelerometers is brought into step before velocities are used."""

import numpy as np
import pytest

from slipwise.relations.run_data import fit_runs
from slipwise.signals.shift import shift
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign

#: As far as cards of one logger may stand apart [s].
LATE = 1e-4


@pytest.fixture(scope="module")
def made():
    return build_campaign(31, effects=(), rig="bridge1")


def test_a_lag_of_a_tenth_of_a_millisecond_is_taken_out_of_the_velocity(made):
    run = fit_runs(as_campaign(made))[0]
    true = made.at_samples(run.name)["slip_vx"][: len(run.time)]
    late = shift(run.record["slip_x"], run.dt, LATE)
    lagging = run.with_record(run.record.replaced(slip_x=late), moved=True)
    corrected = lagging.slip_delay_corrected(LATE)
    sliding = run.states.valid & (run.velocity != 0.0)
    before, lagged, after = (float(np.std((r.velocity - true)[sliding])) for r in (run, lagging, corrected))
    assert lagged > 1.1 * before, "it must matter"
    assert after == pytest.approx(before, rel=0.02)


def test_what_is_at_rest_stays_at_rest(made):
    run = fit_runs(as_campaign(made))[0]
    still = run.velocity == 0.0
    assert still.any()
    assert np.all(run.slip_delay_corrected(LATE).velocity[still] == 0.0)
