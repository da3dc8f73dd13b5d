"""Figures become SVG that can stand in a page, the same every time."""

import re
import xml.etree.ElementTree as ElementTree

from matplotlib import rcParams

from slipwise.view.figures.canvas import figure_svg, save_figure
from slipwise.view.figures.loop_pictures import loops_figure
from slipwise.view.figures.pictures import modes_figure


def test_the_same_record_gives_the_same_svg_and_the_same_png(record, tmp_path):
    assert figure_svg(loops_figure(record)) == figure_svg(loops_figure(record))
    first = save_figure(loops_figure(record), tmp_path / "a.png").read_bytes()
    assert first == save_figure(loops_figure(record), tmp_path / "b.png").read_bytes()


def test_an_svg_is_one_element_without_date_and_without_anything_from_elsewhere(record):
    svg = figure_svg(loops_figure(record))
    root = ElementTree.fromstring(svg)
    assert root.tag.endswith("svg") and len(list(root.iter())) > 100
    assert "<?xml" not in svg and "<!DOCTYPE" not in svg and "<metadata" not in svg
    links = re.findall(r'href="([^"]*)"', svg)
    assert links and all(link.startswith(("#", "data:image/png;base64,")) for link in links)


def test_every_reference_inside_an_svg_resolves_and_two_figures_share_no_id(record, geometry):
    ids = []
    for figure in (loops_figure(record), modes_figure(record, geometry)):
        svg = figure_svg(figure)
        own = re.findall(r'\bid="([^"]*)"', svg)
        assert len(own) == len(set(own))
        assert set(re.findall(r'href="#([^"]*)"', svg)) | set(re.findall(r"url\(#([^)]*)\)", svg)) <= set(own)
        ids += own
    assert len(ids) == len(set(ids))


def test_a_long_record_does_not_swell_the_svg(record):
    from slipwise.record import Record

    long = Record(record.time, record.channels)
    for _ in range(3):
        joined = {name: [*v, *v] for name, v in long.channels.items()}
        long = Record(*_arrays([*long.time, *(long.time + long.time[-1] + long.dt)], joined))
    assert len(long) > 12_000
    assert len(figure_svg(loops_figure(long))) < 1_000_000


def _arrays(time, channels):
    import numpy as np

    return np.array(time), {name: np.array(values) for name, values in channels.items()}


def test_drawing_leaves_matplotlib_as_it_was(record):
    before = dict(rcParams)
    figure_svg(loops_figure(record))
    assert dict(rcParams) == before
