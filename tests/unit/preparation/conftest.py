"""A campaign in which every gauge tells the truth."""

import pytest

from measured import as_campaign
from slipwise.campaign import Campaign
from slipwise_benchmarks import build_campaign


@pytest.fixture(scope="package")
def sound() -> Campaign:
    return as_campaign(build_campaign(51, effects=(), rig="bridge1"))
