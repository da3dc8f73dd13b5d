"""The tables of a bearing report, for terminal, page, CSV and workbook, in the units in which engineers read them."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from slipwise.bearings.quantities import QUANTITIES, Quantity
from slipwise.bearings.result import CYCLE, MEAN, RUN, BearingReport, BearingRow, QuantityValue
from slipwise.estimation.intervals import count_figures
from slipwise.units import convert
from slipwise.view.words.numbers import counted, usual_unit

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
OF_RUN = ("friction_mean", "friction_breakaway", "friction_peak_speed", "peak_speed", "energy")
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
                "run": self._name(row),
                **({"pad": row.bearing} if several else {}),
                **({"cycle": row.cycle} if row.cycle else {}),
                **{self.heading(key): self.shown(key, row.values[key].measured) for key in keys},
            }
            for row in rows
        ]

    def beside_law(self, rows: Sequence[BearingRow], keys: Sequence[str]) -> list[dict[str, Any]]:
        """Return one row for each quantity of each pad: measured, by the fitted law, and the law's 95 % interval."""
        several = len({row.bearing for row in rows}) > 1
        out = []
        for row in rows:
            for key in keys:
                value = row.values[key]
                law, between = self._law(key, value)
                said = {"measured": self.shown(key, value.measured), "law": law, "law, 95 %": between}
                out.append({**({"pad": row.bearing} if several else {}), "quantity": self.heading(key), **said})
        return out

    def by_series(self, rows: Sequence[BearingRow], keys: Sequence[str]) -> dict[str, list[dict[str, Any]]]:
        """Return a table for each run, or series of cycles: its name -> rows as of `beside_law`."""
        named: dict[str, list[BearingRow]] = {}
        for row in rows:
            named.setdefault(self._name(row), []).append(row)
        return {name: self.beside_law(of, keys) for name, of in named.items()}

    def degradation(self, bearing: str | None = None) -> list[dict[str, Any]]:
        """Return each cycle against the first and the third one of its series."""
        return [
            {
                "run": d.run if d.series == 1 else f"{d.run}, series {d.series}",
                **({} if bearing else {"pad": d.bearing}),
                "cycle": d.cycle,
                "energy / first": d.energy_first,
                "energy / third": d.energy_third,
                "Q_d / first": d.strength_first,
                "Q_d / third": d.strength_third,
            }
            for d in self.found.degradation
            if bearing in (None, d.bearing)
        ]

    def standards(self) -> dict[str, list[dict[str, Any]]]:
        """Return factors, bounds and coefficients as each standard names them: standard -> rows."""
        named: dict[str, list[dict[str, Any]]] = {}
        for one in self.found.standards:
            row = {"name": one.name, "of": one.quantity, "value": one.value, "measured on": one.basis}
            named.setdefault(one.standard, []).append(row)
        return named

    def sheets(self) -> Mapping[str, list[dict[str, Any]]]:
        """Return the sheets of bearing.xlsx: name -> rows."""
        found = self.found
        lacking = [{"standard": one.standard, "not held by this test": one.words} for one in found.not_held]
        return {
            "Runs": self.wide(found.of(RUN)),
            "Series of cycles": self.wide(found.of(MEAN)),
            "Cycles": self.wide(found.of(CYCLE)),
            "Degradation": self.degradation(),
            "Standards": [{"standard": s, **row} for s, rows in self.standards().items() for row in rows],
            "Not held": [*lacking, *({"not held by this test": words} for words in found.cannot)],
        }

    def _law(self, key: str, value: QuantityValue) -> tuple[str, str]:
        """Write a law's quantity and its interval, with so many figures that the half width keeps two."""
        law, low, high = (self.shown(key, number) for number in (value.law, value.low, value.high))
        if law is None:
            return "", ""
        if low is None or high is None:
            return f"{law:.4g}", ""
        figures = count_figures(low, high)
        return f"{law:.{figures}g}", f"{low:.{figures}g} to {high:.{figures}g}"

    def _name(self, row: BearingRow) -> str:
        """Return the name of a run; of a series also how many cycles of which amplitude it has."""
        if row.part != MEAN:
            return f"{row.run}, series {row.series}" if row.series > 1 else row.run
        of_series = (row.run, row.bearing, row.series)
        count = sum((r.run, r.bearing, r.series) == of_series for r in self.found.of(CYCLE))
        half = 0.5e3 * (row.values["displacement_max"].measured - row.values["displacement_min"].measured)
        return f"{row.run}: {counted(count, 'cycle')}, ±{half:.3g} mm"

    def _bracket(self, known: Quantity) -> str:
        unit = self.unit(known.key)
        return "" if unit == "1" else f" [{unit.replace('*', ' ')}]"


def name_of_total(found: BearingReport) -> str:
    """Return what the bearing that stands for all is called."""
    return "sum of the pads" if found.total == "sum" else f"pad {found.total}"
