"""A campaign in which every gauge tells the truth."""

import pytest

from slipwise.campaign import Campaign
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="package")
def sound() -> Campaign:
    return as_campaign(build_campaign(51, effects=(), rig="bridge1"))
