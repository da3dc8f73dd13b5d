"""The tables of an ensemble, for terminal, CSV and JSON, in the units in which people read them."""

from collections.abc import Sequence
from typing import Any

from slipwise.studies.ensemble import QUANTILES, Ensemble, Quantiles
from slipwise.units import convert

#: Responses that the terminal shows; the files have all.
_PRINTED = ("slip", "residual_slip", "pad_load", "uplift", "energy")


def quantile_rows(found: Ensemble) -> list[dict[str, Any]]:
    """Return one row for every motion, scale and response; empty where no member finished."""
    return [_row(q) for q in found.quantiles]


def exceedance_rows(found: Ensemble) -> list[dict[str, Any]]:
    """Return one row for every motion, scale and limit: the share of the members that finished and exceeded it."""
    return [
        {
            "motion": e.motion,
            "scale": e.scale,
            "limit": e.limit.words,
            "members": e.members,
            "failed": e.failed,
            "over": e.over,
            "share": e.over / e.members if e.members else None,
        }
        for e in found.exceedances
    ]


def printed_tables(found: Ensemble) -> list[tuple[str, Sequence[dict[str, Any]]]]:
    """Return the tables that a terminal shows: title and rows."""
    tables = []
    for name in _PRINTED:
        chosen = [q for q in found.quantiles if q.response.name == name]
        of = chosen[0].response
        diverged = any(q.failed for q in chosen)
        left_out = ("response", "unit", "members", *(() if diverged else ("failed",)))
        rows = [{k: v for k, v in _row(q).items() if k not in left_out} for q in chosen]
        tables.append((f"Quantiles of {of.meaning} [{of.shown_in.replace('*', ' ')}]", rows))
    if found.exceedances:
        tables.append(("Limits exceeded", exceedance_rows(found)))
    return tables


def ensemble_json(found: Ensemble) -> dict[str, Any]:
    """Return the content of ensemble.json."""
    return {
        "schema": 1,
        "motions": list(found.motions),
        "scales": list(found.scales),
        "members": found.members,
        "varied": [{"key": v.key, "low": v.low, "high": v.high, "unit": v.unit} for v in found.varied],
        "quantiles": quantile_rows(found),
        "exceedances": exceedance_rows(found),
        "run": found.run,
        "seconds": round(found.seconds, 1),
    }


def _row(of: Quantiles) -> dict[str, Any]:
    shown = [convert(v, of.response.unit, of.response.shown_in) for v in of.values] if of.members else [None] * 5
    return {
        "motion": of.motion,
        "scale": of.scale,
        "response": of.response.name,
        "unit": of.response.shown_in,
        "members": of.members,
        "failed": of.failed,
        **{f"{q} %": value for q, value in zip(QUANTILES, shown, strict=True)},
    }
