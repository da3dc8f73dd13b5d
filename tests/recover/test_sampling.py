"""How often a logger sampled, and that every run was made twice, changes no verdict."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import resample_poly

from slipwise.campaign import Campaign, Run
from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.result import Diagnosis
from slipwise.record import Record
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="module")
def campaign() -> Campaign:
    whole = as_campaign(build_campaign(54010, effects=("buffer_hardening",), size="large"))
    return replace(whole, runs=(whole.runs[1], whole.runs[4]))


@pytest.fixture(scope="module")
def found(campaign: Campaign) -> Diagnosis:
    return diagnose(campaign)


def at_twice_the_rate(run: Run) -> Run:
    record = run.record
    time = record.time[0] + 0.5 * record.dt * np.arange(2 * len(record))
    channels = {name: resample_poly(values, 2, 1, padtype="line") for name, values in record.channels.items()}
    return replace(run, record=Record(time, channels, record.provenance))


def made_again(run: Run) -> Run:
    return replace(run, name=f"{run.name}_again", file=f"{run.name}_again.csv", sha256=run.sha256[::-1])


@pytest.mark.long
@pytest.mark.parametrize("change", ["twice the rate", "every run twice"])
def test_a_verdict_is_the_same_however_often_was_sampled(campaign, found, change):
    if change == "twice the rate":
        runs = tuple(at_twice_the_rate(run) for run in campaign.runs)
    else:
        runs = tuple(one for run in campaign.runs for one in (run, made_again(run)))
    other = diagnose(replace(campaign, runs=runs))
    assert found.verdict.kind == "named" and other.verdict.kind == found.verdict.kind
    assert other.verdict.effects == found.verdict.effects
    assert other.verdict.probability == pytest.approx(found.verdict.probability, abs=0.03)
