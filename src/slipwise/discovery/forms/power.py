"""Grows with a power of the size of the state; the sign stays.

Makes no sense at an exponent near one: that is linear.
"""

from slipwise.discovery.form import Constant, Form

REFERENCE = Constant("reference", "reference")
SIZE = "(abs(s) / reference) ** exponent"
SLOPE = f"copysign({SIZE}, s) * log(max(abs(s) / reference, 1e-300))"
EXPONENT = Constant("exponent", "number", SLOPE, (0.3, 0.5, 1.5, 2.0, 3.0), 0.1, 5.0)
FORM = Form(f"copysign({SIZE}, s)", (REFERENCE, EXPONENT), contains=("linear", "square", "cube"))
