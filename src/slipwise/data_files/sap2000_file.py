"""Tables that SAP2000 writes as text: a row is a line of key=value; a time history has a row for each step and object.

    TABLE:  "ELEMENT FORCES - LINKS"
       Link=1   OutputCase=TH1   StepType=Time   StepNum=0.01   P=-24.5   V2=1.3

Every object becomes columns of its own, "Link 1 V2"; times are the column "StepNum". Objects of several tables stand
beside each other where they have the same steps. Lines that go on end in " _".

Source: CSI Analysis Reference, tables of the interactive database exported as text (.$2k, .s2k, .txt).
"""

import re
from pathlib import Path

import numpy as np

from slipwise.arrays import Array
from slipwise.data_files.named_columns import NamedColumns
from slipwise.errors import InputError
from slipwise.input_file import read_input
from slipwise.text_encoding import decoded

_TABLE = re.compile(r'^\s*TABLE:\s+"(?P<name>[^"]*)"', re.MULTILINE)
_PAIR = re.compile(r'(?P<key>[A-Za-z]\w*)=(?:"(?P<text>[^"]*)"|(?P<value>\S+))')
#: What names an object, the first that a row has; and its time.
_OBJECTS, _TIME = ("Link", "Joint", "Frame", "GenDispl", "SectionCut"), "StepNum"


def is_sap2000(path: Path) -> bool:
    """Return whether a text file holds tables of SAP2000."""
    with path.open("rb") as stream:
        return bool(_TABLE.search(decoded(stream.read(1 << 16))))


def read_sap2000(path: Path) -> NamedColumns:
    """Read the time histories of all tables of a file.

    Raises:
        InputError: no row has a step of time, or an object lacks steps that others have.
    """
    columns: dict[str, dict[float, float]] = {}
    for line in re.sub(r" _\r?\n", " ", decoded(read_input(path))).splitlines():
        row = {m["key"]: m["text"] if m["text"] is not None else m["value"] for m in _PAIR.finditer(line)}
        named = next((key for key in _OBJECTS if key in row), None)
        time = _number(row.get(_TIME, ""))
        if named is None or time is None or row.get("StepType", "Time") != "Time":
            continue
        for key, text in row.items():
            if key not in (named, _TIME) and (value := _number(text)) is not None:
                columns.setdefault(f"{named} {row[named]} {key}", {})[time] = value
    if not columns:
        raise InputError(
            f"{path}: no row of its tables has StepType=Time and StepNum; export the time history step by step, with "
            "the tables of links and joints"
        )
    times = sorted({time for steps in columns.values() for time in steps})
    whole: dict[str, Array] = {_TIME: np.array(times)}
    for name, steps in columns.items():
        if len(steps) != len(times):
            raise InputError(
                f"{path}: {name} has {len(steps)} steps of {len(times)}; export all objects of one case alone"
            )
        whole[name] = np.array([steps[time] for time in times])
    return NamedColumns(whole)


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
