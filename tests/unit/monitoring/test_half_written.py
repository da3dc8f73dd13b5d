"""A file that a logger still writes is told from a whole one by its last bytes."""

import pytest

from slipwise.monitoring.half_written import how_it_ends

ROWS = "time [s],slip_x [mm]\n0,1.5\n0.01,1.75\n"


@pytest.mark.parametrize(
    ("content", "ending"),
    [
        (ROWS, "whole"),
        (ROWS.replace("\n", "\r\n"), "whole"),
        (ROWS + "0.02", "cut"),
        (ROWS + "0.02,1.7", "open"),
        (ROWS.replace(",", ";").replace(".", ",") + "0,02", "cut"),
        (ROWS.replace(",", " ") + "0.02 ", "cut"),
        ("time [s],sl", "cut"),
        ("", "cut"),
    ],
)
def test_a_line_with_fewer_columns_and_no_end_is_cut(tmp_path, content, ending):
    path = tmp_path / "run.csv"
    path.write_bytes(content.encode())
    assert how_it_ends(path) == ending


def test_two_bytes_a_character_end_like_one(tmp_path):
    path = tmp_path / "run.txt"
    path.write_bytes(ROWS.encode("utf-16"))
    assert how_it_ends(path) == "whole"
    path.write_bytes((ROWS + "0.02").encode("utf-16"))
    assert how_it_ends(path) == "cut"


def test_what_is_no_text_tells_nothing_by_its_end(tmp_path):
    path = tmp_path / "run.mat"
    path.write_bytes(b"\x00\x01\x02")
    assert how_it_ends(path) == "whole"
