"""Response spectra of acceleration: of a motion, from a file, and a motion scaled to one.

Pseudo-acceleration w^2 max |q| of an oscillator with 5 % of critical damping, along x. A motion is scaled by one
factor, at which the mean of the logarithm of its spectrum over that of the target is zero; its shape stays.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from slipwise.arrays import Array
from slipwise.data_files.column_names import name_and_unit
from slipwise.data_files.table import open_table
from slipwise.errors import InputError
from slipwise.motion.shaping import scale
from slipwise.motion.table_motion import TableMotion
from slipwise.short_repr import short_repr
from slipwise.signals.oscillator import oscillator
from slipwise.units import parse_unit

#: Damping that a spectrum has where nothing else is said, of critical [1].
DAMPING = 0.05
#: Periods at which a motion is held against a target, at most.
_MOST = 30
#: An oscillator shorter than so many steps of the motion is not seen by it.
_STEPS = 4.0


@short_repr
@dataclass(frozen=True)
class ResponseSpectrum:
    """A spectrum of acceleration.

    Attributes:
        period: (n,) rising [s].
        acceleration: (n,) [m/s^2].
    """

    period: Array
    acceleration: Array


def read_spectrum(path: Path | str) -> ResponseSpectrum:
    """Read a spectrum: a table of two columns, period and acceleration, with units in their headers.

    Raises:
        InputError: no such file, no two columns, or values that no spectrum has.
        UnitError: no unit, or one of the wrong dimension.
    """
    table = open_table(Path(path))
    if len(table.headers) != 2:
        raise InputError(
            f"{path}: a spectrum has two columns, period and acceleration, as 'period [s],acceleration [g]'; this file "
            f"has {len(table.headers)}: {', '.join(table.headers)}"
        )
    units = [name_and_unit(header).unit for header in table.headers]
    factors = [
        parse_unit(unit or "", wanted, f"column {header!r} of {Path(path).name}")
        for unit, wanted, header in zip(units, ("s", "m/s^2"), table.headers, strict=True)
    ]
    period, acceleration = (f * np.asarray(c) for f, c in zip(factors, table.columns([0, 1]).values, strict=True))
    kept = period > 0.0
    period, acceleration = period[kept], acceleration[kept]
    if len(period) < 2 or not (np.all(np.diff(period) > 0.0) and np.all(acceleration > 0.0)):
        raise InputError(
            f"{path}: a spectrum has two or more periods that rise from line to line, and accelerations above 0"
        )
    return ResponseSpectrum(period, acceleration)


def response_spectrum(motion: TableMotion, period: Sequence[float] | Array) -> ResponseSpectrum:
    """Return the spectrum of a motion along x at these periods [s]."""
    push = -np.asarray(motion.acceleration[:, 0])
    found = []
    for each in period:
        quiet = np.zeros(round(each / motion.dt))  # the oscillator may swing furthest after the motion has ended
        swing = oscillator(np.concatenate([push, quiet]), motion.dt, 1.0 / each, DAMPING, 0)
        found.append((2.0 * np.pi / each) ** 2 * float(np.abs(swing).max()))
    return ResponseSpectrum(np.asarray(period, dtype=float), np.array(found))


def scale_to_spectrum(motion: TableMotion, target: ResponseSpectrum) -> TableMotion:
    """Scale all components by one factor so that the spectrum along x has the level of the target.

    Raises:
        InputError: the table rests along x, or the motion is sampled too coarsely for every period of the target.
    """
    seen = target.period[target.period >= _STEPS * motion.dt]
    if not len(seen):
        raise InputError(f"{motion.title}: its step of {motion.dt:g} s is too coarse for every period of the spectrum")
    if not motion.peaks[0]:
        raise InputError(f"{motion.title}: nothing moves in x, so it cannot be scaled to a spectrum")
    chosen = np.geomspace(seen[0], seen[-1], min(len(seen), _MOST)) if len(seen) > 1 else seen
    wanted = np.exp(np.interp(np.log(chosen), np.log(target.period), np.log(target.acceleration)))
    own = response_spectrum(motion, chosen).acceleration
    return scale(motion, float(np.exp(np.mean(np.log(wanted / own)))))
