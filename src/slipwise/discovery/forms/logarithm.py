"""Grows with the logarithm of the state, from a smallest value on."""

from slipwise.discovery.form import Constant, Form

WIDTH = Constant("width", "width", "-s / (width * (width + s))", (0.003, 0.01, 0.03, 0.1, 0.3))
FORM = Form("log(1.0 + s / width)", (WIDTH,), sized=True, contains=("linear",))
