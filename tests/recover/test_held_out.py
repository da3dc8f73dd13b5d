"""Held-out runs are opened once, at the end: nothing that is chosen or fitted may depend on them."""

from dataclasses import replace

import numpy as np
import pytest

from slipwise.campaign import Campaign
from slipwise.diagnosis.diagnose import diagnose
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


def with_noise_held_out(campaign: Campaign) -> Campaign:
    """Replace every answer that the held-out run has recorded by noise of its size; the table's motion stays."""
    rng = np.random.default_rng(5)
    runs = []
    for run in campaign.runs:
        if run.role == "holdout":
            noise = {
                name: np.mean(values) + np.std(values) * rng.normal(size=len(values))
                for name, values in run.record.channels.items()
                if name.startswith(("pad_", "girder_a"))
            }
            run = replace(run, record=run.record.replaced(**noise))
        runs.append(run)
    return replace(campaign, runs=tuple(runs))


@pytest.mark.long
def test_names_order_and_numbers_do_not_change_where_the_held_out_run_is_noise() -> None:
    campaign = as_campaign(build_campaign(41077, effects=("run_in", "uneven_seating"), size="medium", rig="bridge1"))
    seen, unseen = (diagnose(c) for c in (campaign, with_noise_held_out(campaign)))
    assert [h.names for h in seen.search.path] == [h.names for h in unseen.search.path]
    for one, other in zip(seen.search.path, unseen.search.path, strict=True):
        assert one.solution.values == pytest.approx(other.solution.values, rel=1e-6, abs=1e-12)
    assert unseen.confirmed is False and seen.confirmed is True
