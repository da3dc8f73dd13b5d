"""Synthetic motions: what is written is what is made, and every one of them ends at rest where it began."""

import numpy as np
import pytest

from slipwise.errors import InputError, SlipwiseError, UnitError, UnknownNameError
from slipwise.motion import load_motion, parse_motion, synthetic_motions, table_displacement, table_velocity

G = 9.80665
EXAMPLES = [kind.example for kind in synthetic_motions()] + [
    "quake:seed=7",
    "quake:seed=3,peak=0.4g,f=3Hz,strong=5s,across=0.3g,vertical=0.2g,10Hz",
    "sine:1.5Hz,0.1g,cycles=9,across=1.5Hz,0.1g",
    "triangle:1Hz,10cm/s",
]


@pytest.mark.parametrize("text", EXAMPLES)
def test_the_table_ends_at_rest_where_it_began(text):
    motion = parse_motion(text)
    velocity, displacement = table_velocity(motion, "none"), table_displacement(motion, "none")
    assert np.abs(velocity[-1]).max() < 1e-9 * np.abs(velocity).max()
    assert np.abs(displacement[-1]).max() < 1e-9 * np.abs(displacement).max()
    assert np.all(motion.acceleration[[0, -1]] == 0)


@pytest.mark.parametrize("text", EXAMPLES)
def test_the_same_words_give_the_same_motion(text):
    np.testing.assert_array_equal(parse_motion(text).acceleration, parse_motion(text).acceleration)


def test_a_comma_after_vertical_carries_its_second_value():
    motion = parse_motion("sine:2Hz,0.3g,cycles=30,vertical=5Hz,0.2g")
    t = motion.time
    inside = (t > motion.steady.start) & (t < motion.steady.end)
    np.testing.assert_allclose(motion.acceleration[inside, 0], 0.3 * G * np.sin(4 * np.pi * t[inside]), atol=1e-9)
    np.testing.assert_allclose(motion.acceleration[inside, 2], 0.2 * G * np.sin(10 * np.pi * t[inside]), atol=1e-9)
    assert np.all(motion.acceleration[:, 1] == 0)


def test_a_sine_ramps_in_and_out_over_four_of_its_cycles_and_never_beyond_its_peak():
    motion = parse_motion("sine:2Hz,0.3g,cycles=30")
    assert motion.duration == pytest.approx(15.0)
    assert (motion.steady.start, motion.steady.end, motion.steady.period) == pytest.approx((2.0, 13.0, 0.5))
    first_cycle = motion.acceleration[motion.time < 0.5, 0]
    assert np.abs(first_cycle).max() < 0.1 * 0.3 * G
    assert motion.peaks[0] <= 0.3 * G * 1.003


def test_the_order_of_the_options_does_not_matter_and_blanks_neither():
    one = parse_motion("sine:2Hz,0.3g,vertical=5Hz,0.2g,cycles=12")
    other = parse_motion(" sine: 2 Hz, 0.3 g, cycles = 12, vertical = 5 Hz, 0.2 g")
    np.testing.assert_array_equal(one.acceleration, other.acceleration)


def test_equal_sines_in_x_and_y_shake_at_45_degrees():
    motion = parse_motion("sine:2Hz,0.3g,across=2Hz,0.3g")
    np.testing.assert_array_equal(motion.acceleration[:, 0], motion.acceleration[:, 1])


def test_a_multisine_is_the_sum_of_its_sines():
    motion = parse_motion("multisine:1Hz,0.1g,2.5Hz,0.05g,duration=20s,vertical=6Hz,0.1g,8Hz,0.02g")
    t = motion.time
    inside = (t > 4) & (t < 16)
    expected = G * (0.1 * np.sin(2 * np.pi * t) + 0.05 * np.sin(5 * np.pi * t))
    np.testing.assert_allclose(motion.acceleration[inside, 0], expected[inside], atol=1e-9)
    assert motion.duration == pytest.approx(20.0)


def test_a_triangle_moves_at_constant_speed_between_its_turns():
    motion = parse_motion("triangle:0.5Hz,20cm/s,cycles=6,turn=200ms")
    velocity = table_velocity(motion, "none")[:, 0]
    steady = np.abs(motion.acceleration[:, 0]) == 0
    np.testing.assert_allclose(np.abs(velocity[steady & (motion.time > 0.3) & (motion.time < 12.0)]), 0.2, rtol=1e-9)
    assert steady.mean() > 0.75
    assert motion.peaks[0] == pytest.approx(4 * 0.2 / 0.2, rel=1e-6)
    travel = table_displacement(motion, "none")[:, 0]
    assert travel.max() == pytest.approx(-travel.min(), rel=1e-6)


def test_a_quake_reaches_its_peaks_about_its_frequency_for_its_time():
    motion = parse_motion("quake:seed=1,peak=0.7g,f=4Hz,strong=4s,vertical=0.3g,across=0.2g")
    assert motion.peaks == pytest.approx(np.array([0.7, 0.2, 0.3]) * G)
    power = np.mean(
        [np.abs(np.fft.rfft(parse_motion(f"quake:seed={seed}").acceleration[:, 0])) ** 2 for seed in range(40)], axis=0
    )
    frequency = np.fft.rfftfreq(len(motion), motion.dt)
    smooth = np.convolve(power, np.ones(11) / 11, mode="same")
    assert 2.5 < frequency[smooth.argmax()] < 5.0
    energy = np.cumsum(motion.acceleration[:, 0] ** 2)
    significant = np.interp([0.05, 0.95], energy / energy[-1], motion.time)
    assert 2.5 < np.diff(significant)[0] < 4.5


def test_another_seed_is_another_quake_and_a_vertical_part_leaves_the_horizontal_one_alone():
    one, two = (parse_motion(f"quake:seed={seed}").acceleration[:, 0] for seed in (1, 2))
    assert abs(np.corrcoef(one, two)[0, 1]) < 0.3
    both = parse_motion("quake:seed=1,vertical=0.3g")
    np.testing.assert_array_equal(both.acceleration[:, 0], one)
    assert abs(np.corrcoef(both.acceleration[:, 0], both.acceleration[:, 2])[0, 1]) < 0.3


def test_every_kind_is_listed_with_syntax_meaning_and_an_example_that_works():
    kinds = synthetic_motions()
    assert [kind.name for kind in kinds] == ["sine", "multisine", "triangle", "quake"]
    for kind in kinds:
        assert kind.syntax.startswith(kind.name + ":") and kind.meaning
        assert all(f"{option}=" in kind.syntax for option in kind.options)
        assert len(load_motion(kind.example)) > 1000


@pytest.mark.parametrize(
    ("text", "error", "words"),
    [
        ("sin:2Hz,0.3g", UnknownNameError, "did you mean sine"),
        ("quack:seed=1", UnknownNameError, "did you mean quake"),
        ("sine:2Hz,0.3g,cycle=30", UnknownNameError, "did you mean cycles"),
        ("quake:sead=1", UnknownNameError, "did you mean seed"),
        ("sine:2Hz", InputError, "a frequency and an acceleration"),
        ("sine:", InputError, "a frequency and an acceleration"),
        ("sine", InputError, "a frequency and an acceleration"),
        ("sine:2Hz,0.3g,vertical=5Hz", InputError, "vertical takes a frequency, an acceleration"),
        ("sine:2Hz,0.3g,cycles=30,5Hz,0.2g", InputError, "belongs to the option before it"),
        ("sine:2Hz,0.3g,cycles=30,cycles=20", InputError, "given twice"),
        ("sine:2Hz,0.3g,cycles=", InputError, "empty part"),
        ("sine:2Hz,,0.3g", InputError, "empty part"),
        ("sine:2Hz,0.3g,cycles=8", InputError, r"whole number from 9 \(4 to ramp in, 4 to ramp out, 1 at full size\)"),
        ("sine:2Hz,0.3g,cycles=ten", InputError, "whole number"),
        ("sine:2Hz,0.3g,cycles=1000000", InputError, "would last"),
        ("sine:2,0.3g", UnitError, "has no unit"),
        ("sine:2Hz,0.3", UnitError, "has no unit"),
        ("sine:0.3g,2Hz", UnitError, "wrong dimension"),
        ("sine:2Hz,0.3m", UnitError, "wrong dimension"),
        ("sine:12rad/s,0.3g", UnitError, "give it in Hz"),
        ("sine:-2Hz,0.3g", InputError, "must be positive"),
        ("sine:nan Hz,0.3g", UnitError, "is not a finite number"),
        ("sine:2Hz,1e9g", InputError, "no table reaches"),
        ("sine:5kHz,0.3g", InputError, "up to 100 Hz"),
        ("quake:4Hz", InputError, "takes options only"),
        ("quake:strong=0.1s", InputError, "at least 4"),
        ("quake:seed=-1", InputError, "whole number"),
        ("multisine:1Hz,0.1g,2Hz", InputError, "pairs"),
        ("multisine:1Hz,0.1g,duration=5s", InputError, "duration=9s or more"),
        ("triangle:1Hz,10cm/s,turn=1s", InputError, "no constant speed"),
    ],
)
def test_what_cannot_be_made_is_refused_with_what_to_write(text, error, words):
    with pytest.raises(error, match=words):
        load_motion(text)


def test_a_synthetic_motion_stands_alone():
    for call in (
        lambda: load_motion(["sine:2Hz,0.3g", "quake:seed=1"]),
        lambda: load_motion(["sine:2Hz,0.3g", "file.AT2"]),
        lambda: load_motion("sine:2Hz,0.3g", dt=0.01),
        lambda: load_motion("sine:2Hz,0.3g", z="none"),
    ):
        with pytest.raises(SlipwiseError, match=r"by itself|says everything itself"):
            call()


def test_a_file_whose_name_looks_synthetic_is_a_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sine:copy").write_text("t [s],a [g]\n0,0\n1,1\n2,0\n")
    assert len(load_motion("sine:copy")) == 3


def test_a_motion_tells_what_it_is_as_json_can_hold_it():
    import json

    about = parse_motion("quake:seed=5").about()
    assert json.loads(json.dumps(about))["title"] == "quake:seed=5"
    assert about["samples"] == len(parse_motion("quake:seed=5"))
