"""Decays exponentially with the size of the state, with its sign."""

from slipwise.discovery.form import Constant, Form

SIZE = "exp(-abs(s) / width)"
WIDTH = Constant("width", "width", f"copysign(abs(s) / (width * width) * {SIZE}, s)", (0.02, 0.06, 0.15, 0.4))
FORM = Form(f"copysign({SIZE}, s)", (WIDTH,), signed=True)
