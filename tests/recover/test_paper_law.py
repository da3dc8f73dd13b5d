"""The paper's own discovery, found by the tool: Coulomb lacks that friction grows with pressure and with speed."""

from dataclasses import replace

import pytest

from slipwise.diagnosis.diagnose import diagnose
from slipwise.model import Model
from slipwise_benchmarks import build_campaign
from slipwise_benchmarks.in_memory import as_campaign

pytestmark = pytest.mark.slow


@pytest.mark.long
def test_coulomb_lacks_the_real_area_of_contact_and_the_shear_rate():
    campaign = as_campaign(build_campaign(57, effects=(), rig="bridge1"))
    fewer = replace(campaign, runs=(campaign.runs[0], campaign.runs[2], campaign.runs[4]))
    found = diagnose(fewer, Model(fewer.specimen, ()))
    assert found.verdict.kind == "named"
    assert set(found.verdict.effects) == {"contact_area", "shear_rate"}
    assert found.final_error < 1.15 < found.base_error
