"""Predicted runs beside measured ones, sample by sample: slip, friction and loads, with no fit at all."""

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Campaign
from slipwise.prediction.result import ComparedRun
from slipwise.record import Record


def compare_runs(measured: Campaign, predicted: Campaign, put_right: Campaign) -> tuple[ComparedRun, ...]:
    """Compare every run that was predicted.

    Args:
        measured: the campaign, for the names of its runs.
        predicted: as the program wrote it.
        put_right: the measured campaign with its channels put right.
    """
    right = {run.name: run.record for run in put_right.runs}
    pads = measured.specimen.pads
    return tuple(_compared(run.name, right[run.name], run.record, pads) for run in predicted.runs if run.name in right)


def _compared(name: str, measured: Record, predicted: Record, pads: tuple[str, ...]) -> ComparedRun:
    slips = _pair("slip_x", measured, predicted)
    forces = [pair for pad in pads if (pair := _pair(f"pad_{pad}_Fx", measured, predicted)) is not None]
    peaks = (np.nan, np.nan) if slips is None else (float(np.abs(slips[0]).max()), float(np.abs(slips[1]).max()))
    return ComparedRun(
        name,
        peaks,
        np.nan if slips is None else _error([slips]),
        _error(forces) if forces else np.nan,
        (_load_change(measured, pads), _load_change(predicted, pads)),
    )


def _pair(channel: str, measured: Record, predicted: Record) -> tuple[Array, Array] | None:
    """Return a channel of both at the measured instants that were predicted; None where one of them lacks it."""
    if channel not in measured or channel not in predicted:
        return None
    inside = (measured.time >= predicted.time[0]) & (measured.time <= predicted.time[-1])
    time = measured.time[inside]
    return measured[channel][inside], np.interp(time, predicted.time, predicted[channel])


def _error(pairs: list[tuple[Array, Array]]) -> float:
    apart = sum(float(np.sum((there - here) ** 2)) for here, there in pairs)
    return float(np.sqrt(apart / sum(float(np.sum(here**2)) for here, _ in pairs)))


def _load_change(record: Record, pads: tuple[str, ...]) -> float:
    """Return the rms of what the loads of the pads change by over their mean [1], of the pad with most."""
    loads = [record[f"pad_{pad}_N"] for pad in pads if f"pad_{pad}_N" in record]
    return max((float(load.std() / max(abs(load.mean()), 1e-9)) for load in loads), default=np.nan)
