"""What a free header states binds; bare first lines, wrapped values, columns with half a header, encodings, commas."""

import warnings

import numpy as np
import pytest

from slipwise.errors import InputError, SlipwiseWarning, UnitError
from slipwise.motion import load_motion, warn_of_travel
from unit.motion import samples
from unit.motion.agency_samples import esm

GAL = samples.wave()
G = 9.80665


@pytest.fixture
def load(tmp_path):
    """Write text to a file and load it as a motion; nothing may be warned of."""

    def write_and_load(text: str | bytes, name: str = "motion.dat", **settings):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        with warnings.catch_warnings():
            warnings.simplefilter("error", SlipwiseWarning)
            return load_motion(path, **settings)

    return write_and_load


def column(values: np.ndarray = GAL) -> str:
    return "".join(f"{value:.5f}\n" for value in values)


@pytest.mark.parametrize(
    "head",
    [
        "Time Step: 0.01 s\nUnits: gal\n",
        "dt = 0.01, units = cm/s2, npts = 40\n",
        "# Sampling rate: 100 Hz\n# Unit = cm/sec/sec\n",
        "Sample rate\t100 Hz\nUnit\tgal\n",
        "SAMPLING_INTERVAL_S: 0.010\nUNITS: cm/s^2\nNDATA: 40\n",
        "Sampling Interval (ms): 10\nAcceleration unit: GAL\nNo. of points: 40\n",
        "SampleRate(Hz): 100\nAmplitudeUnit: gal.\n",
        "DT=.0100 SEC\nUNITS=CM/S/S\nPGA (gal): 113.196\n",
    ],
)
def test_step_and_unit_of_any_free_header_are_taken_and_bind(load, head):
    motion = load(head + column())
    assert motion.dt == pytest.approx(0.01)
    np.testing.assert_allclose(motion.acceleration[:, 0], GAL / 100, atol=1e-7)
    assert len(load(head + column(), dt="10 ms", unit="gal")) == 40
    with pytest.raises(InputError, match=r"states a step of 0\.01 s, 0\.02 s was given"):
        load(head + column(), dt="0.02 s")
    with pytest.raises(UnitError, match="as its unit, 'g' was given"):
        load(head + column(), unit="g")


def test_component_peak_and_its_time_are_taken_and_checked(load):
    data = esm(GAL, stream="HNZ", dt=0.01)
    with pytest.warns(SlipwiseWarning, match="no horizontal component"):
        path = load.__closure__[0].cell_contents / "z.asc"
        path.write_bytes(data)
        motion = load_motion(path)
    assert motion.components == ("", "", "HNZ")
    assert motion.header_peaks[2].value == pytest.approx(GAL[np.abs(GAL).argmax()] / 100, abs=1e-8)
    with pytest.raises(InputError, match="states a peak of"):
        load(data.replace(b"PGA_CM/S^2: 1", b"PGA_CM/S^2: 2"))
    with pytest.raises(InputError, match="the header promises 41 values, 40 are there"):
        load(data.replace(b"NDATA: 40", b"NDATA: 41"))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("dt: 0.01 s\nSampling rate: 200 Hz\nunit: g\n" + column(), "contradicts itself: .*0.01.*200 Hz"),
        ("unit: g\nunits: gal\ndt: 0.01 s\n" + column(), "contradicts itself"),
        ("unit: g\nTime [s],EW [gal]\n0,1\n0.01,2\n0.02,1\n", "the header states 'g', the column 'gal'"),
        ("dt: 0.02 s\nTime [s],EW [gal]\n0,1\n0.01,2\n0.02,1\n", r"states a step of 0\.02 s, its time column 0\.01 s"),
    ],
)
def test_two_statements_of_one_file_that_contradict_each_other_are_refused_naming_both(load, text, words):
    with pytest.raises((InputError, UnitError), match=words):
        load(text)


@pytest.mark.parametrize("first", ["40\n", "40 0.01\n", "0.01 40\n", "40\n0.01\n", "A title\n   40    0.0100\n"])
@pytest.mark.parametrize("per_line", [1, 5, 7])
def test_a_first_line_of_count_or_step_is_no_sample(load, first, per_line):
    numbers = column().split("\n")[:-1]
    body = "\n".join("  ".join(numbers[i : i + per_line]) for i in range(0, 40, per_line))
    motion = load(first + body, unit="gal", dt="0.01 s")
    np.testing.assert_allclose(motion.acceleration[:, 0], GAL / 100, atol=1e-7)
    if "0.01" in first:
        assert load(first + body, unit="gal").dt == 0.01
        with pytest.raises(InputError, match="was given"):
            load(first + body, unit="gal", dt="0.02 s")


def test_a_first_number_that_is_out_of_line_with_the_others_is_refused_and_the_advice_is_right(load):
    with pytest.raises(InputError, match="line 1: the first number, 4000, .*the number of values"):
        load("4000\n" + column(), unit="gal", dt="0.01 s")
    small = column(GAL / 1e6)
    with pytest.raises(InputError, match=r"looks like the step: give --motion-dt '0\.02 s'"):
        load("0.02\n" + small, unit="g")
    motion = load("0.02\n" + small, unit="g", dt="0.02 s")
    assert (len(motion), motion.dt) == (40, 0.02)


def test_a_first_sample_that_happens_to_equal_the_step_is_a_sample(load):
    assert len(load("0.01\n0.02\n0.03\n0.02\n0.01\n", unit="g", dt="0.01 s")) == 5


@pytest.mark.parametrize("per_line", [5, 8, 10])
@pytest.mark.parametrize("count", [40, 38])
def test_values_that_are_wrapped_are_read_in_the_order_of_reading(load, per_line, count):
    values = np.repeat(GAL, 5)[: 4 * count + count % 5] + 0.01 * np.arange(4 * count + count % 5)
    lines = [values[i : i + per_line] for i in range(0, len(values), per_line)]
    text = "\n".join("".join(f"{v:12.5f}" for v in line) for line in lines)
    motion = load(text, name="NOW_360.g3", unit="gal", dt="0.02 s")
    np.testing.assert_allclose(motion.acceleration[:, 0], values / 100, atol=1e-7)
    assert motion.components[0] == "360"
    assert f"{per_line} values a line" in " ".join(motion.treatment)


def test_components_side_by_side_without_names_are_no_wrapped_series(load):
    three = np.stack([samples.wave(200, phase=p) for p in (0.1, 2.0, 4.0)], axis=1) @ np.diag([1.0, -0.5, 0.2])
    smooth = np.repeat(three, 4, axis=0)
    with pytest.raises(InputError, match="3 columns without a header that names them"):
        load("\n".join(" ".join(f"{v:.4f}" for v in row) for row in smooth), unit="gal", dt="0.01 s")


def test_a_named_table_whose_only_time_lacks_its_unit_is_read_in_seconds_and_it_is_said(load):
    rows = "".join(f"{i * 0.01:.2f},{v:.4f},{v / 2:.4f},{v / 5:.4f}\n" for i, v in enumerate(GAL))
    motion = load("time,acc_NS(gal),acc_EW(gal),acc_UD(gal)\n" + rows)
    assert motion.components == ("acc_EW", "acc_NS", "acc_UD")
    assert motion.dt == pytest.approx(0.01)
    assert "column 'time' has no unit: taken in seconds" in " ".join(motion.treatment)


def test_velocity_and_displacement_beside_acceleration_are_left_and_said(load):
    rows = "".join(f"{i * 0.01:.2f}\t{v:.5f}\t{v / 9:.5f}\t{v / 99:.5f}\n" for i, v in enumerate(GAL))
    motion = load("Time [sec]\tAcceleration [gal]\tVelocity [cm/sec]\tDisplacement [cm]\n" + rows)
    np.testing.assert_allclose(motion.acceleration[:, 0], GAL / 100, atol=1e-7)
    assert "left out: Velocity (velocity), Displacement (displacement)" in " ".join(motion.treatment)
    with pytest.raises(UnitError, match="no column holds an acceleration, there are Velocity"):
        load("Time [sec]\tVelocity [cm/sec]\n" + "".join(f"{i * 0.01}\t{v:.5f}\n" for i, v in enumerate(GAL)))


def test_units_in_a_row_of_their_own_are_understood(load):
    rows = "".join(f"{i * 0.01:.2f}\t{v:.5f}\t{v / 9:.5f}\n" for i, v in enumerate(GAL))
    motion = load("Time\tEW\tNS\ns\tgal\tcm/s^2\n" + rows)
    assert motion.components == ("EW", "NS", "")


TEXT = "Zeit [s]\tBeschleunigung längs [m/s²]\n" + "".join(
    f"{i * 0.01:.2f}\t{v / 100:.5f}\n" for i, v in enumerate(GAL)
)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "utf-16", "utf-16-le", "utf-16-be"])
@pytest.mark.parametrize("minus", ["-", "\u2212"])
@pytest.mark.parametrize("decimal", [".", ","])
def test_encodings_minus_signs_and_decimal_commas_of_laboratories(load, encoding, minus, decimal):
    head, _, body = TEXT.partition("\n")
    text = head + "\n" + body.replace("-", minus if encoding != "cp1252" else "-").replace(".", decimal)
    motion = load(text.encode(encoding))
    np.testing.assert_allclose(motion.acceleration[:, 0], GAL / 100, atol=1e-5)
    assert motion.dt == pytest.approx(0.01)


def test_a_single_column_with_decimal_commas(load):
    motion = load(column().replace(".", ","), unit="gal", dt="0.01 s")
    np.testing.assert_allclose(motion.acceleration[:, 0], GAL / 100, atol=1e-7)


@pytest.mark.parametrize("padding", [b"\x00" * 300, b"\x00" * 50 + b"\r\n", b"\x1a" * 9 + b"\x00" * 9])
def test_nul_bytes_that_pad_the_end_are_left_out_and_within_a_file_refused(load, padding):
    data = samples.knet(samples.counts())
    np.testing.assert_array_equal(load(data + padding).acceleration, load(data).acceleration)
    with pytest.raises(InputError, match="NUL bytes stand within it"):
        load(data[:400] + b"\x00\x00" + data[400:])


def test_a_mark_below_the_values_is_no_value(load):
    np.testing.assert_allclose(
        load(column() + "END\n*\n", unit="gal", dt=0.01).acceleration[:, 0], GAL / 100, atol=1e-7
    )
    at2 = samples.at2(GAL / 1000) + b"/END OF DATA\r\n"
    assert len(load(at2)) == 40


@pytest.mark.parametrize(
    "line",
    [
        b"DT= .0100 SEC, NPTS= 40", b"NPTS= 40, DT= .0100 SEC, UNITS=G", b"NPTS=40,DT=0.01SEC", b"NPTS: 40 DT: .01",
        b"   40   .0100   NPTS, DT", b"NPTS= 40, DT= 1.00E-02 SEC", b"NPTS= 40, DT= 1.00D-02 SEC",
    ],
)  # fmt: skip
@pytest.mark.parametrize("exponent", [b"E", b"D"])
def test_at2_in_all_its_layouts(load, line, exponent):
    data = samples.at2(GAL / 1000).split(b"\r\n")
    data[3] = line
    if b"UNITS=G" in line:
        data[2] = b"ACCELERATION TIME HISTORY"
    body = b"\r\n".join(data[4:]).replace(b"E-", exponent + b"-").replace(b"E+", exponent + b"+")
    motion = load(b"\r\n".join(data[:4]) + b"\r\n" + body)
    assert (len(motion), motion.dt, motion.components[0]) == (40, 0.01, "EW")
    np.testing.assert_allclose(motion.acceleration[:, 0], GAL / 1000 * G, rtol=1e-6)


def test_gravity_in_a_component_is_refused_and_the_advice_leads_to_the_right_answer(load):
    rows = np.stack([GAL / 100, GAL / 500 + G], axis=1)
    data = samples.own_csv(rows, names=("table_ax", "table_az"))
    with pytest.raises(
        InputError, match=r"mean of table_az .* is 9\.8.* m/s\^2, \+1 g: gravity is in it; --baseline mean"
    ):
        load(data)
    np.testing.assert_allclose(load(data, baseline="mean").acceleration[:, 2], GAL / 500 - GAL.mean() / 500, atol=1e-6)
    with pytest.raises(SlipwiseWarning, match="gravity is in it, and the table is shaken with it"):
        load(data, baseline="none")
    with pytest.raises(InputError, match=r"-0\.999 g: gravity is in it"):
        load(samples.own_csv(np.stack([GAL / 100, GAL / 500 - G], axis=1), names=("table_ax", "table_az")))


def test_a_peak_beyond_5_g_and_a_travel_beyond_2_m_are_warned_of(load):
    with pytest.raises(SlipwiseWarning, match=r"reaches 11\.3 g in x; is the unit right"):
        load(samples.one_column(GAL / 10), dt=0.01, unit="g")
    motion = load(samples.one_column(GAL / 100 + 0.2), dt=0.5, unit="m/s^2")
    with pytest.warns(SlipwiseWarning, match=r"travels .* m in x: an offset or a drift.*--baseline linear.*--stroke"):
        warn_of_travel(motion)
    with warnings.catch_warnings():
        warnings.simplefilter("error", SlipwiseWarning)
        warn_of_travel(load(samples.one_column(GAL / 100), dt=0.01, unit="m/s^2"))


@pytest.mark.parametrize(
    "head",
    [
        "Nombre de points: 40, dt=0.01, accélérations en cm/s/s\n",
        "Equally spaced at 0.01 s, 40 values, cm/sec**2\n",
        "dt: 0.01 s\nHorizontal component of the motion, values in cm/s2\n",
        "dt: 0.01 s, units: gal\nLoma Prieta 1989 Gilroy array #3 acceleration cm/s2\n",
    ],
)
def test_a_sentence_with_as_many_words_as_there_are_values_a_line_names_no_columns(load, head):
    values = 100.0 * np.sin(0.3 * np.arange(40))
    numbers = column(values).split("\n")[:-1]
    assert len(head.splitlines()[-1].split()) == 8
    motion = load(head + "".join("  ".join(numbers[i : i + 8]) + "\n" for i in range(0, 40, 8)))
    assert motion.dt == 0.01
    np.testing.assert_allclose(motion.acceleration[:, 0], values / 100, atol=1e-7)
