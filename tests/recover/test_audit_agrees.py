"""Audit and diagnosis say the same of a gauge: one names no fault, channel or size that the other contradicts."""

import pytest

from bench import GROUPS, Fault, build_campaign, with_faults
from measured import as_campaign
from slipwise.diagnosis.diagnose import diagnose
from slipwise.instruments.audit import audit

#: What is planted, and its size in the audit's words where the effect counts it alike.
PLANTED = {
    "a sign": (Fault("channel_sign", ("girder_ax",), -1.0), None),
    "a delay of the loads": (Fault("channel_delay", GROUPS["loads"], 2.19e-3), "delay"),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", PLANTED)
def test_what_the_audit_names_the_diagnosis_names_too(name):
    fault, parameter = PLANTED[name]
    campaign = as_campaign(with_faults(build_campaign(951, effects=()), [fault], 7))
    (finding,) = audit(campaign).findings
    found = diagnose(campaign)
    assert (found.verdict.kind, found.verdict.effects) == ("instrument", (finding.what,))
    assert finding.what == fault.effect
    if parameter is not None:
        (size,) = [p for key, p in found.candidates[0].parameters.items() if key.endswith(parameter)]
        assert size.value == pytest.approx(finding.size, rel=0.15)
