"""Is there about one value, with wide skirts: a Lorentz line."""

from slipwise.discovery.form import Constant, Form

LINE = "1.0 / (1.0 + ((s - centre) / width) ** 2)"
AWAY = "2.0 * (s - centre) / (width * width)"
CENTRE = Constant("centre", "place", f"{AWAY} * ({LINE}) ** 2", (0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85))
WIDTH = Constant("width", "width", f"{AWAY} * (s - centre) / width * ({LINE}) ** 2", (0.03, 0.08, 0.2, 0.4))
FORM = Form(LINE, (CENTRE, WIDTH))
