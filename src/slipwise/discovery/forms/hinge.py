"""Begins at a place and grows in proportion from there."""

from slipwise.discovery.form import Constant, Form

REFERENCE = Constant("reference", "reference")
PLACE = Constant("place", "place", "-1.0 * (s > place) / reference", (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9))
FORM = Form("max(s - place, 0.0) / reference", (REFERENCE, PLACE), contains=("linear",))
