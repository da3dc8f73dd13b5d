"""Grows and saturates: a hyperbolic tangent."""

from slipwise.discovery.form import Constant, Form

WIDTH = Constant("width", "width", "-s / (width * width) * (1.0 - tanh(s / width) ** 2)", (0.03, 0.06, 0.12, 0.25, 0.5))
FORM = Form("tanh(s / width)", (WIDTH,), contains=("linear",))
