"""A message of the workbench's server, read as the page does."""

import json
from typing import Any

import numpy as np


def unpacked(message: bytes) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Return the head and the arrays of a message."""
    length = int.from_bytes(message[:4], "little")
    head = json.loads(message[4 : 4 + length])
    assert (4 + length) % 4 == 0, "arrays stand where the browser can read them in place"
    numbers = np.frombuffer(message[4 + length :], "<f4")
    arrays = {}
    for name, (first, shape) in head["arrays"].items():
        size = int(np.prod(shape))
        arrays[name] = numbers[first : first + size].reshape(shape[::-1]).T
    return head, arrays
