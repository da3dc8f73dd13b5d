"""Figures of a page are there as files too, with the numbers that are drawn."""

import csv

import numpy as np

from slipwise.view.figures.canvas import new_figure
from slipwise.view.figures.figure_files import drawn, figures_into
from slipwise.view.pages.html import figure


def picture():
    made = new_figure(6.0, 3.0)
    lines, bars, image = made.subplots(1, 3)
    lines.set_title("slip")
    lines.plot([0.0, 1.0, 2.0], [3.0, np.nan, 5.0], label="measured")
    lines.axhline(1.0)
    bars.barh([0.0, 1.0], [7.0, 8.0], label="held out")
    bars.set_yticks([0.0, 1.0], ["pads", "girder"])
    image.imshow([[1.5, np.nan], [2.5, 3.5]])
    image.set_xticks([0, 1], ["stick", "slide"])
    return made


def test_lines_bars_and_maps_come_back_as_numbers_under_their_names():
    rows = drawn(picture())
    lines = [row for row in rows if row["panel"] == "slip"]
    assert [(row["series"], row["x"], row["y"]) for row in lines] == [("measured", "0", "3"), ("measured", "2", "5")]
    bars = [(row["y"], row["x"]) for row in rows if row["series"] == "held out"]
    assert bars == [("pads", "7"), ("girder", "8")]
    assert {(row["x"], row["value"]) for row in rows if row["value"]} == {
        ("stick", "1.5"), ("stick", "2.5"), ("slide", "3.5")}  # fmt: skip


def test_a_page_writes_them_only_where_somebody_wants_them(tmp_path):
    figure(picture(), "Nothing is written")
    with figures_into(None) as files:
        figure(picture(), "Nor here")
    assert files == []
    with figures_into(tmp_path / "figures") as files:
        text = figure(picture(), "Error of every balance").text
    assert [path.name for path in files] == ["01_error_of_every_balance.svg", "01_error_of_every_balance.csv"]
    assert files[0].read_text().strip() in text
    assert len(list(csv.DictReader(files[1].open()))) == 7


def test_a_phone_gets_its_own_figure():
    text = figure(picture(), "wide", narrow=new_figure(3.0, 3.0)).text
    assert text.count("<svg") == 2 and 'class="narrow"' in text and 'class="picture wide"' in text
