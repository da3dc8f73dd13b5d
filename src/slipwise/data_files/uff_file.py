"""Universal files (.uff, .unv): time responses of dataset 58, which modal analysis exchanges; read by pyuff."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.data_files.named_columns import NamedColumns, NamedGauge, of_gauges, unreadable
from slipwise.errors import InputError, missing_library

#: Type of a function that is a time response; 0 is not told, and has times if its abscissa is one of time.
_TIME_RESPONSE, _NOT_TOLD = 1, 0
#: Specific type of an abscissa of time.
_TIME = 17
#: What begins and ends a dataset; it stands behind the numbers of a binary one, and may be filled up with blanks.
_MARK = re.compile(rb" {4}-1(?:[\r\n]| {74}|$)")
_DIRECTIONS = {1: "X+", -1: "X-", 2: "Y+", -2: "Y-", 3: "Z+", -3: "Z-"}


def read_uff(path: Path) -> NamedColumns:
    """Read every time response of dataset 58; spectra and frequency responses are left out, and it is said.

    Raises:
        InputError: pyuff is not installed, the file is damaged, or it holds no time response.
    """
    try:
        import pyuff  # type: ignore[import-not-found]
    except ModuleNotFoundError:
        raise missing_library(path, "universal files", "pyuff", "uff", "export the time responses as CSV") from None
    _check_whole(path)
    try:
        file = pyuff.UFF(str(path))
        kinds = [int(kind) for kind in np.atleast_1d(file.get_set_types())]
        sets: list[Any] = [file.read_sets(i) for i, kind in enumerate(kinds) if kind == 58]
        gauges = [_gauge(path, one) for one in sets if _is_time_response(one)]
    except InputError:
        raise
    except Exception as error:  # pyuff lets value, index and key errors of damaged files through
        raise unreadable(path, "universal file", error) from None
    if not gauges:
        there = f"{len(sets)} functions of dataset 58" if sets else f"datasets {', '.join(map(str, kinds)) or 'none'}"
        raise InputError(f"{path}: no time response is in this universal file; it holds {there}")
    read = of_gauges(path, gauges, "universal")
    left = len(sets) - len(gauges)
    said = (f"{path.name}: left out are {left} functions that are no time responses",) if left else ()
    return NamedColumns(read.columns, read.step, (*read.notes, *said))


def _check_whole(path: Path) -> None:
    """Refuse a file whose last dataset does not end; pyuff would leave it out without a word.

    Raises:
        InputError: it was cut, or is no universal file.
    """
    marks = len(_MARK.findall(path.read_bytes()))
    if not marks:
        raise InputError(f"{path}: not a readable universal file: no line of it is '    -1'; export it again")
    if marks % 2:
        raise InputError(f"{path}: the file ends before its last dataset does: it was cut; copy or export it again")


def _is_time_response(one: Mapping[str, Any]) -> bool:
    kind = int(one["func_type"])
    return kind == _TIME_RESPONSE or (kind == _NOT_TOLD and int(one.get("abscissa_spec_data_type") or 0) == _TIME)


def _gauge(path: Path, one: Mapping[str, Any]) -> NamedGauge:
    values = np.asarray(one["data"])
    if np.iscomplexobj(values):
        raise InputError(f"{path}: {_name(one)} is a time response of complex numbers; export it as real ones")
    stated = int(one["num_pts"])
    if len(values) != stated:
        raise InputError(
            f"{path}: {_name(one)} states {stated} points and holds {len(values)}: the file was cut; export it again"
        )
    return NamedGauge(
        _name(one), _label(one, "ordinate_axis_units_lab"), values.astype(float), np.asarray(one["x"], float)
    )


def _name(one: Mapping[str, Any]) -> str:
    """Return what the function is called, or the entity, node and direction of its response."""
    told = _label(one, "id1") or _label(one, "rsp_ent_name")
    direction = _DIRECTIONS.get(int(one.get("rsp_dir") or 0), "")
    return told or f"node {int(one.get('rsp_node') or 0)} {direction}".strip()


def _label(one: Mapping[str, Any], key: str) -> str:
    text = str(one.get(key) or "").strip()
    return "" if text.upper() == "NONE" else text
