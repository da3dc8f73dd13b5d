"""One visual identity for pictures, recordings, reports and tables; its colours are in `colours`."""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

import matplotlib as mpl
import numpy as np

from slipwise.arrays import Array
from slipwise.channels import channel
from slipwise.record import Record
from slipwise.units import affine
from slipwise.view.colours import (  # noqa: F401  whoever draws takes all from here
    AXIS_COLOURS,
    BUFFER_COLOURS,
    EXPECTED,
    GIRDER,
    GRID,
    INK,
    MODEL_COLOURS,
    MUTED,
    NIGHT,
    NIGHT_GRID,
    NIGHT_INK,
    NIGHT_MUTED,
    PAD_COLOURS,
    PAPER,
    SUM,
    TABLE,
    UPLIFT,
    buffer_colour,
    pad_colour,
)

#: Panels of the reference rig's pads in a 2 x 2 grid seen from above, x to the right and y up: (row, column).
PAD_PANELS: dict[str, tuple[int, int]] = {"B": (0, 0), "A": (0, 1), "D": (1, 0), "C": (1, 1)}
PAD_PLACES: dict[str, str] = {"A": "+x +y", "B": "−x +y", "C": "+x −y", "D": "−x −y"}

_RC: dict[Any, Any] = {
    "figure.facecolor": PAPER,
    "figure.dpi": 100,
    "savefig.dpi": 150,
    "font.family": ["sans-serif"],
    "font.sans-serif": ["DejaVu Sans", "Verdana", "Arial"],
    "font.size": 10.0,
    "axes.titlesize": 11.0,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.titlecolor": INK,
    "axes.labelcolor": MUTED,
    "axes.edgecolor": "#b8c0cb",
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": GRID,
    "grid.linewidth": 0.8,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "lines.linewidth": 1.1,
    "lines.solid_joinstyle": "round",
    "legend.frameon": False,
    "legend.fontsize": 9.0,
    "text.color": INK,
    "axes.unicode_minus": True,
    "svg.fonttype": "none",
    "svg.hashsalt": "slipwise",
}
_RC_NIGHT: dict[Any, Any] = {
    **_RC,
    "figure.facecolor": NIGHT,
    "axes.facecolor": NIGHT,
    "savefig.facecolor": NIGHT,
    "axes.titlecolor": NIGHT_INK,
    "axes.labelcolor": NIGHT_MUTED,
    "axes.edgecolor": "#3a4552",
    "grid.color": NIGHT_GRID,
    "xtick.color": NIGHT_MUTED,
    "ytick.color": NIGHT_MUTED,
    "text.color": NIGHT_INK,
}
_SHOWN_AS = {"m/s^2": "m/s²", "degC": "°C"}


@contextmanager
def styled(night: bool = False) -> Iterator[None]:
    """Draw with the house's style inside, by night on a dark ground, leaving matplotlib's settings as they were.

    It begins from matplotlib's own defaults: a matplotlibrc of the current folder could start LaTeX, for one.
    """
    settings: dict[Any, Any] = {**_defaults(), **(_RC_NIGHT if night else _RC)}
    with mpl.rc_context(settings):
        yield


@cache
def _defaults() -> dict[str, Any]:
    return {key: value for key, value in mpl.rcParamsDefault.items() if key != "backend"}


def mixed(colour: str, ground: str, share: float) -> str:
    """Mix a colour with a ground; share 1 is the colour itself."""
    both = zip(rgb(colour), rgb(ground), strict=True)
    return "#" + "".join(f"{round(share * own + (1.0 - share) * other):02x}" for own, other in both)


def rgb(colour: str) -> tuple[int, int, int]:
    """Turn "#0072b2" into (0, 114, 178)."""
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)


def packed(colour: str) -> int:
    """Turn "#0072b2" into 0x0072b2ff."""
    return int(colour[1:], 16) << 8 | 0xFF


def shown_unit(name: str) -> str:
    """Return the unit in which a channel is shown, as printed beside an axis."""
    unit = channel(name).shown_in
    return _SHOWN_AS.get(unit, unit)


def shown(record: Record, name: str) -> Array:
    """Return a channel in the unit in which it is shown (mm, kN, m/s^2)."""
    known = channel(name)
    factor, offset = affine(known.shown_in, known.unit, name)
    return (record[name] - offset) / factor


def envelope(time: Array, values: Array, bins: int = 1500) -> tuple[Array, Array]:
    """Thin a long history for the eye: the smallest and the largest value of every bin, in the order they occur.

    Args:
        time: (n,).
        values: (n,).
        bins: at most twice as many points are left.

    Returns:
        Thinned time and values; no extreme is lost.
    """
    size = len(time) // bins
    if size < 3:
        return time, values
    whole = len(time) // size * size
    rows = values[:whole].reshape(-1, size)
    first = np.arange(0, whole, size)
    chosen = np.sort(np.stack([first + rows.argmin(axis=1), first + rows.argmax(axis=1)]), axis=0).T.ravel()
    chosen = np.unique(np.concatenate([chosen, np.arange(whole, len(time)), [0, len(time) - 1]]))
    return time[chosen], values[chosen]
