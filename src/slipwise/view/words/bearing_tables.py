"""The tables of a bearing report, for terminal, page, CSV and workbook, in the units in which engineers read them."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from slipwise.bearings.quantities import QUANTITIES, Quantity
from slipwise.bearings.result import CYCLE, MEAN, RUN, BearingReport, BearingRow, QuantityValue
from slipwise.estimation.intervals import count_figures
from slipwise.units import convert
from slipwise.view.words.numbers import usual_unit

#: Short headings of quantities.
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
FRICTION = ("friction_mean", "friction_breakaway", "breakaway_pressure", "friction_peak_speed", "peak_speed",
            "peak_speed_pressure")  # fmt: skip
LOOP = ("energy", "effective_stiffness", "equivalent_damping", "characteristic_strength", "second_slope_stiffness")
OF_RUN = ("friction_mean", "friction_breakaway", "friction_peak_speed", "peak_speed", "mean_pressure", "energy")
#: Units of bearings that never carry a kilonewton of friction; of others `usual_unit`, and energy in kN cm.
_SMALL = {"N": "N", "N/m": "N/mm", "J": "J"}
_KILONEWTON = 1e3


class BearingTables:
    """Tables of one report, all in the same units.

    Attributes:
        found: the report.
        small: whether forces are read in N, stiffness in N/mm and energy in J.
    """

    def __init__(self, found: BearingReport) -> None:
        self.found = found
        largest = max(float(np.abs(loop.force).max()) for one in found.loops for loop in one.loops)
        self.small = largest < _KILONEWTON

    def unit(self, key: str) -> str:
        """Return the unit in which a quantity is read."""
        unit = _BY_KEY[key].unit
        if self.small and unit in _SMALL:
            return _SMALL[unit]
        return "kN*cm" if unit == "J" else usual_unit(unit)

    def shown(self, key: str, value: float) -> float | None:
        """Return a value [SI] in the unit in which its quantity is read; None where it is not known."""
        return float(convert(value, _BY_KEY[key].unit, self.unit(key))) if np.isfinite(value) else None

    def heading(self, key: str) -> str:
        """Return the short heading of a quantity with its unit."""
        return f"{_SHORT[key]}{self._bracket(_BY_KEY[key])}"

    def wide(self, rows: Sequence[BearingRow]) -> list[dict[str, Any]]:
        """Return every number in a cell of its own, for CSV and workbooks: measured, law, and the law's interval."""
        out = []
        for row in rows:
            cells: dict[str, Any] = {"run": row.run, "role": row.role, "bearing": row.bearing, "part": row.part}
            cells |= {"series": row.series or None, "cycle": row.cycle or None}
            for known in QUANTITIES:
                if (value := row.values.get(known.key)) is None:
                    continue
                heading = f"{known.words}{self._bracket(known)}"
                cells[heading] = self.shown(known.key, value.measured)
                if np.isfinite(value.law):
                    numbers = (("law", value.law), ("law low", value.low), ("law high", value.high))
                    cells |= {f"{heading}, {name}": self.shown(known.key, number) for name, number in numbers}
            out.append(cells)
        return out

    def short(self, rows: Sequence[BearingRow], keys: Sequence[str]) -> list[dict[str, Any]]:
        """Return one row each, as measured."""
        several = len({row.bearing for row in rows}) > 1
        return [
            {
                "run": _name(row),
                **({"pad": row.bearing} if several else {}),
                **({"cycle": row.cycle} if row.cycle else {}),
                **{self.heading(key): self.shown(key, row.values[key].measured) for key in keys},
            }
            for row in rows
        ]

    def beside_law(self, rows: Sequence[BearingRow], keys: Sequence[str]) -> list[dict[str, Any]]:
        """Return one row for each quantity of each row: measured, by the fitted law, and the law's 95 % interval."""
        several = len({row.bearing for row in rows}) > 1
        out = []
        for row in rows:
            for key in keys:
                value = row.values[key]
                between = self._between(key, value)
                about = {"run": _name(row), **({"pad": row.bearing} if several else {}), "quantity": self.heading(key)}
                said = {"measured": self.shown(key, value.measured), "law": self.shown(key, value.law)}
                out.append({**about, **said, "law, 95 %": between})
        return out

    def degradation(self, bearing: str | None = None) -> list[dict[str, Any]]:
        """Return each cycle against the first and the third one of its series."""
        return [
            {
                "run": d.run,
                **({} if bearing else {"pad": d.bearing}),
                "series": d.series,
                "cycle": d.cycle,
                "energy / first": d.energy_first,
                "energy / third": d.energy_third,
                "Q_d / first": d.strength_first,
                "Q_d / third": d.strength_third,
            }
            for d in self.found.degradation
            if bearing in (None, d.bearing)
        ]

    def standards(self) -> list[dict[str, Any]]:
        """Return factors, bounds and coefficients as the standards name them."""
        return [
            {"standard": s.standard, "name": s.name, "of": s.quantity, "value": s.value, "measured on": s.basis}
            for s in self.found.standards
        ]

    def sheets(self) -> Mapping[str, list[dict[str, Any]]]:
        """Return the sheets of bearing.xlsx: name -> rows."""
        found = self.found
        lacking = [{"standard": one.standard, "not held by this test": one.words} for one in found.not_held]
        return {
            "Runs": self.wide(found.of(RUN)),
            "Series of cycles": self.wide(found.of(MEAN)),
            "Cycles": self.wide(found.of(CYCLE)),
            "Degradation": self.degradation(),
            "Standards": self.standards(),
            "Not held": [*lacking, *({"not held by this test": words} for words in found.cannot)],
        }

    def _between(self, key: str, value: QuantityValue) -> str:
        """Write the interval of a law's quantity, with so many figures that its half width keeps two."""
        low, high = self.shown(key, value.low), self.shown(key, value.high)
        if low is None or high is None:
            return ""
        figures = count_figures(low, high)
        return f"{low:.{figures}g} to {high:.{figures}g}"

    def _bracket(self, known: Quantity) -> str:
        unit = self.unit(known.key)
        return "" if unit == "1" else f" [{unit.replace('*', ' ')}]"


def name_of_total(found: BearingReport) -> str:
    """Return what the bearing that stands for all is called."""
    return "sum of the pads" if found.total == "sum" else f"pad {found.total}"


def _name(row: BearingRow) -> str:
    return f"{row.run}, series {row.series}" if row.series > 1 else row.run
