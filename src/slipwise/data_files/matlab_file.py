"""MATLAB files: version 5 by scipy, version 7.3 (which is HDF5) by the optional h5py.

Where a structure names its channels, they are columns under that name, with their unit. Elsewhere a vector is a column
under its own name, column k of a matrix is "name(:,k)", a field of a structure is "name.field", element k of an array
of structures or cells is "name(k)" and "name{k}". Channels in rows are turned into columns.
"""

import struct
import warnings
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import loadmat
from scipy.io.matlab import MatlabOpaque

from slipwise.arrays import Array
from slipwise.data_files.matlab_hdf5 import DEEPEST, LARGEST, WIDEST, read_hdf5
from slipwise.data_files.matlab_objects import left_out, object_of
from slipwise.data_files.matlab_structures import joined_headers, stated_steps, told_channel, told_matrix
from slipwise.data_files.named_columns import NamedColumns, one_step, unreadable
from slipwise.errors import InputError

_HEADER, _TAG, _COMPRESSED = 128, 8, 15
#: Bytes of an unpacked variable that hold its name.
_NAMED = 400


def read_matlab(path: Path) -> NamedColumns:
    """Read every column of numbers from a .mat file.

    Raises:
        InputError: not a .mat file, a version that needs an extra that is not installed, or no columns in it.
    """
    objects = _checked(path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # objects, which are told of below, all bear the same name in scipy
            content = loadmat(path, squeeze_me=False, struct_as_record=True, simplify_cells=True)
    except NotImplementedError:
        content, objects = read_hdf5(path)
    except Exception as error:  # damaged files raise zlib, index, key and memory errors from scipy's depths
        raise unreadable(path, "MATLAB file", error, "save it again") from None
    variables = {
        name: value
        for name, value in content.items()
        if not name.startswith("__") and not isinstance(value, MatlabOpaque) and not (objects and name == "None")
    }
    columns: dict[str, Array] = {}
    steps: set[float] = set()
    _add_fields(columns, steps, "", joined_headers(variables), DEEPEST)
    said = left_out(objects)
    if not columns:
        raise InputError(f"{path}: no vector or matrix of numbers in this MATLAB file" + (f"; {said}" if said else ""))
    return NamedColumns(columns, one_step(path, steps), (f"{path.name}: {said}",) if said else ())


def _checked(path: Path) -> dict[str, str]:
    """Refuse a file of version 5 whose compressed variables unpack to more than any record of a rig.

    Returns:
        Name -> class of the objects in it.

    Raises:
        InputError: it does.
    """
    objects: dict[str, str] = {}
    data = path.read_bytes()
    order = {b"IM": "<", b"MI": ">"}.get(data[126:128])
    if order is None:
        return objects
    at, total = _HEADER, 0
    while at + _TAG <= len(data):
        kind, size = struct.unpack_from(f"{order}II", data, at)
        head = data[at : at + _NAMED]
        if kind == _COMPRESSED:
            unpack, part = zlib.decompressobj(), data[at + _TAG : at + _TAG + size]
            head = b""
            try:
                while part and total <= LARGEST:
                    block = unpack.decompress(part, 1 << 24)
                    head, total, part = head or block[:_NAMED], total + len(block), unpack.unconsumed_tail
            except zlib.error as error:
                raise unreadable(path, "MATLAB file", error, "save it again") from None
        if total > LARGEST:
            raise InputError(
                f"{path}: with {_variable(head, order)} it unpacks to more than {LARGEST / 1e6:g} MB; save the "
                "channels of one run in a file"
            )
        found = object_of(head, order)
        if found is not None:
            objects[found[0]] = found[1]
        at += _TAG + size
    return objects


def _variable(head: bytes, order: str) -> str:
    """Return name and shape of a variable, from the beginning of its unpacked element."""
    try:
        # tag 8, array flags 16, then dimensions and name, each behind a tag and filled up to 8 bytes
        count = struct.unpack_from(f"{order}I", head, 28)[0]
        shape = struct.unpack_from(f"{order}{min(count // 4, 8)}i", head, 32)
        at = 32 + -(-count // 8) * 8
        kind = struct.unpack_from(f"{order}I", head, at)[0]
        # names of up to four letters stand in the tag itself
        size, at = (kind >> 16, at + 4) if kind >> 16 else (struct.unpack_from(f"{order}I", head, at + 4)[0], at + 8)
        name = head[at : at + size].decode("ascii", "replace")
    except struct.error:
        return "a variable that is damaged"
    return f"the variable {name!r} of {' x '.join(map(str, shape))}"


def _add_fields(columns: dict[str, Array], steps: set[float], name: str, fields: Mapping[str, Any], depth: int) -> None:
    """Add the columns of a structure, or of the whole file: those that it names, then those that their path names."""
    if depth < 0:
        return
    steps.update(stated_steps(fields))
    prefix = f"{name}." if name else ""
    told, matrix = told_channel(fields), told_matrix(fields)
    done = ""
    if told is not None:
        done = told.field
        _put(columns, f"{prefix}{done}", told.header, told.values)
    elif matrix is not None:
        done, headers = matrix
        for k, header in enumerate(headers):
            _put(columns, f"{prefix}{done}(:,{k + 1})", header, np.asarray(fields[done])[:, k].astype(float))
    for field, inner in fields.items():
        if field != done:
            _add(columns, steps, f"{prefix}{field}", inner, depth - 1)


def _put(columns: dict[str, Array], path: str, header: str, values: Array) -> None:
    """Add a column under the name that it is given, or under its path where another has that name."""
    columns[path if header in columns else header] = values


def _add(columns: dict[str, Array], steps: set[float], name: str, value: Any, depth: int) -> None:
    """Add the columns that a variable holds."""
    if depth < 0:
        return
    if isinstance(value, dict):
        _add_fields(columns, steps, name, value, depth)
        return
    if isinstance(value, list) or (isinstance(value, np.ndarray) and value.dtype == object):
        items = (value if isinstance(value, list) else list(value.ravel()))[:WIDEST]
        brackets = "()" if items and isinstance(items[0], dict) else "{}"
        for k, inner in enumerate(items, 1):
            _add(columns, steps, f"{name}{brackets[0]}{k}{brackets[1]}", inner, depth - 1)
        return
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or array.size < 2:
        return
    array = np.squeeze(array)
    if array.ndim == 1:
        columns[name] = array.astype(float)
    elif array.ndim == 2:
        rows = array.shape[1] > WIDEST >= array.shape[0]
        table = array.T if rows else array
        if table.shape[1] <= WIDEST:
            for k in range(table.shape[1]):
                columns[f"{name}({k + 1},:)" if rows else f"{name}(:,{k + 1})"] = table[:, k].astype(float)
