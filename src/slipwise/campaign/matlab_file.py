"""MATLAB files: version 5 by scipy, version 7.3 (which is HDF5) by the optional h5py.

A vector is a column under its own name, column k of a matrix is "name(:,k)", a field of a structure is "name.field".
"""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.io import loadmat
from scipy.io.matlab import MatReadError

from slipwise.errors import InputError

Array = NDArray[np.float64]
#: A matrix with more columns than this is no table of channels.
_WIDEST = 200


def matlab_variables(path: Path) -> dict[str, Array]:
    """Read every column of numbers from a .mat file.

    Raises:
        InputError: not a .mat file, a version that needs an extra that is not installed, or no columns in it.
    """
    try:
        content = loadmat(path, squeeze_me=False, struct_as_record=True, simplify_cells=True)
    except NotImplementedError:
        content = _hdf5(path)
    except (MatReadError, ValueError, TypeError, OSError) as error:
        raise InputError(f"{path}: not a readable MATLAB file ({error})") from None
    columns: dict[str, Array] = {}
    for name, value in content.items():
        if not name.startswith("__"):
            _add(columns, name, value)
    if not columns:
        raise InputError(f"{path}: no vector or matrix of numbers in this MATLAB file")
    return columns


def _add(columns: dict[str, Array], name: str, value: Any) -> None:
    if isinstance(value, dict):
        for field, inner in value.items():
            _add(columns, f"{name}.{field}", inner)
        return
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or array.size < 2:
        return
    array = np.squeeze(array)
    if array.ndim == 1:
        columns[name] = array.astype(float)
    elif array.ndim == 2 and array.shape[1] <= _WIDEST:
        for k in range(array.shape[1]):
            columns[f"{name}(:,{k + 1})"] = array[:, k].astype(float)


def _hdf5(path: Path) -> dict[str, Any]:
    try:
        import h5py  # type: ignore[import-not-found]
    except ModuleNotFoundError:
        raise InputError(
            f"{path}: this MATLAB file is of version 7.3; install h5py with `pip install 'slipwise[matlab73]'`, "
            "or save it in MATLAB with save(..., '-v7')"
        ) from None

    def content(group: Any) -> dict[str, Any]:
        found: dict[str, Any] = {}
        for name, item in group.items():
            if name.startswith("#"):
                continue
            # MATLAB stores columns first
            found[name] = content(item) if isinstance(item, h5py.Group) else np.asarray(item).T
        return found

    with h5py.File(path, "r") as file:
        return content(file)
