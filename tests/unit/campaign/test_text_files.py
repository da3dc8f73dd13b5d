"""Text tables as loggers of this world write them: separators, decimal commas, encodings, lines above the header."""

import numpy as np
import pytest

from slipwise.data_files.table import open_table
from slipwise.data_files.text_file import inspect_text, read_text_columns
from slipwise.errors import InputError

HEADERS = ("time [s]", "slip_x [mm]", "pad_A_Fx [kN]")
ROWS = [(0.0, 1.5, -0.25), (0.01, -2.75, 1e-3), (0.02, 30.125, 12.0)]


def written(separator: str, decimal: str = ".", headers: tuple[str, ...] = HEADERS) -> str:
    lines = [separator.join(headers)]
    lines += [separator.join(f"{value:.6g}".replace(".", decimal) for value in row) for row in ROWS]
    return "\n".join(lines) + "\n"


def read(path, content: bytes):
    path.write_bytes(content)
    layout = inspect_text(path)
    return layout, np.stack(read_text_columns(path, layout, range(len(layout.headers)))[0], axis=1)


@pytest.mark.parametrize(
    ("separator", "decimal"), [(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ",")], ids=repr
)
def test_any_separator_and_either_decimal_mark_give_the_same_numbers(tmp_path, separator, decimal):
    layout, values = read(tmp_path / "run.csv", written(separator, decimal).encode())
    assert layout.headers == HEADERS
    assert (layout.delimiter, layout.decimal) == (separator, decimal)
    assert values == pytest.approx(np.array(ROWS))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "latin-1"])
def test_any_encoding_with_or_without_a_byte_order_mark_is_read(tmp_path, encoding):
    headers = ("time [s]", "Weg über Grund [µm]", "Kraft [kN]")
    layout, values = read(tmp_path / "run.csv", written(",", headers=headers).encode(encoding))
    assert layout.headers == headers
    assert values == pytest.approx(np.array(ROWS))


def test_japanese_headers_in_shift_jis_are_read(tmp_path):
    headers = ("時刻 [s]", "変位 [mm]", "摩擦力 [kN]")
    layout, values = read(tmp_path / "run.csv", written(",", headers=headers).encode("cp932"))
    assert layout.headers == headers
    assert values == pytest.approx(np.array(ROWS))


@pytest.mark.parametrize("ending", ["\r\n", "\r", "\n"], ids=repr)
def test_lines_may_end_in_any_way(tmp_path, ending):
    _, values = read(tmp_path / "run.csv", written(",").replace("\n", ending).encode())
    assert values == pytest.approx(np.array(ROWS))


def test_lines_above_the_header_and_a_row_of_units_below_it_are_understood(tmp_path):
    lines = ["Logger 7, serial 1234", "Operator: M. N.", "", "# t;disp;force", "s;mm;kN", *written(";").split("\n")[1:]]
    layout, values = read(tmp_path / "run.txt", "\n".join(lines).encode())
    assert layout.headers == ("t [s]", "disp [mm]", "force [kN]")
    assert values == pytest.approx(np.array(ROWS))


def test_empty_and_nan_cells_are_missing_values(tmp_path):
    content = "time [s],slip_x [mm],note\n0,1,ok\n0.1,,ok\n0.2,NaN,ok\n0.3,4,ok\n"
    path = tmp_path / "run.csv"
    path.write_text(content, encoding="utf-8")
    (slip,), _ = read_text_columns(path, inspect_text(path), [1])
    assert np.isnan(slip).tolist() == [False, True, True, False]


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "empty"),
        ("\n\n ,, \n", "empty"),
        ("0,1,2\n1,2,3\n", "a line of column names is needed"),
        ("hello\nworld\n", "no line of column names"),
    ],
    ids=["nothing", "blanks", "no header", "prose"],
)
def test_a_file_that_is_no_table_is_refused_with_what_is_needed(tmp_path, content, message):
    path = tmp_path / "run.csv"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(InputError, match=message):
        inspect_text(path)


@pytest.mark.parametrize(
    ("row", "message"),
    [("0.03,5", "2 columns where the header has 3"), ("0.03,oops,1", "'slip_x \\[mm\\]'.*oops")],
    ids=["short row", "word in a cell"],
)
def test_a_bad_row_says_where_it_is_and_what_it_holds(tmp_path, row, message):
    with pytest.raises(InputError, match=message):
        read(tmp_path / "run.csv", (written(",") + row + "\n").encode())


@pytest.mark.parametrize("tail", ["Ende der Messung f\xfcr heute\n", "9,9,9 \xb2\n"])
def test_a_western_letter_far_below_an_ascii_table_makes_no_noise(tmp_path, capfd, tail):
    body = "time [s],slip_x [mm]\n" + "".join(f"{0.01 * i:.2f},1.0\n" for i in range(20_000))
    (tmp_path / "a.csv").write_bytes((body + tail).encode("cp1252"))
    table = open_table(tmp_path / "a.csv")
    if tail[0] == "9":
        with pytest.raises(InputError, match=r"line 20002: a row with 3 columns where the header has 2"):
            table.columns([0, 1])
    else:
        assert len(table.columns([0, 1]).values[0]) == 20_000
    assert capfd.readouterr().err == ""
