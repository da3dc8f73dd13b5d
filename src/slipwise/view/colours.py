"""Colours of pictures, recordings and pages; without matplotlib, so that a page is there at once.

Those of Okabe and Ito, told apart in every common form of colour blindness. Pads at +x are blue, pads at -x are orange,
so that rocking shows as blue against orange.
"""

from typing import Literal

#: Of the box around a sentence: what it tells is neither good nor bad, good, to be looked at, or bad.
Tone = Literal["plain", "good", "warn", "bad"]
INK, MUTED, GRID, PAPER = "#1b2733", "#5f6b7a", "#e4e8ed", "#ffffff"
PAD_COLOURS: dict[str, str] = {"A": "#0072b2", "B": "#d55e00", "C": "#56b4e9", "D": "#e69f00"}
#: Of pads beyond those, and of buffers beyond two.
_MORE_PADS: tuple[str, ...] = ("#8a5fb8", "#a6761d", "#1b9e9e", "#c44e7b", "#6a8f2b", "#7f8fa6")
_MORE_BUFFERS: tuple[str, ...] = ("#2f7d63", "#9adfc9")
#: Of quantities along x, y, z where no pad owns them.
AXIS_COLOURS: dict[str, str] = {"x": "#1b2733", "y": "#cc79a7", "z": "#009e73"}
BUFFER_COLOURS: dict[str, str] = {"1": "#009e73", "2": "#6fcfb3"}
TABLE, GIRDER, SUM, UPLIFT, EXPECTED = "#aab3bf", "#1b2733", "#1b2733", "#c2185b", "#b9c1cb"
#: The same roles on the dark ground of the 3-D viewer.
NIGHT, NIGHT_INK, NIGHT_MUTED, NIGHT_GRID = "#11151a", "#edf1f6", "#97a3b3", "#262e38"
#: For models held against a measurement, in this order.
MODEL_COLOURS: tuple[str, ...] = ("#e69f00", "#56b4e9", "#009e73", "#cc79a7", "#d55e00", "#0072b2")


def pad_colour(pad: str) -> str:
    """Return the colour of a pad by its name: letters in turn, words by their letters."""
    number = ord(pad) - ord("E") if len(pad) == 1 else sum(pad.encode())
    return PAD_COLOURS.get(pad, _MORE_PADS[number % len(_MORE_PADS)])


def buffer_colour(buffer: str) -> str:
    """Return the colour of a buffer by its name."""
    return BUFFER_COLOURS.get(buffer, _MORE_BUFFERS[sum(buffer.encode()) % len(_MORE_BUFFERS)])
