"""Goes up and down with the state: a sine. Makes no sense with less than two periods in the data."""

from slipwise.discovery.form import Constant, Form

ANGLE = "2.0 * pi * s / period + phase"
PERIOD = Constant("period", "period", f"-2.0 * pi * s / (period * period) * cos({ANGLE})")
PHASE = Constant("phase", "number", f"cos({ANGLE})", (0.0, 0.785, 1.571, 2.356), -3.2, 6.4)
FORM = Form(f"sin({ANGLE})", (PERIOD, PHASE))
