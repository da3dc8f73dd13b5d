"""MATLAB files: version 5 by scipy, version 7.3 (which is HDF5) by the optional h5py.

A vector is a column under its own name, column k of a matrix is "name(:,k)", a field of a structure is "name.field",
element k of a structure or cell array is "name(k)" and "name{k}". Channels in rows are turned into columns.
"""

import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.io import loadmat
from scipy.io.matlab import MatlabOpaque

from slipwise.errors import InputError

Array = NDArray[np.float64]
#: A matrix with more columns than this is no table of channels, and elements of an array beyond it are none.
_WIDEST = 200
#: Structures within structures beyond this depth are no channels.
_DEEPEST = 12
#: A file that unpacks to more bytes than this is no record of a rig.
_LARGEST = 800_000_000
_HEADER, _TAG, _COMPRESSED = 128, 8, 15
#: Bytes of an unpacked variable that hold its name.
_NAMED = 400


def matlab_variables(path: Path) -> dict[str, Array]:
    """Read every column of numbers from a .mat file.

    Raises:
        InputError: not a .mat file, a version that needs an extra that is not installed, or no columns in it.
    """
    _check_size(path)
    try:
        content = loadmat(path, squeeze_me=False, struct_as_record=True, simplify_cells=True)
    except NotImplementedError:
        content = _hdf5(path)
    except Exception as error:  # damaged files raise zlib, index, key and memory errors from scipy's depths
        raise InputError(
            f"{path}: not a readable MATLAB file ({error or type(error).__name__}); save it again"
        ) from None
    columns: dict[str, Array] = {}
    opaque: list[str] = []
    for name, value in content.items():
        if isinstance(value, MatlabOpaque):
            opaque.append(name)
        elif not name.startswith("__"):
            _add(columns, name, value, _DEEPEST)
    if not columns:
        objects = f"; it holds objects ({', '.join(opaque)}): save ts.Time and ts.Data as vectors" if opaque else ""
        raise InputError(f"{path}: no vector or matrix of numbers in this MATLAB file{objects}")
    return columns


def _check_size(path: Path) -> None:
    """Refuse a file of version 5 whose compressed variables unpack to more than any record of a rig.

    Raises:
        InputError: it does.
    """
    data = path.read_bytes()
    order = {b"IM": "<", b"MI": ">"}.get(data[126:128])
    if order is None:
        return
    at, total = _HEADER, 0
    while at + _TAG <= len(data):
        kind, size = struct.unpack_from(f"{order}II", data, at)
        if kind == _COMPRESSED:
            unpack, part = zlib.decompressobj(), data[at + _TAG : at + _TAG + size]
            head = b""
            try:
                while part and total <= _LARGEST:
                    block = unpack.decompress(part, 1 << 24)
                    head, total, part = head or block[:_NAMED], total + len(block), unpack.unconsumed_tail
            except zlib.error as error:
                raise InputError(f"{path}: not a readable MATLAB file ({error}); save it again") from None
        if total > _LARGEST:
            raise InputError(
                f"{path}: with {_variable(head, order)} it unpacks to more than {_LARGEST / 1e6:g} MB; save the "
                "channels of one run in a file"
            )
        at += _TAG + size


def _variable(head: bytes, order: str) -> str:
    """Give name and shape of a variable, from the beginning of its unpacked element."""
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


def _add(columns: dict[str, Array], name: str, value: Any, depth: int) -> None:
    """Add the columns that a variable holds."""
    if depth < 0:
        return
    if isinstance(value, dict):
        for field, inner in value.items():
            _add(columns, f"{name}.{field}", inner, depth - 1)
        return
    if isinstance(value, list) or (isinstance(value, np.ndarray) and value.dtype == object):
        items = (value if isinstance(value, list) else list(value.ravel()))[:_WIDEST]
        brackets = "()" if items and isinstance(items[0], dict) else "{}"
        for k, inner in enumerate(items, 1):
            _add(columns, f"{name}{brackets[0]}{k}{brackets[1]}", inner, depth - 1)
        return
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or array.size < 2:
        return
    array = np.squeeze(array)
    if array.ndim == 1:
        columns[name] = array.astype(float)
    elif array.ndim == 2:
        rows = array.shape[1] > _WIDEST >= array.shape[0]
        table = array.T if rows else array
        if table.shape[1] <= _WIDEST:
            for k in range(table.shape[1]):
                columns[f"{name}({k + 1},:)" if rows else f"{name}(:,{k + 1})"] = table[:, k].astype(float)


def _hdf5(path: Path) -> dict[str, Any]:
    try:
        import h5py  # type: ignore[import-not-found]
    except ModuleNotFoundError:
        raise InputError(
            f"{path}: this MATLAB file is of version 7.3; install h5py with `pip install 'slipwise[matlab73]'`, "
            "or save it in MATLAB with save(..., '-v7')"
        ) from None

    total = 0

    def content(group: Any, file: Any, depth: int) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for name, item in group.items():
            if name.startswith("#") or depth < 0:
                continue
            found[name] = content(item, file, depth - 1) if isinstance(item, h5py.Group) else values(item, file, depth)
        return found

    def values(item: Any, file: Any, depth: int) -> Any:
        nonlocal total
        total += item.size * item.dtype.itemsize
        if total > _LARGEST:
            raise InputError(
                f"{path}: with {item.name!r} of {' x '.join(map(str, item.shape))} it holds more than "
                f"{_LARGEST / 1e6:g} MB; save the channels of one run in a file"
            )
        # MATLAB stores columns first
        array = np.asarray(item).T
        if array.dtype.kind != "O":
            return array
        # cells and structure arrays hold references
        inner = [file[reference] for reference in array.ravel()[:_WIDEST] if depth > 0]
        return [content(i, file, depth - 1) if isinstance(i, h5py.Group) else values(i, file, depth - 1) for i in inner]

    try:
        with h5py.File(path, "r") as file:
            return content(file, file, _DEEPEST)
    except InputError:
        raise
    except Exception as error:  # damaged files raise what HDF5 raises
        raise InputError(f"{path}: not a readable MATLAB file ({error}); save it again") from None
