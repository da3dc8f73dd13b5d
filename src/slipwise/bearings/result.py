"""What a test says of a bearing, as data, as tables for programs and pandas, and as bearing.json."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from slipwise.bearings.degradation import Degradation
from slipwise.bearings.factors import StandardValue
from slipwise.bearings.law import LawForces
from slipwise.bearings.measured import RunLoops
from slipwise.bearings.quantities import QUANTITIES
from slipwise.bearings.requirements import NotHeld
from slipwise.display import Drawn, Tabular
from slipwise.preparation.data_corrections import DataCorrection
from slipwise.short_repr import short_repr

#: What a row of the result is about.
RUN, CYCLE, MEAN = "run", "cycle", "mean of cycles"


@dataclass(frozen=True)
class QuantityValue:
    """One quantity.

    Attributes:
        measured: from the measured loop [SI]; NaN where it cannot be given.
        law: from the loop that the fitted law has at the same motion [SI]; NaN where there is none.
        low: lower end of the 95 % interval of the law's [SI].
        high: upper end.
    """

    measured: float
    law: float = float("nan")
    low: float = float("nan")
    high: float = float("nan")


@short_repr
@dataclass(frozen=True)
class BearingRow:
    """All quantities of one bearing over one cycle, over the closed cycles of a run, or over a run.

    Attributes:
        run: name.
        role: "fit", "repeat" or "holdout".
        bearing: name of the pad, or "sum".
        part: "run", "cycle" or "mean of cycles".
        series: number of the series of cycles of one stroke in the run, from 1; 0 for a whole run.
        cycle: number within the series, from 1; 0 for the other parts.
        values: key of a quantity -> its value.
    """

    run: str
    role: str
    bearing: str
    part: str
    series: int
    cycle: int
    values: Mapping[str, QuantityValue]


@dataclass(frozen=True, repr=False)
class BearingReport(Drawn, Tabular):
    """Bearing quantities of a campaign.

    Attributes:
        campaign: its name.
        rig: name of the rig.
        law: names of the effects of the fitted law, or why there is none.
        rows: of every run, bearing and cycle.
        degradation: of energy and characteristic strength over the cycles of each cyclic run.
        standards: modification factors, bounds and coefficients as the standards name them.
        not_held: what a standard asks and this test does not hold.
        cannot: what could not be given, and for lack of what.
        corrections: what was done about the data before.
        loops: of every run that slides, as measured.
        forces: run -> friction by the fitted law; empty without one.
        seconds: that it took [s].
    """

    campaign: str
    rig: str
    law: str
    rows: tuple[BearingRow, ...]
    degradation: tuple[Degradation, ...]
    standards: tuple[StandardValue, ...]
    not_held: tuple[NotHeld, ...]
    cannot: tuple[str, ...]
    corrections: tuple[DataCorrection, ...]
    loops: tuple[RunLoops, ...]
    forces: Mapping[str, LawForces]
    seconds: float

    @property
    def total(self) -> str:
        """The bearing that stands for all: the sum of the pads, or the first pad where there is no sum."""
        names = [row.bearing for row in self.rows]
        return "sum" if "sum" in names else names[0]

    def of(self, part: str, bearing: str | None = None) -> tuple[BearingRow, ...]:
        """Return the rows of one part, of one bearing if it is named.

        Args:
            part: "run", "mean of cycles" or another part that a row has.
            bearing: its name, or that of the total; all if not given.
        """
        return tuple(r for r in self.rows if r.part == part and bearing in (None, r.bearing))

    def as_json(self) -> dict[str, Any]:
        """Return what bearing.json holds."""
        return {
            "schema": 1,
            "campaign": self.campaign,
            "rig": self.rig,
            "law": self.law,
            "quantities": [{"key": q.key, "words": q.words, "unit": q.unit} for q in QUANTITIES],
            "rows": [
                {
                    **{name: getattr(row, name) for name in ("run", "role", "bearing", "part", "series", "cycle")},
                    "values": {key: _value(value) for key, value in row.values.items()},
                }
                for row in self.rows
            ],
            "degradation": [{k: _known(v) for k, v in vars(one).items()} for one in self.degradation],
            "standards": [{k: _known(v) for k, v in vars(one).items()} for one in self.standards],
            "not_held": [dict(vars(one)) for one in self.not_held],
            "cannot": list(self.cannot),
            "corrections": [one.as_json() for one in self.corrections],
            "seconds": self.seconds,
        }

    def _headline(self) -> str:
        cyclic = len({row.run for row in self.of(CYCLE)})
        runs = len({row.run for row in self.rows})
        return f"{self.campaign}: bearing quantities of {runs} runs, {cyclic} of them cyclic"

    def _rows(self) -> list[dict[str, Any]]:
        out = []
        for row in self.rows:
            about = {"run": row.run, "bearing": row.bearing, "part": row.part}
            about |= {"series": row.series or None, "cycle": row.cycle or None}
            out.append({**about, **{key: _known(value.measured) for key, value in row.values.items()}})
        return out


def _value(value: QuantityValue) -> dict[str, float | None]:
    return {name: _known(getattr(value, name)) for name in ("measured", "law", "low", "high")}


def _known(value: Any) -> Any:
    """Return a number as JSON knows it: null where it is not known."""
    if isinstance(value, float | np.floating):
        return float(value) if np.isfinite(value) else None
    return value
