"""Decays exponentially with the size of the state."""

from slipwise.discovery.form import Constant, Form

WIDTH = Constant("width", "width", "s / (width * width) * exp(-s / width)", (0.01, 0.03, 0.07, 0.15, 0.3, 0.6))
FORM = Form("exp(-s / width)", (WIDTH,), sized=True, contains=("linear",))
