"""How every result shows itself: one line, a table in a notebook, a pandas frame, a picture."""

import html
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any

from slipwise.errors import InputError, visible
from slipwise.short_repr import shortened

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from pandas import DataFrame

#: Entry point by which the pictures are found, so that numerics import none of them.
PICTURES = "slipwise.pictures"
#: Rows that a notebook shows of a long table.
_MOST_ROWS = 30


class Shown(ABC):
    """Something that a notebook shows by a headline and a table."""

    @abstractmethod
    def _headline(self) -> str:
        """Return what it is in one line."""

    @abstractmethod
    def _rows(self) -> Sequence[Mapping[str, Any]]:
        """Return it as the rows of a table."""

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {shortened(self._headline())}>"

    def _repr_html_(self) -> str:
        """Return the headline and the table; this is what Jupyter shows."""
        rows = self._rows()
        more = f"<p>and {len(rows) - _MOST_ROWS} rows more</p>" if len(rows) > _MOST_ROWS else ""
        return f"<p>{_escape(self._headline())}</p>{_html(rows[:_MOST_ROWS])}{more}"


class Tabular(Shown):
    """A result whose table is all that a data frame needs to hold."""

    def to_pandas(self) -> "DataFrame":
        """Return the table as a pandas frame.

        Raises:
            InputError: pandas is not installed.
        """
        return frame(self._rows())


class Drawn(Shown):
    """A result that has a picture."""

    def plot(self) -> "Figure":
        """Draw it.

        Returns:
            The matplotlib figure; a notebook shows it, `figure.savefig("name.png")` writes it.

        Raises:
            InputError: this installation states no function that draws.
        """
        for found in entry_points(group=PICTURES):
            return found.load()(self)
        raise InputError(
            f"nothing can draw this result: the installed slipwise states no entry point of the group {PICTURES}; "
            "install it again with `pip install --force-reinstall --no-deps slipwise`, or from its source folder"
        )


def frame(table: Sequence[Mapping[str, Any]] | Mapping[str, Any]) -> "DataFrame":
    """Turn rows, or columns by name, into a pandas frame.

    Raises:
        InputError: pandas is not installed.
    """
    try:
        import pandas
    except ModuleNotFoundError:
        raise InputError('pandas is not installed; it comes with `pip install "slipwise[notebook]"`') from None
    return pandas.DataFrame(table)


def _html(rows: Sequence[Mapping[str, Any]]) -> str:
    """Write rows as a plain HTML table; nothing where there is no row."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    if not names:
        return ""
    head = "".join(f"<th>{_escape(name)}</th>" for name in names)
    body = "".join("<tr>" + "".join(f"<td>{_cell(row.get(name))}</td>" for name in names) + "</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return _escape(f"{value:.4g}" if isinstance(value, float) else str(value))


def _escape(text: str) -> str:
    return html.escape(visible(text))
