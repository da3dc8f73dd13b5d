"""The picture of one effect: what it does at typical size."""

from matplotlib.figure import Figure

from slipwise.effects import Effect
from slipwise.studies.demonstration import demonstrate
from slipwise.units import parse_unit
from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.style import EXPECTED, MODEL_COLOURS

#: Units in which the axes of an effect's picture are shown.
_SHOWN = {"m": "mm", "N": "kN", "s": "s", "m/s^2": "m/s^2", "rad/s^2": "rad/s^2"}


def effect_picture(effect: Effect, *, target: str = "pad_A_Fx") -> Figure:
    """Draw what one effect does at typical size, and below what it adds; use within `styled()`.

    Args:
        effect: of the catalogue or a user's own; a law of the base is shown against the model without it.
        target: channel that an instrument effect is shown on.
    """
    shown = demonstrate(effect, target)
    units = [_SHOWN[u] for u in (shown.x_unit, shown.y_unit)]
    x, y = (parse_unit(u, si, "axis") for u, si in zip(units, (shown.x_unit, shown.y_unit), strict=True))
    figure = new_figure(5.6, 5.2, effect.name)
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2.0, 1.0])
    above.plot(shown.x / x, shown.base / y, color=EXPECTED, linewidth=2.4, label="without")
    above.plot(shown.x / x, shown.changed / y, color=MODEL_COLOURS[-1], linewidth=1.1, label=f"with {effect.name}")
    above.set_title(effect.equation, fontsize=9.0, fontweight="normal")
    above.set_ylabel(f"{shown.y_name} [{units[1]}]")
    above.legend(loc="best")
    below.plot(shown.x / x, (shown.changed - shown.base) / y, color=MODEL_COLOURS[-1], linewidth=1.1)
    below.set_ylabel(f"what it adds [{units[1]}]")
    below.set_xlabel(f"{shown.x_name} [{units[0]}]")
    return figure
