"""Tables of a comparison, and compare.json."""

import math
from typing import Any

from slipwise.compare.component import NAMES, floors
from slipwise.compare.result import Comparison


def rows_of(found: Comparison, table: str) -> list[dict[str, Any]]:
    """Give a table as rows of plain values, SI."""
    return _MAKERS[table](found)


def _components(found: Comparison) -> list[dict[str, Any]]:
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


def _system(found: Comparison) -> list[dict[str, Any]]:
    keys = ("run", "role", "channel", "error", "rms", "floor", "gauge", "fed", "step", "share")
    return [{k: getattr(e, k) for k in keys} for e in (found.system.errors if found.system else ())]


def _parameters(found: Comparison) -> list[dict[str, Any]]:
    keys = ("value", "low", "high", "rated", "unit", "bound")
    return [{"parameter": e.key, **{k: getattr(e, k) for k in keys}} for e in found.intervals.entries]


def _correlations(found: Comparison) -> list[dict[str, Any]]:
    pairs = found.intervals.strongest(len(found.intervals.keys) ** 2)
    return [{"parameter": a, "other": b, "correlation": value} for a, b, value in pairs]


def _cells(found: Comparison) -> list[dict[str, Any]]:
    keys = ("relation", "kind", "label", "low", "high", "error", "samples", "effective", "chance", "above")
    return [{k: getattr(c, k) for k in keys} for c in found.cells]


def _places(found: Comparison) -> list[dict[str, Any]]:
    keys = ("relation", "words", "error", "elsewhere", "share", "part", "kind", "direction")
    return [{k: getattr(p, k) for k in keys} for p in found.places]


def _parity(found: Comparison) -> list[dict[str, Any]]:
    keys = ("relation", "odd", "even", "plus", "minus")
    return [{k: getattr(p, k) for k in keys} for p in found.parities.values()]


def _floor(found: Comparison) -> list[dict[str, Any]]:
    own = floors(found.base)
    out = []
    for relation in found.relations:
        parts = own[relation]
        mean = math.sqrt(sum(float((p**2).mean()) for p in parts) / len(parts))
        out.append(
            {
                "relation": relation,
                "floor": mean,
                "unit": NAMES[relation][1],
                "basis": "noise of the gauges and of the velocity",
                "repeated_runs": found.repeats.get(relation),
            }
        )
    return out


_MAKERS = {
    "components": _components,
    "system": _system,
    "parameters": _parameters,
    "correlations": _correlations,
    "cells": _cells,
    "places": _places,
    "parity": _parity,
    "floor": _floor,
}


def as_json(found: Comparison) -> dict[str, Any]:
    """Give a comparison as compare.json holds it: SI, errors in multiples of the floor, null where unknown.

    Keys: `schema` 1 · `campaign` · `rig` · `model` (effects with their fitted values) · `components` {relation: {fit,
    holdout, repeats}} · `system` {channel: {fit, holdout}} · `worst` {relation, error} · `places` [{relation, words,
    error, elsewhere, share, part, kind, direction}], the worst first · `parameters` [{parameter, value, low, high, rated,
    unit, bound}], 95 % · `correlations` [{parameter, other, correlation}], the strongest first · `surface` {pressure,
    speed, friction, deviation} · `floor` [{relation, floor, unit, basis, repeated_runs}] · `parity` [{relation, odd,
    even, plus, minus}] · `cells` [{relation, kind, label, low, high, error, samples, effective, chance, above}] · `runs`
    {components: [...], system: [...]}, error of every run · `cannot` and `notes`, in words · `seconds`.
    """
    from slipwise.compare.system_level import pooled_system

    worst, error = found.worst
    system = {}
    if found.system:
        for channel in dict.fromkeys(e.channel for e in found.system.errors):
            system[channel] = {
                "fit": pooled_system(found.system.errors, channel, held_out=False),
                "holdout": pooled_system(found.system.errors, channel, held_out=True),
            }
    surface = None
    if found.surface:
        keys = ("pressure", "speed", "friction", "deviation")
        surface = {k: getattr(found.surface, k).tolist() for k in keys}
    content = {
        "schema": 1,
        "campaign": found.campaign.name,
        "rig": found.campaign.rig,
        "model": [
            {"effect": u.effect.name, "target": u.target, "values": dict(u.values)} for u in found.model.uses
        ],
        "components": {
            r: {
                "fit": found.error(r, held_out=False),
                "holdout": found.error(r, held_out=True),
                "repeats": found.repeats.get(r),
            }
            for r in found.relations
        },
        "system": system,
        "worst": {"relation": worst, "error": error},
        "surface": surface,
        **{name: found.rows(name) for name in ("places", "parameters", "correlations", "floor", "parity", "cells")},
        "runs": {"components": found.rows("components"), "system": found.rows("system")},
        "cannot": list(found.cannot),
        "notes": list(found.notes),
        "seconds": found.seconds,
    }
    return _plain(content)


def _plain(value: Any) -> Any:
    """Give what JSON can hold: NaN and infinity become null."""
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(v) for v in value]
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    return value
