"""MATLAB files of version 7.3, which are HDF5, read by the optional h5py into the structures that they hold."""

from pathlib import Path
from typing import Any

import numpy as np

from slipwise.data_files.named_columns import unreadable
from slipwise.errors import InputError

#: Structures within structures beyond this depth are no channels, nor are elements of an array beyond this number.
DEEPEST, WIDEST = 12, 200
#: A file that holds more bytes than this is no record of a rig.
LARGEST = 800_000_000
_CLASS = "MATLAB_class"


def read_hdf5(path: Path) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the variables of a file, and the objects in it that are left out.

    Returns:
        Name -> value, structures as dicts, cells and arrays of structures as lists; and name -> class of the objects.

    Raises:
        InputError: h5py is not installed, the file is damaged, or it holds more than a record of a rig.
    """
    try:
        import h5py  # type: ignore[import-not-found]
    except ModuleNotFoundError:
        raise InputError(
            f"{path}: this MATLAB file is of version 7.3; install h5py with `pip install 'slipwise[matlab73]'`, "
            "or save it in MATLAB with save(..., '-v7')"
        ) from None

    total = 0
    objects: dict[str, str] = {}

    def structure(group: Any, file: Any, depth: int) -> Any:
        found: dict[str, Any] = {}
        of_references = depth >= 0
        for name, item in group.items():
            if name.startswith("#") or depth < 0:
                continue
            if "MATLAB_object_decode" in item.attrs:
                objects[item.name.strip("/").replace("/", ".")] = _text(item.attrs.get(_CLASS, "object"))
                continue
            found[name] = read(item, file, depth - 1)
            of_references &= isinstance(found[name], list) and _CLASS not in item.attrs
        # each field of an array of structures holds its elements; turned into a list of structures
        lengths = {len(value) for value in found.values()} if of_references and found else set()
        if len(lengths) == 1:
            return [dict(zip(found, element, strict=True)) for element in zip(*found.values(), strict=True)]
        return found

    def values(item: Any, file: Any, depth: int) -> Any:
        nonlocal total
        total += item.size * item.dtype.itemsize
        if total > LARGEST:
            raise InputError(
                f"{path}: with {item.name!r} of {' x '.join(map(str, item.shape))} it holds more than "
                f"{LARGEST / 1e6:g} MB; save the channels of one run in a file"
            )
        # MATLAB stores columns first
        array = np.asarray(item).T
        if _text(item.attrs.get(_CLASS, "")) == "char":
            return "".join(map(chr, array.ravel())) if "MATLAB_empty" not in item.attrs else ""
        if array.dtype.kind != "O":
            return array
        # cells and structure arrays hold references
        inner = [file[reference] for reference in array.ravel()[:WIDEST] if depth > 0]
        return [read(item, file, depth - 1) for item in inner]

    def read(item: Any, file: Any, depth: int) -> Any:
        return (structure if isinstance(item, h5py.Group) else values)(item, file, depth)

    try:
        with h5py.File(path, "r") as file:
            content = structure(file, file, DEEPEST)
    except InputError:
        raise
    except Exception as error:  # damaged files raise what HDF5 raises
        raise unreadable(path, "MATLAB file", error, "save it again") from None
    return (content if isinstance(content, dict) else {}), objects


def _text(value: Any) -> str:
    return value.decode("ascii", "replace") if isinstance(value, bytes) else str(value)
