"""Tables of a comparison, and compare.json."""

import math
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

import numpy as np

from slipwise.channels import channel
from slipwise.comparison.component_level import NAMES, compute_dividing_noise
from slipwise.comparison.data import ComparisonData
from slipwise.comparison.system_level import pool_system_errors

TABLES: tuple[str, ...] = (
    "audit", "components", "system", "parameters", "correlations", "cells", "places", "parity", "floor",
    "noise", "predicted_friction",
)  # fmt: skip


def rows_of(found: ComparisonData, table: str) -> list[dict[str, Any]]:
    """Return a table as rows of plain values, SI."""
    return _MAKERS[table](found)


def _components(found: ComparisonData) -> list[dict[str, Any]]:
    return [
        {
            "relation": e.relation,
            "run": e.run,
            "role": e.role,
            "error": e.error,
            "rms": e.rms,
            "floor": e.floor,
            "unit": NAMES[e.relation][1],
            "share": e.share,
            "samples": e.samples,
        }
        for e in found.components
    ]


def _system(found: ComparisonData) -> list[dict[str, Any]]:
    keys = ("run", "role", "channel", "error", "rms", "floor", "gauge", "fed", "step", "share")
    return [{k: getattr(e, k) for k in keys} for e in (found.system.errors if found.system else ())]


def _parameters(found: ComparisonData) -> list[dict[str, Any]]:
    keys = ("value", "low", "high", "rated", "unit", "bound", "limit")
    return [{"parameter": e.key, **{k: getattr(e, k) for k in keys}} for e in found.intervals.entries]


def _correlations(found: ComparisonData) -> list[dict[str, Any]]:
    pairs = found.intervals.strongest(len(found.intervals.keys) ** 2)
    return [{"parameter": a, "other": b, "correlation": value} for a, b, value in pairs]


def _cells(found: ComparisonData) -> list[dict[str, Any]]:
    keys = ("relation", "kind", "label", "low", "high", "error", "samples", "effective", "chance", "above")
    return [{k: getattr(c, k) for k in keys} for c in found.cells]


def _places(found: ComparisonData) -> list[dict[str, Any]]:
    keys = ("relation", "words", "error", "elsewhere", "share", "part", "kind", "direction")
    return [{k: getattr(p, k) for k in keys} for p in found.places]


def _parity(found: ComparisonData) -> list[dict[str, Any]]:
    keys = ("relation", "odd", "even", "plus", "minus")
    return [{k: getattr(p, k) for k in keys} for p in found.parities.values()]


def _predicted_friction(found: ComparisonData) -> list[dict[str, Any]]:
    keys = ("run", "role", "measured", "value", "low", "high", "inside")
    return [{k: getattr(f, k) for k in keys} for f in found.predicted_friction]


def _floor(found: ComparisonData) -> list[dict[str, Any]]:
    objective = found.base.objective
    out = []
    for relation in found.relations:
        parts, residuals, turns = [], [], []
        for of in found.base.solution.residuals.blocks(relation):
            wide = of.columns
            parts.append(wide.ravel())
            residuals.append((wide * of.noise.reshape(wide.shape)).ravel())
            near = objective.run(of.run).states.near_reversal[:, None]
            turns.append(np.broadcast_to(near, wide.shape).ravel())
        in_floors, residual, turning = (np.concatenate(of) for of in (parts, residuals, turns))
        floors = [
            compute_dividing_noise(residual[of], in_floors[of]) if np.any(in_floors[of]) else None
            for of in (np.ones_like(turning), turning)
        ]
        row = {"relation": relation, "floor": floors[0], "near_reversals": floors[1]}
        row |= {"unit": NAMES[relation][1], "repeated_runs": found.repeats.get(relation)}
        out.append(row)
    return out


def _noise(found: ComparisonData) -> list[dict[str, Any]]:
    step = found.base.objective.run(0).dt
    return [
        {
            "channel": name,
            "unit": channel(name).unit,
            "level": gauge.level if gauge.known else None,
            "basis": gauge.basis,
            "correlation_time": gauge.colour * step if gauge.rested else None,
        }
        for name, gauge in found.gauges.items()
    ]


def _noise_notes(found: ComparisonData) -> Iterator[str]:
    if not any(gauge.rested for gauge in found.gauges.values()):
        yield "no run begins at rest: the noise of the gauges is read off records that move"
    for name, gauge in found.gauges.items():
        if not gauge.known:
            yield f"{name}: noise unknown, {gauge.basis}"


_MAKERS = {
    "audit": lambda found: found.checks.report.rows(),
    "components": _components,
    "system": _system,
    "parameters": _parameters,
    "correlations": _correlations,
    "cells": _cells,
    "places": _places,
    "parity": _parity,
    "floor": _floor,
    "noise": _noise,
    "layer": lambda found: [asdict(one) for one in found.layer],
    "predicted_friction": _predicted_friction,
}


#: Tables that compare.json holds under their own names.
_LISTED = ("places", "parameters", "correlations", "layer", "floor", "parity", "cells", "predicted_friction")


def as_json(found: ComparisonData) -> dict[str, Any]:
    """Return a comparison as compare.json holds it: SI, errors in multiples of the floor, null where unknown.

    schema: 1
    campaign, rig: names
    model: [{effect, target, values}], as fitted
    components: {relation: {fit, holdout, repeats}}
    system: {channel: {fit, holdout}}
    audit: {accused, words, findings: [{what, channel, size, low, high, unit, probability, ...}]}
    worst: {relation, error}
    places: [{relation, words, error, elsewhere, share, part, kind, direction}], the worst first
    parameters: [{parameter, value, low, high, rated, unit, bound, limit}], 95 % intervals
    correlations: [{parameter, other, correlation}], the strongest first
    surface: {pressure, speed, friction, deviation}, mu(P, V), or null
    layer: [{run, role, peak_slip, peak_force, energy, stiffness, period, damping, linear_left, model_left}], where no
        bearing's force was measured
    floor: [{relation, floor, near_reversals, unit, repeated_runs}]
    predicted_friction: [{run, role, measured, value, low, high, inside}], mean friction of one pad while sliding
    noise: {channels: [{channel, unit, level, basis, correlation_time}], notes: in words}
    parity: [{relation, odd, even, plus, minus}]
    cells: [{relation, kind, label, low, high, error, samples, effective, chance, above}]
    runs: {components: [...], system: [...]}, error of every run
    cannot, notes: in words
    seconds: that it took
    """
    worst, error = found.worst
    system = {}
    if found.system:
        for channel in dict.fromkeys(e.channel for e in found.system.errors):
            system[channel] = {
                "fit": pool_system_errors(found.system.errors, channel, held_out=False),
                "holdout": pool_system_errors(found.system.errors, channel, held_out=True),
            }
    surface = None
    if found.surface:
        keys = ("pressure", "speed", "friction", "deviation")
        surface = {k: getattr(found.surface, k).tolist() for k in keys}
    content = {
        "schema": 1,
        "campaign": found.campaign.name,
        "rig": found.campaign.rig,
        "model": [{"effect": u.effect.name, "target": u.target, "values": u.numbers} for u in found.model.uses],
        "components": {
            r: {
                "fit": found.error(r, held_out=False),
                "holdout": found.error(r, held_out=True),
                "repeats": found.repeats.get(r),
            }
            for r in found.relations
        },
        "system": system,
        "corrections": [one.as_json() for one in found.corrections],
        "audit": {"accused": found.checks.accused, "words": found.checks.words, "findings": rows_of(found, "audit")},
        "worst": {"relation": worst, "error": error},
        "surface": surface,
        **{name: rows_of(found, name) for name in _LISTED},
        "noise": {"channels": rows_of(found, "noise"), "notes": list(_noise_notes(found))},
        "runs": {"components": rows_of(found, "components"), "system": rows_of(found, "system")},
        "cannot": list(found.cannot),
        "notes": list(found.notes),
        "seconds": found.seconds,
    }
    return _plain(content)


def _plain(value: Any) -> Any:
    """Return what JSON can hold: NaN and infinity become null."""
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(v) for v in value]
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    return value
