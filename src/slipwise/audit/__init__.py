"""Audit: are the instruments telling the truth? No law of friction in it."""

from slipwise.audit.audit import audit
from slipwise.audit.correct import correct
from slipwise.audit.finding import AuditReport, Balance, Finding, LoggerEstimate
from slipwise.audit.logger import estimate_logger
from slipwise.audit.words import shown

__all__ = ["AuditReport", "Balance", "Finding", "LoggerEstimate", "audit", "correct", "estimate_logger", "shown"]
