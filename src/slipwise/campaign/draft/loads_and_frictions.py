"""Which forces of a laboratory are loads and which are frictions: a load stands, a friction turns with the slip.

Where a slider moves one way both stand: their names tell them, or the friction is the smaller one.
"""

from collections.abc import Sequence

import numpy as np

from slipwise.campaign.draft.column import Column

#: A load varies by less than this part of its mean [1].
_STEADY = 0.6
#: No pad of a shaking table carries more [N].
_LARGEST_LOAD = 1e8
#: Part of the samples that show on which sides of zero a force lies, the smaller side over the larger [1].
_ENDS, _BOTH_SIDES = 0.05, 0.2


def split_forces(
    columns: Sequence[Column], loaded: bool
) -> tuple[list[Column], list[Column], dict[str, tuple[str, str]]]:
    """Return loads, frictions, and why each is one with how sure that is, by header.

    Args:
        columns: of kind "force".
        loaded: whether another column tells the load, as a pressure does.
    """
    loads: list[Column] = []
    frictions: list[Column] = []
    open_: list[Column] = []
    told: dict[str, tuple[str, str]] = {}
    named_load = any(_says_load(c) and _stands(c) for c in columns)
    for column in columns:
        still = np.ptp(column.values) == 0.0
        if not _stands(column):
            if still:
                continue  # a gauge that shows nothing
            if _says_load(column) and not _turns(column):
                loads.append(column)
                told[column.header] = ("its name says load", "likely")
                continue
            frictions.append(column)
            told[column.header] = ("no mean", "likely") if _turns(column) else ("it does not stand", "likely")
        elif _says_friction(column) and not still:
            frictions.append(column)
            told[column.header] = ("its name says friction; it stands, as where a slider moves one way", "likely")
        elif _says_load(column) or ("loading" in column.meanings and not named_load):
            loads.append(column)
            told[column.header] = ("its name says load", "likely")
        else:
            open_.append(column)
    if loaded and len(columns) == len(open_) == 1 and np.ptp(open_[0].values) > 0.0:
        frictions.append(open_[0])
        told[open_[0].header] = ("the only force, beside a pressure that tells the load", "guess")
    else:
        _by_size(open_, loads, frictions, told)
    order = {c.header: k for k, c in enumerate(columns)}
    return sorted(loads, key=lambda c: order[c.header]), sorted(frictions, key=lambda c: order[c.header]), told


def _by_size(
    columns: Sequence[Column], loads: list[Column], frictions: list[Column], told: dict[str, tuple[str, str]]
) -> None:
    """Share out forces that stand and whose names say nothing: beside a load the smaller one is a friction."""
    two = len(columns) + len(loads) == 2 and not frictions
    ranked = sorted(columns, key=lambda c: -abs(float(np.median(c.values))))
    for column in ranked:
        if two and loads and np.ptp(column.values) > 0.0:
            frictions.append(column)
            told[column.header] = ("both forces stand, and it is the smaller one", "guess")
        else:
            loads.append(column)
            told[column.header] = ("the only load", "likely") if len(columns) == 1 else ("it stands", "guess")


def _says_load(column: Column) -> bool:
    return bool(column.meanings & {"load", "up"}) and not column.meanings & {"friction", "along"}


def _says_friction(column: Column) -> bool:
    return bool(column.meanings & {"friction", "along"}) and not column.meanings & {"load", "up"}


def _stands(column: Column) -> bool:
    middle = abs(float(np.median(column.values)))
    return 0.0 < middle < _LARGEST_LOAD and float(np.std(column.values)) < _STEADY * middle


def _turns(column: Column) -> bool:
    """Return whether a force lies on both sides of zero."""
    low, high = (float(v) for v in np.quantile(column.values, [_ENDS, 1.0 - _ENDS]))
    return low < 0.0 < high and min(-low, high) > _BOTH_SIDES * max(-low, high)
