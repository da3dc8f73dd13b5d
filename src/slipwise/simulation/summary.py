"""A replay in a few numbers: summary.json."""

from typing import Any

import numpy as np

from slipwise.motion.table_motion import Steady, TableMotion
from slipwise.record import Record
from slipwise.simulation.result import Replay

_CYCLES = 4


def slip_half_range(record: Record, steady: Steady | None, axis: str = "x") -> float:
    """Half of largest minus smallest slip along an axis [m].

    Over the last four cycles at full amplitude of a sine, over the whole record otherwise.
    """
    slip = record[f"slip_{axis}"]
    if steady is not None:
        start = max(steady.start, steady.end - _CYCLES * steady.period)
        inside = (record.time >= start) & (record.time <= steady.end)
        if inside.any():
            slip = slip[inside]
    return float(np.ptp(slip) / 2.0)


def summary(replay: Replay, motion: TableMotion) -> dict[str, Any]:
    """Return the numbers of summary.json.

    Args:
        replay: the answer.
        motion: as it was given.
    """
    pads = {
        pad: {
            "N_min_kN": replay.load_range[pad][0] / 1e3,
            "N_max_kN": replay.load_range[pad][1] / 1e3,
            "F_max_kN": replay.largest_friction[pad] / 1e3,
            "energy_kN_cm": replay.pad_energy[pad] / 10.0,
        }
        for pad in replay.load_range
    }
    return {
        "schema": 1,
        "rig": replay.record.provenance["rig"],
        "motion": motion.title,
        "slip_x_half_range_mm": slip_half_range(replay.record, motion.steady) * 1e3,
        "slip_x_max_mm": max(map(abs, replay.slip_range)) * 1e3,
        "slip_y_half_range_mm": slip_half_range(replay.record, motion.steady, "y") * 1e3,
        "slip_y_max_mm": max(map(abs, replay.slip_y_range)) * 1e3,
        "slip_max_mm": replay.largest_slip * 1e3,
        "energy_kN_cm": sum(p["energy_kN_cm"] for p in pads.values()),
        "energy_x_kN_cm": replay.energy_along[0] / 10.0,
        "energy_y_kN_cm": replay.energy_along[1] / 10.0,
        "pads": pads,
        "uplift_s": replay.uplift,
        "energy_balance_error": replay.energy_error,
        "dt_s": replay.dt,
        "steps": replay.steps,
        "wall_s": replay.computing,
        "compile_s": replay.compiling,
        "engine": replay.engine,
    }
