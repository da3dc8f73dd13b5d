"""Faults of gauges inside a fit: put on what is predicted, or taken out of what was measured with its noise scaled."""

from collections.abc import Mapping, Sequence

import numpy as np

from slipwise.arrays import Array
from slipwise.channels import VELOCITY_CHANNELS, channels_like
from slipwise.effects import Effect
from slipwise.model import EffectUse
from slipwise.record import Record
from slipwise.relations.inverse_filter import Spectrum, remove_filter_from_spectrum, without_filter
from slipwise.relations.parameters import Term
from slipwise.relations.run_data import FitRun, smooth_record
from slipwise.rig.load_basis import warps


def is_on_force_gauge(term: Term) -> bool:
    """Return whether a gauge's fault shows on friction only: it then acts on the prediction."""
    if term.effect.target:
        return all(t.endswith(("_Fx", "_Fy")) for t in term.targets)
    return "undo" not in term.effect.hooks or all("_F" in c for c in term.effect.moves)


def apply_gauge_faults(terms: Sequence[Term], values: Mapping[str, float], record: Record) -> Record:
    """Put the faults of gauges on a record."""
    for term in terms:
        for entry in term.uses(values):
            record = _call(entry.effect, "gauge", record, entry.target, entry.values)
    return record


def is_shifting(terms: Sequence[Term]) -> bool:
    """Return whether any of these faults moves noise in time: see `without`."""
    return any(t.effect.shifts for t in terms)


def apply_on_force(
    terms: Sequence[Term],
    values: Mapping[str, float],
    run: FitRun,
    force: Array,
    around: Mapping[str, float] | None = None,
) -> tuple[Array, Array]:
    """Return the measured friction without its gauges' faults, and what they add to the predicted one, (n, p) each [N].

    Args:
        terms: faults of the gauges of friction.
        values: of their parameters.
        run: other faults taken out.
        force: (n, p) predicted by the law [N].
        around: see `without`.
    """
    if not terms:
        return run.force, np.zeros_like(force)
    names = [f"pad_{p}_Fx" for p in run.pads]
    corrected = run
    for term in terms:
        corrected = without(term, values, corrected, around)
    # while a pad sticks the law does not give its force
    stuck = np.stack([corrected.record[n] for n in names], axis=1)
    clean = np.where(run.sliding[:, None], force, stuck)
    record = run.record.replaced(**{n: clean[:, i] for i, n in enumerate(names)})
    record = record.replaced(**{f"pad_{p}_N": run.load[:, i] for i, p in enumerate(run.pads)})
    faulty = apply_gauge_faults(terms, values, record)
    offset = np.stack([faulty[n] for n in names], axis=1) - clean
    return run.force - offset, offset


def compute_change_by_faults(terms: Sequence[Term], values: Mapping[str, float], run: FitRun) -> Array:
    """Return by how much faults change a pulse of friction, (p,) [1]: 0 without faults, 0.03 for a gain of 1.03."""
    names = [f"pad_{p}_Fx" for p in run.pads]
    nothing = run.record.replaced(**{n: np.zeros(len(run.record)) for n in run.record.channels})
    pulse = np.zeros(len(run.record))
    pulse[len(pulse) // 2] = 1.0
    without_pulse, with_pulse = (
        apply_gauge_faults(terms, values, r) for r in (nothing, nothing.replaced(**{n: pulse for n in names}))
    )
    return np.array([float(np.linalg.norm(with_pulse[n] - without_pulse[n] - pulse)) for n in names])


def _call(effect: Effect, hook: str, record: Record, target: str, values: Mapping[str, float]) -> Record:
    return effect.hooks[hook](record=record, target=target, **values)


def without(term: Term, values: Mapping[str, float], run: FitRun, around: Mapping[str, float] | None = None) -> FitRun:
    """Take a fault out of a run: by its inverse, or by what it does to the smoothed channel.

    Args:
        term: the fault.
        values: of its parameters.
        run: as measured.
        around: values from which slopes are taken. A channel's noise is moved as these say and what `values` add moves
            the smoothed channel only: slopes of moving noise would be those of the signal and more, fits with them
            would creep and their intervals be too narrow.
    """
    record = run.record
    begin = around if around is not None and is_shifting([term]) else values
    for entry, start in zip(term.uses(values), term.uses(begin), strict=True):
        names = channels_like(entry.target, record.channels)
        if "undo" in term.effect.hooks:
            shown = record
            record = _call(entry.effect, "undo", shown, entry.target, start.values)
            if entry.values != start.values:
                smooth = shown.replaced(**{n: smooth_record(shown[n], run) for n in names})
                there, back = (_call(entry.effect, "undo", smooth, entry.target, e.values) for e in (entry, start))
                record = record.replaced(**{n: record[n] + there[n] - back[n] for n in names})
        else:
            shown = _fault_impulse_response(term, entry, record, names)
            for n in names:
                record = record.replaced(**{n: without_filter(record[n], shown[n], run)})
    moved = any(record[n] is not run.record[n] for n in VELOCITY_CHANNELS if n in record)
    return run.with_record(record, moved=moved)


def _fault_impulse_response(term: Term, entry: EffectUse, record: Record, names: Sequence[str]) -> Record:
    """Return what a fault makes of a pulse in the middle of each of these channels."""
    pulse = np.zeros(len(record))
    pulse[len(pulse) // 2] = 1.0
    return _call(term.effect, "gauge", record.replaced(**{n: pulse for n in names}), entry.target, entry.values)


def compute_raised_noise(terms: Sequence[Term], values: Mapping[str, float], run: FitRun) -> dict[str, Spectrum]:
    """Tell by how much taking out faults that have no inverse raises the power of their channels' noise.

    Returns:
        channel -> frequencies (m,) [Hz] and factors (m,) [1].
    """
    out: dict[str, Spectrum] = {}
    for term in (t for t in terms if "undo" not in t.effect.hooks):
        for entry in term.uses(values):
            names = channels_like(entry.target, run.record.channels)
            shown = _fault_impulse_response(term, entry, run.record, names)
            for n in names:
                at, factor = remove_filter_from_spectrum(shown[n], run)
                out[n] = (at, factor * out[n][1] if n in out else factor)
    return out


def compute_noise_scale(terms: Sequence[Term], values: Mapping[str, float], run: FitRun) -> dict[str, float]:
    """Tell by how much undoing the faults has scaled the noise of the balances and of their gauges.

    Returns:
        relation -> factor by which its residual is to be divided, and channel (or "loads" for all cells) -> factor of
        its noise; what no fault touches is left out.
    """
    loads = [f"pad_{p}_N" for p in run.pads]
    gauges = {
        name: _amplified(terms, values, run, name)
        for name in ("girder_ax", "girder_az", "table_ax", "slip_x", *loads)
        if name in run.record and any(name in t.targets for t in terms)
    }
    out = {name: factor for name, factor in gauges.items() if name not in loads}
    if "girder_az" in out:
        out["heave"] = out["girder_az"]
    if any(name in gauges for name in loads):
        own = sum(gauges.get(name, 1.0) for name in loads) / len(loads)
        out |= dict.fromkeys(("loads", "pitch", "roll", *warps(run.states.specimen)), own)
        either = max if own > 1.0 else min  # noise of heave is of both kinds
        out["heave"] = either(out.get("heave", 1.0), own)
    return out


def _amplified(terms: Sequence[Term], values: Mapping[str, float], run: FitRun, name: str) -> float:
    """Return the factor by which undoing the faults changes a small constant on a channel."""
    base, moved = run.record, run.record.replaced(**{name: run.record[name] + 1.0})
    for term in terms:
        for entry in term.uses(values):
            if "undo" in term.effect.hooks and entry.target == name:
                base = _call(entry.effect, "undo", base, name, entry.values)
                moved = _call(entry.effect, "undo", moved, name, entry.values)
    middle = len(run.time) // 2
    return float(abs(moved[name][middle] - base[name][middle])) or 1.0
