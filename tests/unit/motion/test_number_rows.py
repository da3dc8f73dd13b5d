"""Many lines at once are read as each line alone would be."""

import numpy as np
import pytest

from slipwise.errors import InputError
from slipwise.motion.number_rows import rows_of_numbers
from slipwise.motion.source_file import source_of


def read(lines: list[str]):
    source = source_of("a.txt", "a", "\n".join(lines).encode())
    return rows_of_numbers(source, range(len(source.lines)))


@pytest.mark.parametrize(
    "form",
    ["{:.3f} {:.6e}", "  {:.2f}   {:+.5g}  ", "{:.3f},{:.6f}", "{:.3f} ; {:.6f}", "{:.3f}\t{:.6f}", "{:.4g}, {:.4E}"],
)
@pytest.mark.parametrize("sign", ["", "comma", "fortran"])
def test_numbers_are_read_however_they_are_separated_and_written(form, sign):
    if sign == "comma" and "," in form:
        form = form.replace(",", ";")
    rng = np.random.default_rng(1)
    lines = [form.format(0.01 * i, x) for i, x in enumerate(rng.standard_normal(50_003))]
    if sign == "comma":
        lines = [line.replace(".", ",") for line in lines]
    if sign == "fortran":
        lines = [line.replace("e", "D").replace("E", "d") for line in lines]
    values = read(lines)
    assert isinstance(values, np.ndarray) and values.shape == (50_003, 2)
    np.testing.assert_allclose(values[:, 0], 0.01 * np.arange(50_003), atol=0.06)


@pytest.mark.parametrize(
    ("odd", "words"),
    [
        ("1.0 x", "line 25001: 'x' is not a number"),
        ("1.0 nan", "line 25001: the value is nan"),
        ("1.0 1e99", "line 25001: '1e99' is too large"),
        ("1.0 1_000", "line 25001: '1_000' is not a number"),
        ("1.0 ٣", None),
    ],
)
def test_an_odd_line_among_thousands_is_named(odd, words):
    lines = [f"{i} 0.5" for i in range(50_000)]
    lines[25_000] = odd
    if words is None:
        values = read(lines)
        assert isinstance(values, np.ndarray) and values[25_000, 1] == 3.0
    else:
        with pytest.raises(InputError, match=words):
            read(lines)


def test_rows_of_other_lengths_are_kept_apart():
    values = read([*["1 2 3"] * 30_000, "4 5"])
    assert isinstance(values, tuple)
    assert (len(values), list(values[0]), list(values[-1])) == (30_001, [1.0, 2.0, 3.0], [4.0, 5.0])
