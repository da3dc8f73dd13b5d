"""The tables of a bearing report, for terminal, page, CSV and workbook, in the units in which engineers read them."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from slipwise.bearings.quantities import QUANTITIES, Quantity
from slipwise.bearings.result import CYCLE, MEAN, RUN, BearingReport, BearingRow, QuantityValue
from slipwise.units import convert
from slipwise.view.words.numbers import usual_unit

#: Short headings of quantities, for tables that must fit a page.
_SHORT = {
    "friction_mean": "mu mean",
    "friction_breakaway": "mu breakaway",
    "breakaway_pressure": "p at breakaway",
    "friction_peak_speed": "mu at peak speed",
    "peak_speed": "peak speed",
    "peak_speed_pressure": "p at peak speed",
    "mean_pressure": "mean p",
    "energy": "energy",
    "way": "way",
    "displacement_max": "slip max",
    "displacement_min": "slip min",
    "characteristic_strength": "Q_d",
    "second_slope_stiffness": "K_d",
    "effective_stiffness": "K_eff",
    "equivalent_damping": "damping",
}
_BY_KEY = {q.key: q for q in QUANTITIES}
_COEFFICIENTS = ("friction_mean", "friction_breakaway", "breakaway_pressure", "friction_peak_speed", "peak_speed",
                 "peak_speed_pressure")  # fmt: skip
OF_RUN = (*_COEFFICIENTS, "energy", "way", "displacement_max", "displacement_min")
OF_CYCLE = ("energy", "effective_stiffness", "equivalent_damping", "characteristic_strength", "second_slope_stiffness")
OF_FRICTION = (*_COEFFICIENTS, "mean_pressure")


def shown_as(quantity: Quantity) -> str:
    """Return the unit in which a quantity is read; energy in kN cm."""
    return "kN*cm" if quantity.unit == "J" else usual_unit(quantity.unit)


def in_shown_unit(key: str, value: float) -> float:
    """Return a value [SI] in the unit in which its quantity is read."""
    known = _BY_KEY[key]
    return convert(value, known.unit, shown_as(known)) if np.isfinite(value) else value


def wide_rows(rows: Sequence[BearingRow]) -> list[dict[str, Any]]:
    """Return rows with every number in a cell of its own, for CSV and workbooks: measured, law, and its interval."""
    out = []
    for row in rows:
        cells: dict[str, Any] = _about(row)
        for known in QUANTITIES:
            if (value := row.values.get(known.key)) is None:
                continue
            heading = f"{known.words}{_bracket(known)}"
            cells[heading] = _cell(known.key, value.measured)
            if np.isfinite(value.law):
                cells |= {
                    f"{heading}, {name}": _cell(known.key, number)
                    for name, number in (("law", value.law), ("law low", value.low), ("law high", value.high))
                }
        out.append(cells)
    return out


def printed_rows(rows: Sequence[BearingRow], keys: Sequence[str], *, law: bool = False) -> list[dict[str, Any]]:
    """Return rows for a terminal or a page.

    Args:
        rows: of the report.
        keys: of the quantities.
        law: write what the fitted law gives, with its interval, below what was measured.
    """
    out = []
    for row in rows:
        about = {name: value for name, value in _about(row).items() if name not in ("role", "part") and value != ""}
        said = {"from": "measured"} if law else {}
        out.append({**about, **said, **{heading(key): _cell(key, row.values[key].measured) for key in keys}})
        if law and any(np.isfinite(value.law) for value in row.values.values()):
            other = {heading(key): _with_interval(key, row.values[key]) for key in keys}
            out.append({**dict.fromkeys(about, ""), "from": "law, 95 %", **other})
    return out


def degradation_rows(found: BearingReport, bearing: str | None = None) -> list[dict[str, Any]]:
    """Return each cycle against the first and the third one of its series."""
    return [
        {
            "run": d.run,
            "bearing": d.bearing,
            "series": d.series,
            "cycle": d.cycle,
            "energy / first": d.energy_first,
            "energy / third": d.energy_third,
            "Q_d / first": d.strength_first,
            "Q_d / third": d.strength_third,
        }
        for d in found.degradation
        if bearing in (None, d.bearing)
    ]


def standard_rows(found: BearingReport) -> list[dict[str, Any]]:
    """Return factors, bounds and coefficients as the standards name them."""
    return [
        {"standard": s.standard, "name": s.name, "of": s.quantity, "value": s.value, "measured on": s.basis}
        for s in found.standards
    ]


def not_held_rows(found: BearingReport) -> list[dict[str, Any]]:
    """Return what standards ask and the test does not hold."""
    return [{"standard": one.standard, "not held by this test": one.words} for one in found.not_held]


def workbook_sheets(found: BearingReport) -> Mapping[str, list[dict[str, Any]]]:
    """Return the sheets of bearing.xlsx: name -> rows."""
    return {
        "Runs": wide_rows(found.of(RUN)),
        "Series of cycles": wide_rows(found.of(MEAN)),
        "Cycles": wide_rows(found.of(CYCLE)),
        "Degradation": degradation_rows(found),
        "Standards": standard_rows(found),
        "Not held": [*not_held_rows(found), *({"not held by this test": words} for words in found.cannot)],
    }


def heading(key: str) -> str:
    """Return the short heading of a quantity with its unit."""
    return f"{_SHORT[key]}{_bracket(_BY_KEY[key])}"


def _bracket(known: Quantity) -> str:
    unit = shown_as(known)
    return "" if unit == "1" else f" [{unit.replace('*', ' ')}]"


def _about(row: BearingRow) -> dict[str, Any]:
    about = {"run": row.run, "role": row.role, "bearing": row.bearing, "part": row.part}
    return about | {"series": row.series or "", "cycle": row.cycle or ""}


def _cell(key: str, value: float) -> float | None:
    return float(in_shown_unit(key, value)) if np.isfinite(value) else None


def _with_interval(key: str, value: QuantityValue) -> str:
    if not np.isfinite(value.law):
        return ""
    ends = [value.law, value.low, value.high]
    law, low, high = (f"{in_shown_unit(key, number):.4g}" for number in ends)
    return f"{law} ({low} to {high})" if np.isfinite(value.low) else law
