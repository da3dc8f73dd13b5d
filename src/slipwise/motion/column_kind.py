"""What a column of a motion holds: time, acceleration, velocity, displacement, or a number of the row."""

import re
from typing import Literal

from slipwise.channels import is_channel
from slipwise.data_files.acceleration_unit import acceleration_factor
from slipwise.errors import UnitError
from slipwise.motion.orientation import orientation
from slipwise.units import parse_unit

Kind = Literal["time", "acceleration", "velocity", "displacement", "row number", "other"]

TABLE_ACCELERATIONS = ("table_ax", "table_ay", "table_az")
#: Taken where a file has no acceleration of the table: the command of most tables is a displacement.
TABLE_DISPLACEMENTS = ("table_dx", "table_dy", "table_dz")
_TIME = {
    "time", "t", "zeit", "tempo", "temps", "tiempo", "elapsed time", "seconds", "sec", "seconds elapsed", "zaman",
    "時間", "時刻", "时间", "time since start", "elapsed",
    "timestamp", "datetime", "date time", "clock", "uhrzeit", "zeitstempel", "hora",
}  # fmt: skip
_ROW_NUMBER = {
    "", "n", "no", "nr", "num", "index", "idx", "sample", "point", "row", "record", "i", "unnamed: 0", "id", "#",
}  # fmt: skip
_WORDS: dict[str, Kind] = {
    "acc": "acceleration", "accel": "acceleration", "acceleration": "acceleration", "vel": "velocity",
    "velocity": "velocity", "disp": "displacement", "displ": "displacement", "dis": "displacement",
    "displacement": "displacement",
    # the length of the vector, which phones write beside its components
    "absolute": "other", "total": "other", "resultant": "other", "magnitude": "other", "tgf": "other",
}  # fmt: skip


def is_time_word(name: str) -> bool:
    """Return whether a column's name is one of time."""
    return _bare(name) in _TIME


def is_column_word(name: str) -> bool:
    """Return whether a word is one that columns of motions are called by."""
    return is_time_word(name) or _bare(name) in _ROW_NUMBER or bool(_word(name)) or orientation(name) != "unknown"


def kind_of(name: str, unit: str, what: str) -> Kind:
    """Tell what a column holds, from its unit or, where it has none, from its name.

    Args:
        name: of the column.
        unit: as written, "" if there is none.
        what: the column, for messages.

    Raises:
        UnitError: a unit that is not known.
    """
    if is_channel(name):  # of a measured run only the table's channels are its motion
        kind = "acceleration" if name in TABLE_ACCELERATIONS else "other"
        return "time" if name == "time" else "displacement" if name in TABLE_DISPLACEMENTS else kind
    if not unit:
        if is_time_word(name):
            return "time"
        return "row number" if _bare(name) in _ROW_NUMBER else _word(name) or "acceleration"
    try:
        acceleration_factor(unit, what)
        return "other" if _word(name) == "other" else "acceleration"
    except UnitError as error:
        refused = error
    kinds: tuple[tuple[Kind, str], ...] = (("time", "s"), ("velocity", "m/s"), ("displacement", "m"))
    for kind, si in kinds:
        try:
            parse_unit(_plain_unit(unit), si, what)
            return kind
        except UnitError:
            continue
    if "wrong dimension" in str(refused):
        return "other"
    raise refused


def _plain_unit(unit: str) -> str:
    return re.sub(r"\bsec\b", "s", unit.strip(), flags=re.IGNORECASE)


def _bare(name: str) -> str:
    return re.sub(r"[\s_.#]+", " ", name.lower()).strip() or name.strip()


def _word(name: str) -> Kind | None:
    first = re.split(r"[\s_.:-]", name.strip().lower(), maxsplit=1)[0]
    return _WORDS.get(first)
