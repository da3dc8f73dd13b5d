"""`slipwise plan` writes a page, a table and JSON, and keeps to the width of a terminal."""

import json

import pytest
from typer.testing import CliRunner

from slipwise.cli import app


@pytest.fixture(scope="module")
def planned(tmp_path_factory):
    """Plan the gauges of the reference rig; give the output and the folder."""
    out = tmp_path_factory.mktemp("plan")
    words = ["plan", "bridge1", "--gauges", "pad_*_N,slip_x,girder_ax,table_ax,pad_A_T", "--out", str(out)]
    done = CliRunner().invoke(app, words, env={"COLUMNS": "80"})
    assert done.exit_code == 0, done.output
    return done.output, out


def test_the_terminal_says_what_to_add_and_the_table_keeps_to_its_width(planned):
    said, _ = planned
    one_line = " ".join(said.split())
    assert "pad friction and uneven_seating part from pad_*_N" in one_line
    assert "No motion is planned" in one_line and "No balance of bridge1 uses pad_A_T" in one_line
    table = said[said.index("Sets of gauges;") : said.index("wrote ")].splitlines()
    assert max(map(len, table)) <= 80


def test_the_page_the_table_and_the_json_are_there_and_agree(planned):
    _, out = planned
    content = json.loads((out / "plan.json").read_text(encoding="utf-8"))
    page = (out / "plan.html").read_text(encoding="utf-8")
    assert content["sentence"] in page
    assert content["unused"] == ["pad_A_T"]
    assert not (out / "plan.csv").exists()  # no motion, no chances


def test_a_rig_that_is_none_ends_with_an_error_and_leaves_no_page(tmp_path):
    done = CliRunner().invoke(app, ["plan", "bridge9", "--out", str(tmp_path / "out")])
    assert done.exit_code != 0
    assert not (tmp_path / "out" / "plan.html").exists()
