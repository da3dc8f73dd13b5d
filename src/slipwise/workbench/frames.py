"""Arrays for the page: one binary message with a head of JSON, numbers as the browser's own Float32Array reads them."""

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: The head is filled up with blanks to whole floats, so that arrays behind it are aligned.
_ALIGN = 4


def frame(head: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Pack a message: length of the head (4 bytes, little-endian), the head, then the arrays one behind the other.

    Args:
        head: what it is; `arrays` is added to it: name -> [first number, shape].
        arrays: (n,) or (n, c); a column comes whole after the other.
    """
    places: dict[str, Any] = {}
    parts: list[bytes] = []
    first = 0
    for name, values in arrays.items():
        columns = np.ascontiguousarray(np.asarray(values, dtype="<f4").T)
        places[name] = [first, list(np.shape(values))]
        parts.append(columns.tobytes())
        first += columns.size
    text = json.dumps({**head, "arrays": places}, allow_nan=False).encode()
    text += b" " * (-len(text) % _ALIGN)
    return len(text).to_bytes(4, "little") + text + b"".join(parts)
