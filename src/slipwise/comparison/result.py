"""A comparison as users hold it: in words, as tables for programs and pandas, as compare.json."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from slipwise.comparison.data import ComparisonData
from slipwise.comparison.tables import TABLES, as_json, rows_of
from slipwise.display import Drawn, frame
from slipwise.errors import unknown_name

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, repr=False)
class Comparison(Drawn, ComparisonData):
    """A model held against a campaign; attributes as `ComparisonData`."""

    def rows(self, table: str = "components") -> list[dict[str, Any]]:
        """Return one of the tables as rows, SI.

        Args:
            table: audit, components, system, parameters, correlations, cells, places, parity, floor (by relation),
                noise (of every gauge) or predicted_friction.

        Raises:
            UnknownNameError: no such table.
        """
        if table not in TABLES:
            raise unknown_name("table of a comparison", table, TABLES)
        return rows_of(self, table)

    def to_pandas(self, table: str = "components") -> "pandas.DataFrame":
        """Return one of the tables as a pandas frame.

        Args:
            table: as in `rows`.

        Raises:
            UnknownNameError: no such table.
            InputError: pandas is not installed.
        """
        return frame(self.rows(table))

    def as_json(self) -> dict[str, Any]:
        """Return what compare.json holds."""
        return as_json(self)

    def _headline(self) -> str:
        relation, error = self.worst
        return f"{self.campaign.name}: worst in {relation}, {error:.3g} times the noise floor"

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {"relation": r, "fitted": self.error(r, held_out=False), "held out": self.error(r, held_out=True)}
            for r in self.relations
        ]
