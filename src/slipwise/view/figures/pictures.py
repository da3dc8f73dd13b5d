"""Pictures of one record: pad loads and their causes, modes, time histories; loops are beside in `loop_pictures`."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from slipwise.arrays import Array
from slipwise.channels import BUFFERS, PADS, pads_in
from slipwise.errors import InputError
from slipwise.record import Record
from slipwise.rig.load_modes import LoadModes, load_factors, load_modes, rest_shares, rigid_modes
from slipwise.view.figures.canvas import new_figure, save_figure
from slipwise.view.figures.loop_pictures import loops_figure
from slipwise.view.figures.pad_layout import layout_from_places
from slipwise.view.figures.panels import missing, note, stacked_panels
from slipwise.view.figures.style import (
    AXIS_COLOURS,
    BUFFER_COLOURS,
    EXPECTED,
    GIRDER,
    MUTED,
    PAD_COLOURS,
    SUM,
    TABLE,
    UPLIFT,
    buffer_colour,
    envelope,
    mixed,
    pad_colour,
    shown,
    shown_unit,
    styled,
)
from slipwise.view.geometry import RigGeometry
from slipwise.view.words.numbers import NOTHING

#: The pictures of a record, by the names of their files.
PICTURES: tuple[str, ...] = ("loops", "loads", "modes", "histories")
_SWINGING = ("pitch", "roll", "warp")
#: Time before and after this fraction of the squared accelerations' integral counts as quiet.
_QUIET = 0.01


def save_picture(name: str, record: Record, geometry: RigGeometry, folder: Path) -> Path:
    """Write one of `PICTURES`; a panel whose channels were not recorded says which are missing.

    Args:
        name: of the picture.
        record: measured or simulated.
        geometry: of its rig.
        folder: made if absent.

    Returns:
        The file, there whole or not at all.
    """
    figures = {
        "loops": lambda: loops_figure(record, geometry),
        "loads": lambda: loads_figure(record, geometry),
        "modes": lambda: modes_figure(record, geometry),
        "histories": lambda: histories_figure(record, geometry),
    }
    return save_figure(figures[name](), folder / f"{name}.png")


def loads_figure(record: Record, geometry: RigGeometry) -> Figure:
    """Draw every pad's load beside what inertia (Factor A) and rocking (Factor B) make of it."""
    layout = layout_from_places(geometry.pads, geometry.pad_places)
    names = [f"pad_{pad}_N" for pad in layout.pads]
    with styled():
        whole = record
        record, part = _shaken(whole)
        count = len(names)
        figure = new_figure(12.0, 1.2 + 1.8 * count, f"Load on the pads and its causes{part}")
        if not record.has_all(*names):
            missing(figure.subplots(), record, names)
            return figure
        panels = stacked_panels(figure, count, 2, sharex=True, sharey="col")
        try:
            shares = rest_shares(whole, layout.pads)
            factors = load_factors(record, geometry.carried_mass, geometry.gravity, geometry.basis, shares, layout.pads)
        except InputError as error:
            factors = None
            note(panels[0][1], str(error))
        for i, pad in enumerate(layout.pads):
            left, right = panels[i]
            left.set_title(layout.titles[pad], color=pad_colour(pad))
            left.set_ylabel("N [kN]")
            right.set_ylabel("part of N [kN]")
            left.axhline(0.0, color="#b8c0cb", linewidth=0.8, zorder=1)
            _shade_uplift(left, record, [pad])
            if factors is not None:
                _history(left, record.time, factors.inertia[:, i] / 1e3, EXPECTED, "Factor A: inertia", 2.2)
                _history(right, record.time, factors.rocking[:, i] / 1e3, pad_colour(pad), "Factor B: rocking", 1.2)
                _history(right, record.time, factors.rest[:, i] / 1e3, UPLIFT, "the rest", 0.9)
                swing = f"A ±{factors.inertia_swing[i]:.0%}, B ±{factors.rocking_swing[i]:.0%} of the load at rest"
                right.set_title(swing, fontweight="normal", fontsize=9.0, color=MUTED)
                _legend(right)
            _history(left, record.time, record[names[i]] / 1e3, pad_colour(pad), "N", 1.0)
            _legend(left)
        _label_time(figure, panels[-1])
    return figure


def modes_figure(record: Record, geometry: RigGeometry) -> Figure:
    """Draw heave, pitch, roll and warp of the pad loads over what a rigid girder's equilibrium asks for."""
    with styled():
        record, part = _shaken(record)
        names = [f"pad_{pad}_N" for pad in geometry.pads]
        if not record.has_all(*names) or len(names) < 3:
            figure = new_figure(12.0, 2.0, f"Pad loads as heave, pitch, roll and warp{part}")
            axes = figure.subplots()
            if not missing(axes, record, names):
                note(axes, "a girder that cannot turn has no pitch, roll or warp: its one pad carries what it carries")
            return figure
        modes = load_modes(record.stacked("pad_{}_N", geometry.pads), geometry.basis)
        corners = geometry.pads == PADS and np.array_equal(abs(geometry.basis.sides), np.ones((4, 2)))
        swings = {name: float(np.ptp(getattr(modes, name), axis=0).max(initial=0.0)) for name in _SWINGING}
        zero = [name for name, swing in swings.items() if swing < NOTHING * geometry.pad_load]
        left_out = f"; {' and '.join(zero)}: zero, not drawn" if zero else ""
        figure = new_figure(
            12.0, 0.6 + 1.9 * (4 - len(zero)), f"Pad loads as heave, pitch, roll and warp{left_out}{part}"
        )
        panels = [row[0] for row in stacked_panels(figure, 4 - len(zero), sharex=True)]
        framed = " + M_{storeys}" if geometry.storeys else ""
        try:
            rigid: LoadModes | None = rigid_modes(
                record, geometry.mass, geometry.gravity, geometry.girder_centre_height, geometry.half_spacing,
                geometry.pads_on, geometry.storeys,
            )  # fmt: skip
        except InputError as error:
            rigid = None
            note(panels[0], str(error))
        rows = (
            ("heave", "Heave  " + ("A + B + C + D" if corners else "the sum of the loads"), "rigid: $m(g + a_z)$", SUM),
            (
                "pitch",
                "Pitch  " + ("(A + C) − (B + D)" if corners else "the loads times their places along x"),
                "rigid: $(x\\,\\Sigma N - m a_x h" + framed + ")$ / half spacing",
                PAD_COLOURS["A"],
            ),
            (
                "roll",
                "Roll  " + ("(A + B) − (C + D)" if corners else "the loads times their places along y"),
                "rigid: likewise across",
                BUFFER_COLOURS["1"],
            ),
            (
                "warp",
                "Warp  " + ("(A + D) − (B + C)" if corners else "what is left of the loads"),
                "",
                PAD_COLOURS["B"],
            ),
        )
        drawn = [row for row in rows if row[0] not in zero]
        for axes, (name, title, expected, colour) in zip(panels, drawn, strict=True):
            axes.set_title(title)
            axes.set_ylabel(f"{name} [kN]")
            _shade_uplift(axes, record, pads_in(record.channels))
            if rigid is not None and expected:
                _history(axes, record.time, getattr(rigid, name) / 1e3, EXPECTED, expected, 2.4)
            for i, line in enumerate(np.atleast_2d(getattr(modes, name).T)):
                shade = colour if i == 0 else mixed(colour, "#ffffff", 0.3 * i)
                _history(axes, record.time, line / 1e3, shade, "pads" if i == 0 else "_", 1.0)
            _legend(axes)
            if name in ("roll", "warp"):
                _at_least(axes, 0.02 * geometry.pad_load / 1e3)
            if name == "warp":
                axes.text(
                    0.99, 0.9, "equilibrium leaves warp open: seating and twist set it", transform=axes.transAxes,
                    ha="right", va="top", fontsize=9.0, color=MUTED,
                )  # fmt: skip
        _label_time(figure, panels[-1:])
    return figure


def histories_figure(record: Record, geometry: RigGeometry | None = None) -> Figure:
    """Draw accelerations, slip and forces over time; of the rig's pads, or those of the record where none is given."""
    pads = geometry.pads if geometry else pads_in(record.channels) or PADS
    buffers = geometry.buffers if geometry and geometry.buffers else BUFFERS

    def per_pad(kind: str) -> list[tuple[str, str, str]]:
        return [(f"pad_{pad}_{kind}", f"pad {pad}", pad_colour(pad)) for pad in pads]

    def per_buffer(axis: str) -> list[tuple[str, str, str]]:
        return [(f"buffer_{b}_F{axis}", f"buffer {b}", buffer_colour(b)) for b in buffers]

    rows: list[tuple[str, list[tuple[str, str, str]]]] = [
        ("Acceleration along x", [("table_ax", "table", TABLE), ("girder_ax", "girder", GIRDER)]),
        ("Acceleration along y", [("table_ay", "table", TABLE), ("girder_ay", "girder", GIRDER)]),
        ("Acceleration, vertical", [("table_az", "table", TABLE), ("girder_az", "girder", GIRDER)]),
        ("Slip", [(f"slip_{axis}", axis, AXIS_COLOURS[axis]) for axis in "xy"]),
        ("Load on the pads", per_pad("N")),
        ("Friction of the pads along x", per_pad("Fx")),
        ("Friction of the pads along y", per_pad("Fy")),
        ("Buffers along x", per_buffer("x")),
        ("Buffers along y", per_buffer("y")),
    ]
    with styled():
        record, part = _shaken(record)
        still = {name for _, lines in rows for name, _, _ in lines if _is_still(record, name)}
        rows = [row for row in rows if not all(name in still for name, _, _ in row[1])]
        figure = new_figure(12.0, 1.2 + 1.7 * len(rows), f"Time histories{part}")
        panels = [row[0] for row in stacked_panels(figure, len(rows), sharex=True)]
        for axes, (title, lines) in zip(panels, rows, strict=True):
            axes.set_title(title)
            axes.set_ylabel(shown_unit(lines[0][0]))
            there = [line for line in lines if line[0] in record and line[0] not in still]
            if not there:
                missing(axes, record, [name for name, _, _ in lines])
                continue
            _shade_uplift(axes, record, pads_in(record.channels))
            for i, (name, label, colour) in enumerate(there):
                # Lines that lie on one another stay visible: the first ones are drawn wide, the others thin on top.
                _history(axes, record.time, shown(record, name), colour, label, 2.2 if 2 * i < len(there) else 0.9)
            _legend(axes)
        _label_time(figure, panels[-1:])
    return figure


def _is_still(record: Record, name: str) -> bool:
    """Return whether a channel along y or z is zero beside the one along x; along y it may also be absent."""
    beside = name.replace("_ay", "_ax").replace("_az", "_ax").replace("slip_y", "slip_x").replace("_Fy", "_Fx")
    if beside == name:
        return False
    if name not in record:
        return "y" in name
    return beside in record and float(np.ptp(record[name])) <= NOTHING * float(np.ptp(record[beside]))


def _shaken(record: Record) -> tuple[Record, str]:
    """Leave out long quiet stretches before and after the shaking; give the words that say so."""
    there = [name for name in ("table_ax", "table_ay", "table_az", "girder_ax") if name in record]
    whole = float(record.time[-1] - record.time[0])
    strength = np.cumsum(np.sum([record[name] ** 2 for name in there], axis=0)) if there else np.zeros(1)
    if strength[-1] <= 0.0:
        return record, ""
    begin, end = np.interp([_QUIET, 1.0 - _QUIET], strength / strength[-1], record.time)
    margin = 0.1 * (end - begin)
    begin, end = max(begin - margin, record.time[0]), min(end + margin, record.time[-1])
    if end - begin > 0.7 * whole:
        return record, ""
    return record.between(begin, end), f" ({begin:.0f} to {end:.0f} s of {whole:.0f} s)"


def _history(axes: Axes, time: Array, values: Array, colour: str, label: str, width: float) -> None:
    axes.plot(*envelope(time, values), color=colour, label=label, linewidth=width)
    axes.margins(x=0.0)


def _shade_uplift(axes: Axes, record: Record, pads: Sequence[str]) -> None:
    """Shade the time during which one of the pads carries nothing."""
    there = [f"pad_{pad}_N" for pad in pads if f"pad_{pad}_N" in record]
    if not there:
        return
    off = np.any([record[name] <= 0.0 for name in there], axis=0)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], off.astype(np.int8), [0]])))
    label = "uplift" if len(pads) == 1 else "a pad is lifted"
    for start, end in edges.reshape(-1, 2):
        last = min(end, len(record) - 1)
        axes.axvspan(
            float(record.time[start]), float(record.time[last]), color=UPLIFT, alpha=0.25, linewidth=0, label=label
        )
        label = "_"


def _at_least(axes: Axes, half: float) -> None:
    """Keep rounding errors from filling a panel."""
    low, high = axes.get_ylim()
    if high - low < 2.0 * half:
        axes.set_ylim(0.5 * (low + high) - half, 0.5 * (low + high) + half)


def _legend(axes: Axes) -> None:
    """Put the legend above the panel, where no line runs."""
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.97), ncols=6, borderaxespad=0.0)


def _label_time(figure: Figure, panels: Sequence[Axes]) -> None:
    for axes in panels:
        axes.set_xlabel("time [s]")
    figure.align_ylabels()
