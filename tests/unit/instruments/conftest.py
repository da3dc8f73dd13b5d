"""A campaign in which every gauge tells the truth, and what becomes of it with a faulty one."""

import pytest

from slipwise.campaign import Campaign
from slipwise.instruments.audit import audit
from slipwise.instruments.report import AuditReport
from slipwise_benchmarks import Fault, build_campaign, with_faults
from slipwise_benchmarks.in_memory import as_campaign


@pytest.fixture(scope="package")
def made():
    return build_campaign(51, effects=(), rig="bridge1")


@pytest.fixture(scope="package")
def sound(made) -> Campaign:
    return as_campaign(made)


@pytest.fixture(scope="package")
def measured_with(made):
    """Give a function that measures the same shaking with faults."""
    return lambda *faults: as_campaign(with_faults(made, faults, 7))


@pytest.fixture(scope="package")
def sound_report(sound) -> AuditReport:
    return audit(sound)


@pytest.fixture(scope="package")
def late_slip_report(late_slip) -> AuditReport:
    return audit(late_slip)


@pytest.fixture(scope="package")
def late_slip(measured_with) -> Campaign:
    return measured_with(Fault("channel_delay", ("slip_x",), 4e-3))
