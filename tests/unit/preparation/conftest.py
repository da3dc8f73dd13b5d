"""A campaign in which every gauge tells the truth."""

import pytest

from bench import build_campaign
from measured import as_campaign
from slipwise.campaign import Campaign


@pytest.fixture(scope="package")
def sound() -> Campaign:
    return as_campaign(build_campaign(51, effects=(), rig="bridge1"))
