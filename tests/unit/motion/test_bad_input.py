"""Bad input gives one clear error: the file, the line where it makes sense, and what to do."""

import numpy as np
import pytest

from slipwise.errors import InputError, SlipwiseError, SlipwiseWarning, UnitError
from slipwise.motion import TableMotion, load_motion
from unit.motion import samples

WAVE = samples.wave() / 1000


@pytest.fixture
def load(tmp_path):
    """Write bytes to a file and load them as a motion."""

    def write_and_load(data: bytes, name: str = "motion.dat", **settings):
        path = tmp_path / name
        path.write_bytes(data)
        return load_motion(path, **settings)

    return write_and_load


def test_a_missing_file_a_folder_and_nothing_at_all(tmp_path):
    with pytest.raises(InputError, match=r"nothing\.AT2: no such file"):
        load_motion(tmp_path / "nothing.AT2")
    with pytest.raises(InputError, match="folder"):
        load_motion(tmp_path)
    with pytest.raises(InputError, match="no motion is given"):
        load_motion([])


@pytest.mark.parametrize("data", [b"", b"\xef\xbb\xbf", b" \r\n\n\x1a"])
def test_an_empty_file(load, data):
    with pytest.raises(InputError, match=r"motion\.dat: the file is empty"):
        load(data)


@pytest.mark.parametrize("data", [b"PAR1\x00\x00", b"just words\nand more words\n", b"# x\n", "試験".encode("cp932")])
def test_a_file_of_another_format(load, data):
    with pytest.raises(InputError, match=r"format is not known|no text file"):
        load(data)


@pytest.mark.parametrize(
    "kind", [kind for kind in samples.every_format() if not kind.startswith(("col", "Slip", "JMA"))]
)
@pytest.mark.parametrize("share", [0.3, 0.6, 0.9, 0.985])
def test_a_truncated_record_is_refused_wherever_it_ends(load, kind, share):
    data = samples.every_format()[kind].rstrip(b"\x1a")
    with pytest.raises(InputError):
        load(data[: int(share * len(data))])


def test_fewer_values_than_the_header_promises_are_counted_in_the_message(load):
    with pytest.raises(InputError, match=r"truncated: NPTS= 50 promises 50 values, 40 are there"):
        load(samples.at2(WAVE, count=50))
    with pytest.raises(InputError, match=r"promises 30 values, but 40 are there"):
        load(samples.at2(WAVE, count=30))
    knet = samples.knet(samples.counts()).replace(b"Duration Time(s)  4", b"Duration Time(s)  5")
    with pytest.raises(InputError, match="promises 50 values, 40 are there"):
        load(knet)


def test_a_csmip_file_with_fewer_channels_than_the_recorder_is_read_with_a_warning(load):
    values = samples.wave()
    data = samples.csmip([("90 Deg", values), ("Up", values), ("0 Deg", values)])
    whole_channels = data[: data.index(b"End of data for channel  2") + 45]
    with pytest.warns(SlipwiseWarning, match="the recorder has 3 channels, 2 are in this file"):
        assert load(whole_channels + b"\r\n").components == ("90 Deg", "", "Up")


@pytest.mark.parametrize("bad", ["nan", "NaN", "inf", "-Infinity", "1e99", "1_0", "0x1", "--3", "1.2.3"])
def test_what_is_no_finite_number_is_refused_with_its_line(load, bad):
    rows = [f"{i * 0.01:.2f} {value:.5f}" for i, value in enumerate(WAVE)]
    rows[7] = f"0.07 {bad}"
    with pytest.raises(InputError, match=r"motion\.dat, line 8"):
        load("\n".join(rows).encode(), dt=0.01, unit="g")
    values = samples.at2(WAVE).decode().split("\r\n")
    values[6] = values[6][:15] + f"{bad:>15}" + values[6][30:]
    with pytest.raises(InputError, match=r"motion\.dat, line 7"):
        load("\r\n".join(values).encode())


def test_nan_in_the_first_row_of_columns_does_not_pass_for_a_header(load):
    rows = "".join(f"{i * 0.01:.2f},{value:.5f}\n" for i, value in enumerate(WAVE))
    with pytest.raises(InputError, match="line 1"):
        load(("0.00,nan" + rows[rows.index("\n") :]).encode(), dt=0.01, unit="g")
    with pytest.raises(InputError, match="line 1"):
        load(("0.00,0.0l2" + rows[rows.index("\n") :]).encode(), dt=0.01, unit="g")


@pytest.mark.parametrize(
    ("times", "words"),
    [
        ([0, 1, 2, 3, 2.5, 5], r"line 6: the time runs backwards"),
        ([0, 1, 2, 2, 3, 4], r"line 5: the time repeats"),
        ([0, 1, 2, 4, 5, 6], r"line 5: the samples are not evenly spaced"),
        ([0, 1, 2, 3, 4, 5.3], r"not evenly spaced"),
    ],
)
def test_times_that_run_backwards_repeat_or_leave_gaps(load, times, words):
    rows = "".join(f"{t * 0.01:.3f},{0.1 * t:.4f}\n" for t in times)
    with pytest.raises(InputError, match=words):
        load(("time [s],table_ax [m/s^2]\n" + rows).encode())
    with pytest.raises(InputError, match=words):
        load(("t (s), a (g)\n" + rows).encode())


def test_a_step_or_unit_that_nobody_states_is_asked_for(load):
    column, two = samples.one_column(WAVE), samples.columns(WAVE, head="")
    for data in (column, two):
        with pytest.raises(InputError, match="does not state its time step; give it, for example --motion-dt"):
            load(data, unit="g")
        with pytest.raises(UnitError, match="does not state the unit of its acceleration; give it"):
            load(data, dt=0.01)


def test_a_step_that_the_time_column_contradicts_is_refused(load):
    with pytest.raises(InputError, match=r"advances by 0\.01 a row, 0\.02 s was given"):
        load(samples.columns(WAVE, head=""), dt=0.02, unit="g")


@pytest.mark.parametrize("dt", [0.0, -0.01, float("nan"), float("inf"), 1e-9, 100.0])
def test_an_impossible_step_is_refused(load, dt):
    with pytest.raises(InputError, match=r"step"):
        load(samples.one_column(WAVE), dt=dt, unit="g")


@pytest.mark.parametrize(
    ("unit", "words"),
    [("m/s", "wrong dimension"), ("cm", "wrong dimension"), ("kN", "wrong dimension"), ("gg", "not known")],
)
def test_a_unit_of_the_wrong_dimension_or_an_unknown_one_is_refused(load, unit, words):
    with pytest.raises(UnitError, match=words):
        load(samples.one_column(WAVE), dt=0.01, unit=unit)
    with pytest.raises(UnitError, match=words):
        load(samples.at2(WAVE, unit=f"UNITS OF {unit}"))


def test_velocity_and_displacement_files_are_no_table_motion(load):
    for unit in ("UNITS OF CM/S", "UNITS OF CM"):
        with pytest.raises(UnitError, match="the header of motion.dat: the unit '(cm/s|CM)'"):
            load(samples.at2(WAVE, unit=unit).replace(b"ACCELERATION", b"VELOCITY"))


def test_a_step_or_unit_against_the_files_own_is_refused_and_the_same_is_welcome(load):
    with pytest.raises(UnitError, match="states 'G' as its unit, 'gal' was given"):
        load(samples.at2(WAVE), unit="gal")
    with pytest.raises(InputError, match=r"states a step of 0\.01 s, 0\.02 s was given"):
        load(samples.at2(WAVE), dt=0.02)
    assert len(load(samples.at2(WAVE), dt="10 ms", unit="g")) == 40
    with pytest.raises(UnitError, match="has no unit"):
        load(samples.at2(WAVE), dt="0.01")


def test_an_at2_file_without_a_unit_takes_the_users_and_nothing_else(load):
    data = samples.at2(WAVE, unit="WHATEVER")
    with pytest.raises(UnitError, match="does not state the unit"):
        load(data)
    assert load(data, unit="cm/s^2").peaks[0] == pytest.approx(np.abs(WAVE).max() * 0.01, rel=1e-6)


def test_a_scale_that_contradicts_the_stated_peak_is_refused(load):
    data = samples.knet(samples.counts())
    with pytest.raises(InputError, match="states a peak"):
        load(data.replace(b"2000(gal)", b"200(gal)"))
    with pytest.raises(SlipwiseError):
        load(data.replace(b"2000(gal)", b"2000(cm)"))
    with pytest.warns(SlipwiseWarning, match="states a peak"):
        load(data.replace(b"2000(gal)", b"2040(gal)"))


@pytest.mark.filterwarnings("ignore:.*of (Up|0 Deg) at")
def test_a_step_that_contradicts_the_time_of_the_stated_peak_is_warned_of(load):
    data = samples.csmip([("90 Deg", samples.wave()), ("Up", samples.wave(phase=1.0)), ("0 Deg", samples.wave())])
    with pytest.warns(SlipwiseWarning, match=r"states the peak of 90 Deg at 0\.02 s, the data reach it at 0\.2 s"):
        load(data.replace(b"spaced at  0.010 sec", b"spaced at  0.100 sec"))


def test_a_shifted_line_of_touching_columns_is_refused_with_its_line(load):
    data = samples.geonet([(name, samples.wave(amplitude=9000.0)) for name in ("N28W", "S62W", "Up")])
    lines = data.decode().split("\n")
    lines[27] = lines[27][1:]
    with pytest.raises(InputError, match=r"motion\.dat, line 28: 10 columns of 8 characters were expected"):
        load("\n".join(lines).encode())


def test_values_beyond_all_reason_mean_a_wrong_unit(load):
    with pytest.raises(InputError, match="check the unit"):
        load(samples.one_column(1e5 * WAVE), dt=0.01, unit="g")


def test_a_record_of_the_girder_alone_is_no_table_motion(load):
    with pytest.raises(InputError, match="none of table_ax, table_ay, table_az"):
        load(samples.own_csv(np.stack([WAVE, WAVE], axis=1), names=("girder_ax", "girder_az")))


def test_many_columns_without_names_are_refused_with_the_header_to_write(load):
    with pytest.raises(InputError, match=r"3 columns without a header.*'time \[s\],EW"):
        load(b"0 1 2\n1 2 3\n2 3 4\n", dt=0.01, unit="g")


@pytest.mark.parametrize("dt", [0.0, -1.0, float("nan")])
def test_a_table_motion_cannot_be_made_of_nonsense(dt):
    good = np.zeros((5, 3))
    with pytest.raises(InputError, match="step must be positive"):
        TableMotion(dt, good, "t", ("a", "", ""))
    for shape in ((1, 3), (5, 2), (5,)):
        with pytest.raises(InputError, match="at least 2 samples"):
            TableMotion(0.01, np.zeros(shape), "t", ("a", "", ""))
    bad = good.copy()
    bad[3, 1] = np.inf
    with pytest.raises(InputError, match=r"not finite at 1 of 5 samples, first at 0\.03 s"):
        TableMotion(0.01, bad, "t", ("a", "", ""))


def test_a_table_motion_cannot_be_changed_behind_its_back():
    values = np.ones((5, 3))
    motion = TableMotion(0.01, values, "t", ("a", "b", "c"))
    values[0] = 7
    assert motion.acceleration[0, 0] == 1
    with pytest.raises(ValueError, match="read-only"):
        motion.acceleration[0, 0] = 7
