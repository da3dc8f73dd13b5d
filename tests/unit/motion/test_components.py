"""Which component shakes the table where: by name, by choice, and what cannot be told is asked for."""

import warnings

import numpy as np
import pytest

from slipwise.errors import InputError, SlipwiseWarning, UnknownNameError
from slipwise.motion import load_motion
from slipwise.motion.orientation import name_from_stem, orientation
from unit.motion import samples


@pytest.fixture
def files(tmp_path):
    """Write files and give their paths."""

    def write(**contents: bytes):
        for name, data in contents.items():
            (tmp_path / name).write_bytes(data)
        return [tmp_path / name for name in contents]

    return write


def at2(component: str, n: int = 40, scale: float = 1.0, **settings) -> bytes:
    return samples.at2(scale * samples.wave(n) / 1000, component=component, **settings)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("E-W", "east-west"), ("EW", "east-west"), ("90 DEG", "east-west"), ("270", "east-west"), ("090", "east-west"),
        ("N90E", "east-west"), ("NS", "horizontal"), ("N28W", "horizontal"), ("360", "horizontal"),
        ("0 DEG", "horizontal"), ("L", "horizontal"), ("147", "horizontal"),
        ("UP", "up"), ("U-D", "up"), ("V", "up"), ("DWN", "down"),
        ("Down", "down"), ("table_ax", "table x"), ("table_az", "table z"), ("Northridge", "unknown"),
        ("450", "unknown"),
    ],
)  # fmt: skip
def test_a_components_name_tells_where_it_points(name, expected):
    assert orientation(name) == expected


def test_a_file_name_ends_in_its_component_or_does_not():
    stems = ("TCU065-E", "RSN1633_MANJIL_ABBAR--L", "Kobe_1995_TAK-090", "Northridge_1994", "run_2")
    assert [name_from_stem(stem) for stem in stems] == ["E", "L", "090", "", ""]


def test_east_west_shakes_x_north_south_y_and_down_is_turned_into_up(files):
    paths = files(a=at2("DWN", scale=3), b=at2("NS", scale=2), c=at2("EW"))
    motion = load_motion(paths)
    assert motion.components == ("EW", "NS", "-DWN")
    np.testing.assert_allclose(motion.acceleration[:, 1], 2 * motion.acceleration[:, 0], rtol=1e-6)
    np.testing.assert_allclose(motion.acceleration[:, 2], -3 * motion.acceleration[:, 0], rtol=1e-6)
    assert [name for name, _ in motion.sources] == ["c", "b", "a"]
    assert all(len(digest) == 64 for _, digest in motion.sources)


def test_without_an_east_west_component_the_first_horizontal_one_shakes_x(files):
    assert load_motion(files(a=at2("237"), b=at2("147"), c=at2("UP"))).components == ("237", "147", "UP")


def test_a_single_component_shakes_x_and_a_single_vertical_one_z_with_a_warning(files):
    assert load_motion(files(a=at2("whatever"))).components == ("a", "", "")
    with pytest.warns(SlipwiseWarning, match="no horizontal component"):
        assert load_motion(files(b=at2("UP"))).components == ("", "", "UP")


def test_the_user_chooses_by_name_by_file_with_either_sign_and_may_leave_an_axis_at_rest(files):
    paths = files(one=at2("EW"), two=at2("NS", scale=2), three=at2("UD", scale=3))
    default = load_motion(paths)
    assert load_motion(paths, x="N-S").components == ("NS", "EW", "UD")
    reversed_x = load_motion(paths, x="-EW", y="none")
    assert reversed_x.components == ("-EW", "", "UD")
    np.testing.assert_array_equal(reversed_x.acceleration[:, 0], -default.acceleration[:, 0])
    assert np.all(reversed_x.acceleration[:, 1] == 0)
    assert load_motion([], x=paths[1], z=str(paths[2])).components == ("NS", "", "UD")
    assert load_motion([], x=f"-{paths[1]}").components == ("-NS", "", "")
    assert load_motion(paths, x="three", y="none", z="none").components == ("UD", "", "")
    assert "-EW drives the table in x" in " ".join(reversed_x.treatment)


def test_a_sign_that_is_written_is_taken_literally_and_one_that_is_not_turns_down_into_up(files):
    paths = files(h=at2("EW"), v=at2("DWN"))
    up, plain = load_motion(paths), load_motion(paths, z="DWN")
    np.testing.assert_array_equal(up.acceleration, plain.acceleration)
    np.testing.assert_array_equal(up.acceleration, load_motion(paths, z="-DWN").acceleration)
    np.testing.assert_array_equal(up.acceleration[:, 2], -load_motion(paths, z="+DWN").acceleration[:, 2])


def test_components_whose_names_tell_nothing_must_be_assigned(files):
    paths = files(a=at2("one"), b=at2("two"))
    with pytest.raises(InputError, match="--x, --y and --z"):
        load_motion(paths)
    assert load_motion(paths, x="a", y="none", z="b").components == ("a", "", "b")


def test_two_vertical_or_three_horizontal_components_must_be_assigned(files):
    vertical = files(a=at2("EW"), b=at2("UP"), c=at2("DWN"))
    with pytest.raises(InputError, match="cannot be told"):
        load_motion(vertical)
    assert load_motion(vertical, z="UP").components == ("EW", "", "UP")
    with pytest.raises(InputError, match="cannot be told"):
        load_motion(files(d=at2("EW"), e=at2("NS"), f=at2("45")))


def test_a_name_that_two_files_share_is_refused_and_one_that_none_has_offers_the_nearest(files):
    paths = files(a=at2("EW"), b=at2("EW"), c=at2("NS"))
    with pytest.raises(InputError, match="EW of a or EW of b"):
        load_motion(paths, x="EW")
    with pytest.raises(InputError, match="has no name"):
        load_motion(paths, x="")
    with pytest.raises(UnknownNameError, match="x: no component or file is called 'N'"):
        load_motion(paths, x="N")


def test_unequal_lengths_are_trimmed_at_the_end_and_it_is_said(files):
    with pytest.warns(SlipwiseWarning, match="x 40, z 36 samples"):
        motion = load_motion(files(a=at2("EW"), b=at2("UP", n=36)))
    assert len(motion) == 36
    assert "the first 36 of each are used" in motion.treatment[-1]


def test_different_steps_are_refused(files):
    with pytest.raises(InputError, match=r"different steps.*0\.01 s.*0\.02 s"):
        load_motion(files(a=at2("EW"), b=at2("UP", dt=".0200")))


def test_the_baseline_is_the_formats_unless_the_user_says_otherwise_and_it_is_stated(files):
    (path,) = files(a=samples.knet(samples.counts()))
    by_format, kept = load_motion([path]), load_motion([path], baseline="none")
    line = load_motion([path], baseline="linear")
    assert by_format.acceleration[:, 0].mean() == pytest.approx(0, abs=1e-15)
    assert kept.acceleration[:, 0].mean() == pytest.approx(samples.counts().mean() * 2000 / 8388608 * 0.01)
    assert np.polyfit(line.time, line.acceleration[:, 0], 1) == pytest.approx([0, 0], abs=1e-12)
    assert any("mean of" in words for words in by_format.treatment)
    assert any("left as it is" in words for words in kept.treatment)
    assert any("line from" in words for words in line.treatment)


def test_a_three_component_file_fills_all_axes_and_tells_what_each_header_states(files):
    values = samples.wave(amplitude=4000.0)
    (path,) = files(a=samples.geonet([("S62W", values), ("Up", values / 2), ("N28W", values / 4)]))
    motion = load_motion([path])
    assert motion.components == ("S62W", "N28W", "Up")
    ratios = [peak.value / motion.header_peaks[0].value for peak in motion.header_peaks]
    assert ratios == pytest.approx([1, 0.25, 0.5], abs=1e-4)
    assert motion.title == "Test Farm 2001 February 3 04:05:06 UT"


def test_a_table_ay_alone_stays_on_y(files):
    values = np.stack([samples.wave() / 100, samples.wave(phase=1.0) / 100], axis=1)
    (path,) = files(a=samples.own_csv(values, names=("table_ay", "table_az")))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert load_motion([path]).components == ("", "table_ay", "table_az")
