"""What the page unpacks is what was packed: head, places and numbers."""

import numpy as np
import pytest

pytest.importorskip("starlette")
from slipwise.workbench.frames import frame  # noqa: E402  needs the extra
from unpacked_frame import unpacked  # noqa: E402


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
