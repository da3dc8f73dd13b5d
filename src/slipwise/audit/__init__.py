"""Audit: are the instruments telling the truth? No law of friction in it."""

from slipwise.audit.audit import audit
from slipwise.audit.correct import correct
from slipwise.audit.finding import AuditReport, Balance, Finding, LoggerEstimate
from slipwise.audit.logger import estimate_logger

__all__ = ["AuditReport", "Balance", "Finding", "LoggerEstimate", "audit", "correct", "estimate_logger"]
