"""Grows with the cube of the state."""

from slipwise.discovery.form import Constant, Form

REFERENCE = Constant("reference", "reference")
FORM = Form("(s / reference) ** 3", (REFERENCE,))
