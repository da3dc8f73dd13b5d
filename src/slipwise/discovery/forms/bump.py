"""Is there about one value only: a Gaussian bump."""

from slipwise.discovery.form import Constant, Form

BUMP, AWAY = "exp(-(((s - centre) / width) ** 2))", "2.0 * (s - centre) / (width * width)"
CENTRE = Constant("centre", "place", f"{AWAY} * {BUMP}", (0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85))
WIDTH = Constant("width", "width", f"{AWAY} * (s - centre) / width * {BUMP}", (0.03, 0.08, 0.2, 0.4))
FORM = Form(BUMP, (CENTRE, WIDTH))
