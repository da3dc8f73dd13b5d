"""Pictures show what a record holds and say what it lacks."""

import numpy as np
import pytest
from matplotlib.image import imread

from slipwise.record import Record
from slipwise.view.figures.loop_pictures import loops_figure
from slipwise.view.figures.pictures import histories_figure, loads_figure, modes_figure
from slipwise.view.figures.style import PAD_COLOURS, UPLIFT, envelope, mixed, rgb, shown
from slipwise.view.replay_files import draw_replay


def words(figure) -> str:
    """Everything that is written on a figure."""
    out = [figure.get_suptitle(), *(text.get_text() for text in figure.texts)]
    for axes in figure.axes:
        out += [axes.get_title(loc="left"), axes.get_xlabel(), axes.get_ylabel(), *(t.get_text() for t in axes.texts)]
        legend = axes.get_legend()
        out += [text.get_text() for text in legend.get_texts()] if legend else []
    return "\n".join(out)


@pytest.fixture(scope="module")
def files(record, geometry, tmp_path_factory):
    folder = tmp_path_factory.mktemp("pictures") / "new folder"
    return draw_replay(record, geometry, folder, "a record", pictures=True, recording=False)


def test_every_picture_is_written_and_none_is_blank(files):
    assert [path.name for path in files] == ["loops.png", "loads.png", "modes.png", "histories.png"]
    for path in files:
        picture = imread(path)
        assert picture.shape[1] == 1800
        assert len(np.unique(np.rint(255 * picture[..., :3]) @ [65536, 256, 1])) > 500
        assert 0.02 < np.mean(picture[..., :3].min(axis=-1) < 0.9) < 0.6, "ink covers a part of the paper"
    assert sorted(files[0].parent.iterdir()) == sorted(files)


def test_a_pad_has_its_own_colour_on_the_loops(files):
    pixels = np.rint(255 * imread(files[0])[..., :3])
    for colour in PAD_COLOURS.values():
        assert np.sum(np.all(pixels == rgb(colour), axis=-1)) > 200


def test_axes_are_labelled_in_the_units_of_the_laboratory(record, geometry):
    shown = words(loops_figure(record)) + words(loads_figure(record, geometry)) + words(histories_figure(record))
    for label in (
        "slip x [mm]",
        "friction F along x [kN]",
        "flatness: 1",
        "N [kN]",
        "m/s²",
        "time [s]",
        "kN cm",
        "kN/mm",
    ):
        assert label in shown


def test_loads_show_factor_a_factor_b_the_rest_and_uplift(record, geometry):
    shown = words(loads_figure(record, geometry))
    for label in ("Factor A: inertia", "Factor B: rocking", "the rest", "uplift"):
        assert label in shown


def test_modes_stand_beside_what_a_rigid_girder_asks_for(record, geometry):
    tilted = record.replaced(pad_A_N=record["pad_A_N"] + 200.0 * np.sin(record.time))
    for title in ("Heave", "Pitch", "Roll", "Warp"):
        assert title in words(modes_figure(tilted, geometry))
    figure = modes_figure(record, geometry)
    rigid, pads = figure.axes[1].lines
    on_pads = np.interp(rigid.get_xdata(), pads.get_xdata(), pads.get_ydata())
    assert np.ptp(pads.get_ydata()) > 10.0 and np.median(np.abs(on_pads - rigid.get_ydata())) < 0.05


def test_what_is_zero_in_a_plane_motion_is_left_out(record, geometry):
    assert "roll and warp: zero, not drawn" in words(modes_figure(record, geometry))
    across = [name for name in record.channels if name.endswith(("_ay", "_Fy")) or name == "slip_y"]
    plane = record.replaced(**{name: np.zeros(len(record)) for name in across})
    shown = words(histories_figure(plane)) + words(loops_figure(plane))
    for title in ("Acceleration along y", "Friction of the pads along y", "Buffers along y", "slip y [mm]"):
        assert title not in shown


def test_loads_that_never_change_still_give_a_picture_of_heave(record, geometry):
    at_rest = record.replaced(**{f"pad_{pad}_N": np.full(len(record), geometry.pad_load) for pad in "ABCD"})
    text = words(modes_figure(at_rest, geometry))
    assert "Heave" in text and "pitch and roll and warp: zero" in text


def test_loops_along_y_are_drawn_where_the_girder_slid_that_way(record):
    across = {f"pad_{pad}_Fy": record[f"pad_{pad}_Fx"] for pad in "ABCD"}
    text = words(loops_figure(record.replaced(slip_y=0.5 * record["slip_x"], **across)))
    assert "slip y [mm]" in text and "Sum of the pads, along y" in text


def test_a_record_without_a_channel_says_so_and_shows_the_rest(record, geometry):
    few = Record(record.time, {n: v for n, v in record.channels.items() if n not in ("slip_x", "girder_az", "pad_C_N")})
    assert "not recorded: slip_x" in words(loops_figure(few))
    assert "not recorded: pad_C_N" in words(loads_figure(few, geometry))
    assert "pad C" not in words(histories_figure(few)).split("Friction")[0]
    assert "not recorded: pad_C_N" in words(modes_figure(few, geometry))
    without_az = Record(record.time, {n: v for n, v in record.channels.items() if not n.startswith("girder_az")})
    assert "girder_az" in words(loads_figure(without_az, geometry))
    assert "girder_az" in words(modes_figure(without_az, geometry))


def test_a_record_without_slip_back_says_that_there_is_no_loop(record):
    stuck = record.replaced(slip_x=np.zeros(len(record)))
    assert "no loop" in words(loops_figure(stuck))


def test_long_quiet_stretches_are_left_out_and_the_title_says_so(record):
    step = record.dt
    time = np.arange(len(record) + 4000) * step
    padded = {
        name: np.concatenate([np.full(2000, v[0]), v, np.full(2000, v[0])]) for name, v in record.channels.items()
    }
    figure = histories_figure(Record(time, padded))
    assert "s of 28 s)" in words(figure)
    low, high = figure.axes[0].get_xlim()
    assert low > 5.0 and high < 23.0 and high - low > 3.0


def test_thinning_keeps_every_extreme():
    time = np.arange(20_000) * 0.001
    values = np.random.default_rng(3).normal(size=20_000)
    values[12_345] = 40.0
    thin_time, thin_values = envelope(time, values, 1000)
    assert len(thin_time) <= 2002 and np.all(np.diff(thin_time) > 0)
    assert thin_values.max() == 40.0 and thin_values.min() == values.min()
    np.testing.assert_array_equal(envelope(time[:100], values[:100], 1000)[1], values[:100])


def test_channels_are_shown_in_millimetres_kilonewtons_and_degrees_celsius(record):
    hot = record.replaced(pad_A_T=np.full(len(record), 300.0))
    np.testing.assert_allclose(shown(hot, "slip_x"), 1e3 * record["slip_x"])
    np.testing.assert_allclose(shown(hot, "pad_A_N"), 1e-3 * record["pad_A_N"])
    np.testing.assert_allclose(shown(hot, "pad_A_T"), 26.85)


@pytest.mark.parametrize(("share", "expected"), [(0.0, "#000000"), (1.0, "#ffffff"), (0.5, "#808080")])
def test_mixing_colours_goes_from_the_ground_to_the_colour(share, expected):
    assert mixed("#ffffff", "#000000", share) == expected


def test_uplift_has_a_colour_that_no_pad_has():
    assert UPLIFT not in PAD_COLOURS.values()
