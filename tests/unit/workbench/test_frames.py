"""What the page unpacks is what was packed: head, places and numbers."""

import json

import numpy as np
import pytest

pytest.importorskip("starlette")
from slipwise.workbench.frames import frame


def unpacked(message: bytes):
    """Read a message as the page does."""
    length = int.from_bytes(message[:4], "little")
    head = json.loads(message[4 : 4 + length])
    assert (4 + length) % 4 == 0, "arrays stand where the browser can read them in place"
    numbers = np.frombuffer(message[4 + length :], "<f4")
    arrays = {}
    for name, (first, shape) in head["arrays"].items():
        size = int(np.prod(shape))
        arrays[name] = numbers[first : first + size].reshape(shape[::-1]).T
    return head, arrays


@pytest.mark.parametrize("words", ["", "a", "ab", "abc", "Größe"])
def test_arrays_come_back_column_by_column(words):
    time, pads = np.linspace(0.0, 1.0, 7), np.arange(21.0).reshape(7, 3)
    head, arrays = unpacked(frame({"kind": "curves", "words": words}, {"time": time, "pads": pads}))
    assert head["words"] == words
    assert arrays["time"] == pytest.approx(time)
    assert np.array_equal(arrays["pads"], pads)


def test_what_is_not_predicted_stays_no_number():
    _, arrays = unpacked(frame({}, {"pads": np.array([[1.0, np.nan]])}))
    assert np.isnan(arrays["pads"][0, 1]) and arrays["pads"][0, 0] == 1.0
