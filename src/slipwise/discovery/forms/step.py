"""Steps from one value to another, over a width, at a place."""

from slipwise.discovery.form import Constant, Form

SLOPE = "0.5 * (1.0 - tanh((s - place) / width) ** 2)"
PLACE = Constant("place", "place", f"-{SLOPE} / width", (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9))
WIDTH = Constant("width", "width", f"-{SLOPE} * (s - place) / (width * width)", (0.02, 0.06, 0.15))
FORM = Form("0.5 * (1.0 + tanh((s - place) / width))", (PLACE, WIDTH), contains=("saturation",))
