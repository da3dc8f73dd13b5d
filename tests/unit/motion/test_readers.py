"""Every reader on small files of our own: values, units, step, names and stated peaks."""

import numpy as np
import pytest

from slipwise.errors import InputError, SlipwiseError
from slipwise.motion import load_motion
from slipwise.motion.detect import detect
from slipwise.motion.source_file import source_of
from slipwise.motion.stated import Given, acceleration_factor
from slipwise.record import Record, write_record
from unit.motion import samples
from unit.motion.samples import wave

G = 9.80665


def read(data: bytes, name: str = "file.txt", **given):
    source = source_of(name, name.rpartition(".")[0], data)
    return detect(source).read(source, Given(**given))


FORMAT_OF = {"CSMIP new": "CSMIP/CESMD V2", "CSMIP old": "CSMIP/CESMD V2", "columns": "text columns"}


@pytest.mark.parametrize("kind", samples.every_format())
def test_a_format_is_found_from_its_content_whatever_the_file_is_called(kind):
    source = source_of("earthquake", "earthquake", samples.every_format()[kind])
    expected = FORMAT_OF.get(kind, kind).removesuffix(", CR CR LF").removesuffix(" with a byte-order mark")
    expected = {
        "K-NET": "K-NET and KiK-net ASCII",
        "KiK-net": "K-NET and KiK-net ASCII",
        "columns": "text columns",
    }.get(expected, expected)
    assert detect(source).name == expected


def test_knet_counts_become_accelerations_by_the_scale_factor():
    counts = samples.counts()
    (trace,) = read(samples.knet(counts, direction="U-D"))
    assert trace.name == "UD"
    assert trace.dt == pytest.approx(0.1)
    np.testing.assert_allclose(trace.acceleration, counts * 2000 / 8388608 * 0.01, rtol=1e-12)
    assert trace.baseline == "mean"
    about_mean = trace.acceleration - trace.acceleration.mean()
    assert trace.header_peak.value == pytest.approx(np.abs(about_mean).max(), abs=0.5e-5)


@pytest.mark.parametrize(
    ("number", "name"), [("1", "NS"), ("2", "EW"), ("3", "UD"), ("4", "NS"), ("5", "EW"), ("6", "UD")]
)
def test_kiknet_directions_are_numbers_in_the_borehole_and_at_the_surface(number, name):
    assert read(samples.knet(samples.counts(), direction=number))[0].name == name


def test_jma_columns_are_named_by_the_header_and_the_site_name_is_shift_jis():
    values = np.stack([samples.wave(phase=p) for p in (0.1, 1.0, 2.0)], axis=1)
    traces = read(samples.jma(values, order="UD,NS,EW"))
    assert [trace.name for trace in traces] == ["UD", "NS", "EW"]
    for column, trace in enumerate(traces):
        np.testing.assert_allclose(trace.acceleration, np.round(values[:, column], 3) * 0.01, atol=1e-12)
    assert "試験町" in traces[0].title


@pytest.mark.parametrize("after", [" SEC", " SEC,", "SEC", ""])
@pytest.mark.parametrize(("end", "per_line"), [("\n", 8), ("\r\n", 5), ("\r\r\n", 5), ("\r", 5)])
def test_at2_dialects_read_the_same(after, end, per_line):
    values = samples.wave() / 1000
    (trace,) = read(samples.at2(values, after=after, end=end, per_line=per_line))
    np.testing.assert_allclose(trace.acceleration, values * G, rtol=1e-6)
    assert (trace.dt, trace.name, trace.title) == (0.01, "EW", "Test Shock, 1/2/2001, Test Town")


def test_at2_of_the_older_kind_writes_the_numbers_before_their_names():
    data = samples.at2(samples.wave() / 1000).replace(b"NPTS=     40, DT= .0100 SEC", b"   40   0.0050   NPTS, DT  ")
    (trace,) = read(data)
    assert trace.dt == 0.005
    assert len(trace.acceleration) == 40


@pytest.mark.parametrize(
    ("unit", "factor"), [("UNITS OF G", G), ("UNITS OF CM/S/S", 0.01), ("UNITS OF CM/S2", 0.01), ("units are (g)", G)]
)
def test_at2_values_are_in_the_unit_that_the_header_states(unit, factor):
    values = samples.wave() / 1000
    np.testing.assert_allclose(read(samples.at2(values, unit=unit))[0].acceleration, values * factor, rtol=1e-6)


@pytest.mark.parametrize("old", [False, True])
def test_csmip_channels_are_read_although_their_columns_touch(old):
    values = 3 * samples.wave(amplitude=180.0) - 300
    data = samples.csmip([("90 Deg", values), ("Up", -values), ("0 Deg", values / 2)], old=old)
    traces = read(data)
    assert [trace.name.upper() for trace in traces] == ["90 DEG", "UP", "0 DEG"]
    decimals = 3 if old else 5
    np.testing.assert_allclose(traces[1].acceleration, -np.round(values, decimals) * 0.01, atol=1e-10)
    assert traces[0].header_peak.time == pytest.approx(np.abs(values).argmax() * 0.01)


def test_csmip_columns_without_a_blank_between_them_are_cut_by_width():
    values = np.full(40, -123.45678)
    data = samples.csmip([("90 Deg", values)])
    assert b"-123.45678-123.45678" in data
    np.testing.assert_allclose(read(data)[0].acceleration, -1.2345678, rtol=1e-12)


def test_geonet_columns_touch_and_its_times_count_from_after_the_prepended_samples():
    values = np.concatenate([samples.wave(amplitude=9000.0), [-11024.7, -18021.9, -12000.1, 5.0]])
    data = samples.geonet([("N28W", values), ("S62W", values / 2), ("Up", values / 3)], prepended=5)
    assert b"-11024.7-18021.9-12000.1" in data
    traces = read(data)
    assert [trace.name for trace in traces] == ["N28W", "S62W", "Up"]
    np.testing.assert_allclose(traces[0].acceleration, np.round(values, 1) * 1e-3, atol=1e-12)
    # The header states the time after the five prepended samples, we state it after the first sample of the file.
    assert traces[0].header_peak.time == pytest.approx(np.abs(values).argmax() * 0.02)


def test_smc_values_touch_and_its_header_gives_both_extremes():
    values = -np.abs(samples.wave(amplitude=80.0)) - 1.0
    data = samples.smc(values)
    assert b"E+1-" in data
    (trace,) = read(data)
    assert trace.name == "360"
    assert trace.dt == 0.005
    np.testing.assert_allclose(trace.acceleration, values * 0.01, rtol=1e-4)
    assert trace.header_peak.value == pytest.approx(values.min() * 0.01, rel=1e-6)
    assert trace.header_peak.time == pytest.approx(values.argmin() * 0.005)


@pytest.mark.parametrize("kind", ["3 VELOCITY", "4 DISPLACEMENT", "1 UNCORRECTED ACCELEROGRAM"])
def test_smc_files_of_anything_but_corrected_acceleration_are_refused(kind):
    with pytest.raises(SlipwiseError, match="CORRECTED ACCELEROGRAM"):
        read(samples.smc(samples.wave(), kind=kind))


def test_our_own_csv_gives_the_table_channels_of_a_run_and_leaves_the_others():
    values = np.stack([samples.wave(phase=p) / 100 for p in (0.1, 1.0, 2.0)], axis=1)
    traces = read(samples.own_csv(values, names=("table_ax", "girder_ax", "table_az")))
    assert [trace.name for trace in traces] == ["table_ax", "table_az"]
    np.testing.assert_allclose(traces[1].acceleration, values[:, 2], rtol=1e-6)
    assert traces[0].dt == pytest.approx(0.002)


def test_a_record_that_slipwise_wrote_is_a_table_motion_again(tmp_path):
    time = np.arange(200) * 0.0005
    channels = {
        name: samples.wave(200, 3.0, phase) for name, phase in (("table_ax", 0.1), ("slip_x", 1.0), ("table_az", 2.0))
    }
    write_record(Record(time, channels), tmp_path / "record.csv")
    motion = load_motion([tmp_path / "record.csv"])
    assert motion.components == ("table_ax", "", "table_az")
    assert motion.dt == pytest.approx(0.0005, rel=1e-9)
    np.testing.assert_allclose(motion.acceleration[:, 2], channels["table_az"], rtol=1e-8)


def test_a_misspelt_channel_of_the_table_is_not_left_out_silently():
    values = np.stack([samples.wave() / 100, samples.wave() / 100], axis=1)
    with pytest.raises(InputError, match="'table_axx'; did you mean table_ax"):
        read(samples.own_csv(values, names=("table_axx", "table_az")))


@pytest.mark.parametrize(
    "head",
    [
        "# Time (s),Acceleration (g's)\n",
        "A title,\nTime[s] Accel[g]\n",
        "time [ms];acc [g]\n",
        "\n# one\n# Time (s)\tAcceleration (g)\n\n",
    ],
)
def test_columns_that_state_their_units_need_nothing_from_the_user(head):
    values = samples.wave() / 1000
    dt = 10.0 if "[ms]" in head else 0.01
    (trace,) = read(samples.columns(values, dt=dt, head=head))
    assert trace.dt == pytest.approx(0.01)
    np.testing.assert_allclose(trace.acceleration, values * G, rtol=1e-5)


def test_columns_without_a_header_take_step_and_unit_from_the_user():
    values = samples.wave() / 1000
    (one,) = read(samples.one_column(values), "TCU-E.txt", dt=0.005, unit="g")
    np.testing.assert_allclose(one.acceleration, values * G, atol=1e-9)
    assert (one.dt, one.name) == (0.005, "E")
    (two,) = read(samples.columns(values, head=""), dt=0.01, unit="cm/s^2")
    np.testing.assert_allclose(two.acceleration, values * 0.01, rtol=1e-5)


def test_a_headless_column_of_milliseconds_is_understood_from_the_step_that_is_given():
    (trace,) = read(samples.columns(samples.wave() / 1000, dt=10.0, head=""), dt=0.01, unit="g")
    assert trace.dt == pytest.approx(0.01)


def test_columns_named_with_units_may_hold_several_components_with_or_without_time():
    values = np.stack([samples.wave(phase=p) for p in (0.1, 1.0)], axis=1)
    body = "".join(f"{a:.5f},{b:.5f}\n" for a, b in values)
    traces = read(("EW [gal],UD [cm/s^2]\n" + body).encode(), dt=0.01)
    assert [(trace.name, trace.dt) for trace in traces] == [("EW", 0.01), ("UD", 0.01)]
    np.testing.assert_allclose(traces[1].acceleration, values[:, 1] * 0.01, atol=1e-7)


def test_times_rounded_to_their_last_digit_are_still_even():
    rows = "".join(f"{i / 60:.3f} {value:.5f}\n" for i, value in enumerate(samples.wave()))
    (trace,) = read(("t[s] a[gal]\n" + rows).encode())
    assert trace.dt == pytest.approx(1 / 60, rel=1e-3)


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        ("g", G), ("G", G), ("g's", G), ("gal", 0.01), ("GAL", 0.01), ("gal(cm/s/s)", 0.01), ("CM/SEC/SEC", 0.01),
        ("cm/sec2", 0.01), ("cm/s2", 0.01), ("mm/s/s", 0.001), ("m/s2", 1.0), ("M/S/S", 1.0), ("m/s**2", 1.0),
        ("in/s^2", 0.0254),
    ],
)  # fmt: skip
def test_agencies_spellings_of_a_unit_mean_what_they_mean(unit, factor):
    assert acceleration_factor(unit, "test") == pytest.approx(factor, rel=1e-12)


def test_every_trace_says_in_words_how_it_was_read():
    for kind, data in samples.every_format().items():
        for trace in read(data):
            words = " ".join(trace.treatment)
            assert "read as" in words and "unit" in words and "step" in words, kind


@pytest.fixture
def load(tmp_path):
    def write_and_load(data: bytes, name: str, **settings):
        (tmp_path / name).write_bytes(data)
        return load_motion([tmp_path / name], **settings)

    return write_and_load


AT2 = "{title}\nINVENTED EQ 01/02/33 0405, NOWHERE, 090\n{unit}\n{line}\n"


@pytest.mark.parametrize(
    "line",
    [
        "NPTS=   40, DT=   .0100 SEC", "NPTS=   40, DT=   .0100 SEC,", "NPTS=40,DT=.01", "NPTS= 40, DT= .01 sec",
        "NPTS: 40, DT: 0.01", "DT= .0100 SEC, NPTS= 40", "NPTS= 40\nDT= .0100 SEC", "DT= .0100 SEC\nNPTS= 40",
        "  40   0.0100   NPTS, DT", "  40   .0100  NPTS, DT (SEC)", "npts = 40, dt = 0.01 s", "NPTS= 40, DT= 10 ms",
        "NPTS=    40, DT= .01000 SEC   ", "NPTS = 40 , DT = 1.0E-2 SEC", "NPTS 40 DT 0.01",
    ],
)  # fmt: skip
@pytest.mark.parametrize("body", ["five", "eight", "touching", "one", "commas"])
def test_at2_headers_and_bodies_in_all_their_kinds(load, line, body):
    values = wave() / 1000
    each = {"five": 5, "eight": 8, "touching": 5, "one": 1, "commas": 4}[body]
    width = "{:15.7E}" if body != "touching" else "{:+.7E}"
    joint = "," if body == "commas" else ""
    rows = [joint.join(width.format(v) for v in values[i : i + each]) for i in range(0, 40, each)]
    head = AT2.format(title="PEER STRONG MOTION DATABASE RECORD", unit="ACCELERATION IN UNITS OF G", line=line)
    motion = load((head + "\n".join(rows) + "\n").encode(), name="record.AT2")
    assert (motion.dt, motion.components[0]) == (pytest.approx(0.01), "090")
    np.testing.assert_allclose(motion.acceleration[:, 0], values * 9.80665, rtol=1e-6)


@pytest.mark.parametrize(
    ("line", "rows", "words"),
    [
        ("NPTS= 41, DT= .01 SEC", 40, "promises 41 values, 40 are there; .* --allow-short"),
        ("NPTS= 20, DT= .01 SEC", 40, "promises 20 values, but 40 are there"),
        ("NPTS= 40, DT= .01 SEC, DT= .02 SEC", 40, "contradicts itself"),
        ("NPTS= 40", 40, "the number of points and the step cannot be read"),
        ("NPTS= many, DT= .01 SEC", 40, "the number of points and the step cannot be read"),
        ("NPTS= 40, DT= .01 SEC, UNITS= CM/S/S", 40, "contradicts itself"),
    ],
)
def test_damaged_at2_headers_are_refused_in_one_sentence(load, line, rows, words):
    head = AT2.format(title="PEER", unit="ACCELERATION IN UNITS OF G", line=line)
    body = "\n".join(f"{v:15.7E}" for v in wave()[:rows] / 1000)
    with pytest.raises(SlipwiseError, match=words):
        load((head + body + "\n").encode(), name="record.AT2")
