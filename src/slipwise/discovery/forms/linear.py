"""Grows in proportion to the state."""

from slipwise.discovery.form import Constant, Form

REFERENCE = Constant("reference", "reference")
FORM = Form("s / reference", (REFERENCE,))
