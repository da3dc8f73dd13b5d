"""The table of a consequence, in the units in which engineers read them, at the model and at the bridge."""

import math
from typing import Any

from slipwise.studies.consequence import Consequence, Distribution
from slipwise.studies.consequence.result import OF_THE_SENTENCE, QUANTILES
from slipwise.units import convert

#: What each response is called.
NAMES = {
    "slip": "peak slip",
    "residual_slip": "residual slip",
    "pad_load": "largest pad load",
    "buffer_force": "largest buffer force",
}


def consequence_rows(found: Consequence) -> list[dict[str, Any]]:
    """Return one row for each response at the model, and one at the bridge where it is larger."""
    rows = []
    for one in found.distributions:
        for place, factor in _places(found, one).items():
            row: dict[str, Any] = {"response": f"{NAMES[one.response.name]} [{one.response.shown_in}]"}
            row |= {"of": place} if found.scaled else {}
            for share in QUANTILES:
                before, after = (shown(one, factor * value) for value in one.quantiles(share))
                row |= {f"{100 * share:.0f} % without": before, f"{100 * share:.0f} % with": after}
            rows.append({**row, **_change(one)})
    return rows


def short_rows(found: Consequence, *, whole: bool = True) -> list[dict[str, Any]]:
    """Return one row for each response, for people: without and with in one cell, model and bridge beside each other.

    Args:
        found: the result.
        whole: with the model's numbers and the interval of the change, for which a terminal has no room.
    """
    rows = []
    for one in found.distributions:
        row: dict[str, Any] = {"response": f"{NAMES[one.response.name]} [{one.response.shown_in}]"}
        places = _places(found, one)
        for place, factor in places.items() if whole else list(places.items())[-1:]:
            for share in QUANTILES:
                before, after = (_figures(shown(one, factor * value)) for value in one.quantiles(share))
                row[f"{place}, {100 * share:.0f} %"] = f"{before} → {after}"
        change = _change(one)
        rows.append(row | (change if whole else {"change": next(iter(change.values()))}))
    return rows


def _figures(value: float) -> str:
    """Write a number with three figures and without a power of ten."""
    return f"{value:.0f}" if abs(value) >= 100.0 else f"{value:.3g}"


def shown(of: Distribution, value: float) -> float:
    """Return a value [SI] in the unit in which its response is read, in four figures."""
    return float(f"{float(convert(value, of.response.unit, of.response.shown_in)):.4g}")


def _places(found: Consequence, one: Distribution) -> dict[str, float]:
    return {"model": 1.0, "bridge": one.to_bridge} if found.scaled else {"rig": 1.0}


def _change(one: Distribution) -> dict[str, Any]:
    value, low, high = one.change(OF_THE_SENTENCE)
    heading = f"change of {100 * OF_THE_SENTENCE:.0f} %"
    if not math.isfinite(value):
        return {heading: "", "95 % interval": ""}
    return {heading: f"{100 * value:+.3g} %", "95 % interval": f"{100 * low:+.3g} to {100 * high:+.3g} %"}


def drawn_rows(found: Consequence) -> list[dict[str, Any]]:
    """Return the sizes that were drawn: value and ends of the interval, or the ends of a uniform one."""
    return [
        {
            "size": v.key,
            "value": "" if v.value is None else float(f"{v.value:.4g}"),
            "low": float(f"{v.low:.4g}"),
            "high": float(f"{v.high:.4g}"),
            "unit": "" if v.unit == "1" else v.unit,
            "drawn": "uniform" if v.value is None else "normal to each side, 95 % within",
        }
        for v in found.drawn
    ]
