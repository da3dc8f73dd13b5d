"""Audit and diagnosis say the same of a gauge: one names no fault, channel or size that the other contradicts."""

import pytest

from slipwise.diagnosis.diagnose import diagnose
from slipwise.instruments.audit import audit
from slipwise_benchmarks import GROUPS, Fault, build_campaign, with_faults
from slipwise_benchmarks.in_memory import as_campaign


@pytest.mark.long
def test_a_delay_of_all_load_cells_is_a_delay_of_one_size_to_both():
    fault = Fault("channel_delay", GROUPS["loads"], 2.19e-3)
    campaign = as_campaign(with_faults(build_campaign(951, effects=()), [fault], 7))
    (finding,) = audit(campaign).findings
    found = diagnose(campaign)
    assert (finding.what, finding.channel) == ("channel_delay", "pad_*_N")
    assert (found.verdict.kind, found.verdict.effects) == ("instrument", ("channel_delay",))
    (delay,) = [p for key, p in found.candidates[0].parameters.items() if key.endswith("delay")]
    assert delay.value == pytest.approx(finding.size, rel=0.05) == pytest.approx(fault.size, rel=0.05)
