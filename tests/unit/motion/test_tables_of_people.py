"""Tables as people and phones write them: quotes, row numbers, ax ay az, counts, peaks that tell a unit."""

import numpy as np
import pytest

from slipwise.errors import InputError, SlipwiseWarning, UnitError
from slipwise.motion import load_motion
from unit.motion.samples import one_column, wave

GAL = wave(60)
THREE = np.stack([GAL, 0.6 * wave(60, phase=1.0), 0.3 * wave(60, phase=2.0)], axis=1) / 100
G = 9.80665


@pytest.fixture
def load(tmp_path):
    def write_and_load(text: str, name: str = "motion.csv", **settings):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return load_motion(path, **settings)

    return write_and_load


def table(head: str, columns, separator: str = ",", quoted: bool = False, decimal: str = ".") -> str:
    cells = [[f"{v:.6g}".replace(".", decimal) for v in row] for row in np.stack(columns, axis=1)]
    mark = '"' if quoted else ""
    return head + "".join(separator.join(f"{mark}{c}{mark}" for c in row) + "\n" for row in cells)


TIME = 0.01 * np.arange(60)
PHYPHOX = '"Time (s)","Linear Acceleration x (m/s^2)","Linear Acceleration y (m/s^2)","Linear Acceleration z (m/s^2)",'


@pytest.mark.parametrize(
    ("text", "names"),
    [
        (table('"Time (s)","EW (m/s^2)","NS (m/s^2)","UD (m/s^2)"\n', [TIME, *THREE.T], quoted=True), "EW NS UD"),
        (
            table("Time (s);EW (m/s^2);NS (m/s^2);UD (m/s^2)\n", [TIME, *THREE.T], ";", True, ","),
            "EW NS UD",
        ),
        (table("No,Time (s),ax (m/s^2),ay (m/s^2),az (m/s^2)\n", [np.arange(60), TIME, *THREE.T]), "ax ay az"),
        (table("time [s],ax [m/s2],ay [m/s2],az [m/s2]\n", [TIME, *THREE.T]), "ax ay az"),
        (table("t,acc_x,acc_y,acc_z\n", [TIME, *THREE.T]), "acc_x acc_y acc_z"),
        (table("time (s),z (m/s^2),y (m/s^2),x (m/s^2)\n", [TIME, *THREE.T[::-1]]), "x y z"),
        (
            table(PHYPHOX + '"Absolute acceleration (m/s^2)"\n', [TIME, *THREE.T, np.linalg.norm(THREE, axis=1)]),
            "Linear Acceleration x|Linear Acceleration y|Linear Acceleration z",
        ),
        (table("time,gFx,gFy,gFz,TgF\n", [TIME, *(THREE.T / G), np.linalg.norm(THREE, axis=1)]), "gFx gFy gFz"),
        (
            table(
                "time,seconds_elapsed,z,y,x\n",
                [1.7e18 + 1e7 * np.arange(60), TIME, *THREE.T[::-1]],
            ),
            "x y z",
        ),
        (
            table("ACCELEROMETER X (m/s²);ACCELEROMETER Y (m/s²);ACCELEROMETER Z (m/s²);Time since start (ms)\n",
                  [*THREE.T, 1e3 * TIME], ";"),
            "ACCELEROMETER X|ACCELEROMETER Y|ACCELEROMETER Z",
        ),
    ],
)  # fmt: skip
def test_three_components_of_people_and_phones_become_x_y_and_z(load, text, names):
    units = {} if "m/s" in text or "gF" in text else {"unit": "m/s^2"}
    motion = load(text, **units)
    assert motion.dt == pytest.approx(0.01, rel=1e-6)
    np.testing.assert_allclose(motion.acceleration, THREE, atol=2e-5)
    assert list(motion.components) == (names.split("|") if "|" in names else names.split())


@pytest.mark.parametrize("first", [0, 1])
def test_row_numbers_before_time_or_value_are_left_out(load, first):
    rows = first + np.arange(60.0)
    for columns in ([rows, TIME, GAL], [rows, GAL]):
        motion = load(table("", columns, " "), unit="gal", dt="0.01 s")
        np.testing.assert_allclose(motion.acceleration[:, 0], GAL / 100, atol=1e-5)
        assert "the numbers of the rows" in " ".join(motion.treatment)


def test_a_clock_that_wavers_is_evened_out_with_a_warning_and_a_gap_is_refused(load):
    jitter = 0.0008 * np.sin(7.0 * np.arange(60))
    text = table("Time (s),x (m/s^2)\n", [TIME + jitter, GAL / 100])
    with pytest.warns(SlipwiseWarning, match="the clock of motion.csv wavers"):
        motion = load(text)
    assert motion.dt == pytest.approx(0.01, rel=0.01)
    gap = np.delete(np.stack([TIME, GAL / 100]), 30, axis=1)
    with pytest.raises(InputError, match="samples are missing"):
        load(table("Time (s),x (m/s^2)\n", list(gap)))


@pytest.mark.parametrize("letter", ["d", "u", "v", "z", "e", "n"])
def test_the_last_letter_of_a_lone_file_is_no_component(load, letter):
    text = one_column(GAL / 1000).decode()
    motion = load(text, name=f"elcentro_{letter}.txt", dt="0.02 s", unit="g")
    assert motion.components == (f"elcentro_{letter}", "", "")
    np.testing.assert_allclose(motion.acceleration[:, 0], GAL / 1000 * G, atol=1e-8)


def test_the_last_letters_of_files_that_belong_together_are_components(tmp_path):
    paths = []
    for letter, values in zip("ENV", THREE.T, strict=True):
        paths.append(tmp_path / f"TCU065-{letter}.txt")
        paths[-1].write_bytes(one_column(values))
    motion = load_motion(paths, dt="0.01 s", unit="m/s^2")
    assert motion.components == ("E", "N", "V")


HEAD = "STATION ID              : 9999\nNUMBER OF DATA          : 60\nSAMPLING INTERVAL (sec) : 0.01\n"
PEAKS = [f"{np.abs(column).max():.6f}" for column in THREE.T * 100]
COLUMNS = table("       N-S          E-W          U-D\n", list(THREE.T * 100), "   ")


@pytest.mark.parametrize(
    "line",
    [
        "RAW PGA VALUES (gal)    : (N-S) {} (E-W) {} (U-D) {}\n",
        "PGA (gal): NS={}, EW={}, UD={}\n",
        "Max. Acc. (cm/s2): {} / {} / {}\n",
        "最大加速度(gal) NS {} EW {} UD {}\n",
        "En büyük ivme: {} (NS), {} (EW), {} (UD) gal\n",
    ],
)
def test_a_unit_that_follows_from_stated_peaks_is_taken_and_said_and_another_is_refused(load, line, recwarn):
    text = HEAD + line.format(*PEAKS) + COLUMNS
    motion = load(text)
    np.testing.assert_allclose(motion.peaks, np.abs(THREE).max(axis=0)[[1, 0, 2]], rtol=1e-4)
    assert "in it the data reach the peaks that the file states" in " ".join(motion.treatment)
    with pytest.raises(InputError, match=r"states a peak of .*--unit m/s\^2 contradicts it"):
        load(text, unit="m/s^2")


def test_stated_peaks_tell_the_unit_of_data_that_are_in_another(load):
    peak = f"PGA: {np.abs(GAL).max():.3f} gal\ndt = 0.01 s\n"
    motion = load(peak + one_column(GAL / 980.665).decode())
    assert motion.peaks[0] == pytest.approx(np.abs(GAL).max() / 100, rel=1e-4)
    assert "unit g: in it" in " ".join(motion.treatment)
    with pytest.raises(UnitError, match="does not state the unit"):
        load(peak + one_column(GAL / 3.0).decode())


def stream_of(starts, samples: int = 400):
    """Channels of one station with a pulse at 6 s, which begin so late [s]."""
    obspy = pytest.importorskip("obspy")
    time = np.arange(samples) * 0.02
    stream = obspy.Stream()
    for channel, late in zip(("HNE", "HNN", "HNZ"), starts, strict=True):
        values = np.exp(-((time + late - 6.0) ** 2) / 0.02)
        start = obspy.UTCDateTime(2001, 1, 1) + late
        header = {"delta": 0.02, "channel": channel, "station": "TEST", "network": "XX", "starttime": start}
        stream.append(obspy.Trace(values, header))
    return stream


@pytest.mark.parametrize(
    "starts", [(0, 0.4, 0.7), (0, 0.4, 1.18), (0.3, 0, 0), (2.5, 0, 1), (0, 0.02, 0.04), (0, 0, 0)]
)
def test_channels_of_one_station_are_cut_to_the_time_that_they_share(tmp_path, starts):
    stream = stream_of(starts)
    stream.write(str(tmp_path / "late.mseed"), format="MSEED")
    motion = load_motion(tmp_path / "late.mseed", unit="m/s^2")
    assert (motion.acceleration.argmax(axis=0) == round((6.0 - max(starts)) / 0.02)).all()
    assert ("cut to the time that all components share" in " ".join(motion.treatment)) == any(starts)
    for trace in stream:
        trace.write(str(tmp_path / f"{trace.stats.channel}.sac"), format="SAC")
    apart = load_motion(sorted(tmp_path.glob("*.sac")), unit="m/s^2")
    np.testing.assert_allclose(apart.acceleration, motion.acceleration, atol=1e-6)


def test_channels_that_share_no_time_are_of_two_records(tmp_path):
    stream_of((0, 0, 30.0)).write(str(tmp_path / "two.mseed"), format="MSEED")
    with pytest.raises(InputError, match="are of different records: start"):
        load_motion(tmp_path / "two.mseed", unit="m/s^2")


def test_a_channel_that_ends_sooner_than_the_others_is_warned_of(tmp_path):
    stream = stream_of((0, 0.4, 0.7))
    stream[1].data = stream[1].data[:300]
    stream.write(str(tmp_path / "cut.mseed"), format="MSEED")
    with pytest.warns(SlipwiseWarning, match="components of unequal length"):
        load_motion(tmp_path / "cut.mseed", unit="m/s^2")


@pytest.mark.parametrize("damage", [lambda b: b[: len(b) - 100], lambda b: b[:512] + b"\xff" * 300 + b[812:]])
def test_a_damaged_record_of_miniseed_is_refused(tmp_path, damage):
    path = tmp_path / "cut.mseed"
    stream_of((0, 0.4, 0.7)).write(str(path), format="MSEED", reclen=512)
    path.write_bytes(damage(path.read_bytes()))
    with pytest.raises(InputError, match="cut.mseed: a record of the file is cut off or damaged; fetch it again"):
        load_motion(path, unit="m/s^2")


def test_whole_numbers_are_counts_until_the_acceleration_of_one_is_given(tmp_path):
    obspy = pytest.importorskip("obspy")
    counts = (wave(100) * 1000).astype(np.int32)
    path = tmp_path / "counts.mseed"
    obspy.Trace(counts, {"delta": 0.01, "channel": "HNE", "station": "TST"}).write(str(path), format="MSEED")
    with pytest.raises(UnitError, match=r"holds whole numbers, counts of a digitizer; .*--count '2\.4e-6 m/s\^2'"):
        load_motion(path, unit="mm/s^2")
    motion = load_motion(path, count="2.4e-6 m/s^2")
    np.testing.assert_allclose(motion.acceleration[:, 0], counts * 2.4e-6, rtol=1e-9)
    np.testing.assert_allclose(load_motion(path, unit="2 mm/s^2").acceleration[:, 0], counts * 2e-3, rtol=1e-9)
    with pytest.raises(UnitError, match="say the same; leave one out"):
        load_motion(path, unit="gal", count="2.4e-6 m/s^2")
    with pytest.raises(UnitError, match="dimension"):
        load_motion(path, count="2.4e-6 m/s")


@pytest.mark.parametrize("below", ["Max,1,2,3\n", "\nEnd of record\n", "\nPeaks\nx,1\n"])
def test_a_motion_tells_which_lines_below_its_table_are_left_out(load, below):
    motion = load(table("time [s],ax [m/s2],ay [m/s2],az [m/s2]\n", [TIME, *THREE.T]) + below)
    assert len(motion) == len(TIME)
    said = [words for words in motion.treatment if "below the table" in words]
    assert said and all("left out, beginning" in words for words in said)


@pytest.mark.parametrize(
    "head", ["时间(s),东西向(gal),南北向(gal),竖向(gal)\n", "Tiempo(s),Ace_EO(gal),Ace_NS(gal),Ace_V(gal)\n"]
)
def test_directions_in_chinese_and_behind_a_spanish_prefix_are_told(load, head):
    motion = load(table(head, [TIME, *(100 * THREE.T)]))
    np.testing.assert_allclose(motion.acceleration, THREE, atol=1e-5)


def test_two_tables_without_times_are_no_record_of_twice_the_length(load):
    text = "sampling rate (Hz): 100\nEW (gal),NS (gal),UD (gal)\n" + "".join(
        f"{a:.4f},{b:.4f},{c:.4f}\n" for a, b, c in 100 * THREE
    )
    assert len(load(text)) == 60
    with pytest.raises(InputError, match="2 tables stand one below the other, from lines 3, 65 on"):
        load(text + text)
    with pytest.raises(InputError, match="line 62: the last number is cut off"):
        load(text[:-3])
