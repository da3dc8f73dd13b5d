"""Layouts of agencies: values, unit, step, direction, stated peak and its time; what holds no acceleration is named."""

import io

import numpy as np
import pytest

from slipwise.errors import InputError, SlipwiseWarning, UnitError
from slipwise.motion import load_motion
from slipwise.motion.detect import detect
from slipwise.motion.source_file import source_of
from slipwise.motion.stated import Given
from slipwise.motion.stated_peak import check_stated_peak
from unit.motion import agency_samples as agencies
from unit.motion.samples import csmip, wave

VALUES = agencies.three()
FILES = agencies.every_agency()


def read(data: bytes, name: str = "file.txt", **given):
    source = source_of(name, name.rpartition(".")[0], data)
    return detect(source).read(source, Given(**given))


def test_each_layout_is_recognised_by_its_content():
    named = {kind: detect(source_of("earthquake", "earthquake", data)).name for kind, data in FILES.items()}
    assert named == {kind: {"ESM": "text columns", "GeoNet V1A": "GeoNet V2A"}.get(kind, kind) for kind in FILES}


@pytest.mark.parametrize(
    ("kind", "names", "dt", "factor", "decimals"),
    [
        ("ESM", ("HNE",), 0.005, 0.01, 6),
        ("CWB/TSMIP", ("U", "N", "E"), 0.02, 0.01, 3),
        ("CSMNC", ("EW",), 0.005, 0.01, 4),
        ("UNAM ASA", ("V", "N00E", "N90E"), 0.005, 0.01, 4),
        ("COSMOS", ("340 deg",), 0.01, 0.01, 5),
        ("CSMIP/CESMD V1", ("360 Deg", "Up"), 0.005, 9.80665e-3, 3),
        ("GeoNet V1A", ("S90E", "N00E", "Up"), 0.005, 9e-3, 1),
    ],
)
def test_values_steps_names_and_the_headers_peak_are_met(kind, names, dt, factor, decimals):
    traces = read(FILES[kind])
    assert tuple(trace.name for trace in traces) == names
    for k, trace in enumerate(traces):
        assert trace.dt == pytest.approx(dt)
        np.testing.assert_allclose(trace.acceleration, VALUES[:, k] * factor, atol=0.51 * 10.0**-decimals * factor)
        at = int(np.abs(trace.acceleration).argmax())
        assert abs(trace.header_peak.value) == pytest.approx(np.abs(trace.acceleration).max(), abs=5e-4 * 10)
        assert trace.header_peak.time is None or trace.header_peak.time == pytest.approx(at * dt, abs=0.51 * dt)


@pytest.mark.parametrize("kind", FILES)
def test_a_step_or_a_unit_that_contradicts_the_file_is_refused_naming_both(kind):
    with pytest.raises(InputError, match=r"states a step of .* s, 0\.013 s was given"):
        read(FILES[kind], dt=0.013)
    with pytest.raises(UnitError, match="as its unit, 'ft/s\\^2' was given"):
        read(FILES[kind], unit="ft/s^2")
    assert read(FILES[kind], dt=read(FILES[kind])[0].dt)


@pytest.mark.parametrize("kind", [k for k in FILES if k != "COSMOS"])
@pytest.mark.parametrize("share", [0.7, 0.9, 0.985])
def test_a_truncated_record_is_refused(kind, share):
    with pytest.raises(InputError):
        read(FILES[kind][: int(share * len(FILES[kind]))])


@pytest.mark.parametrize("kind", [k for k in FILES if k not in ("CWB/TSMIP", "UNAM ASA")])
def test_a_component_of_another_size_than_the_stated_peak_is_refused_if_it_is_used_and_else_named(kind):
    written = f"{VALUES[:, 0][np.abs(VALUES[:, 0]).argmax()]:13.6f}".encode()
    old, new = {
        "ESM": (b"PGA_CM/S^2: 1", b"PGA_CM/S^2: 7"),
        "CSMNC": (b"VALUE:    1", b"VALUE:    7"),
        "COSMOS": (written, b"   712.000000"),
        "CSMIP/CESMD V1": (b"Max  =   0", b"Max  =   9"),
        "GeoNet V1A": (b"Peak  ", b"Peak  8"),
    }[kind]
    data = FILES[kind].replace(old, new)
    assert data != FILES[kind]
    trace = read(data)[0]
    with pytest.raises(InputError, match=r"states a peak of"):
        check_stated_peak(trace, None, used=True)
    with pytest.warns(SlipwiseWarning, match=r"states a peak of .* it is not used"):
        check_stated_peak(trace, None, used=False)


def test_velocity_and_displacement_beside_acceleration_are_left_out_and_alone_refused():
    alone = agencies.cosmos(VALUES[:, 0], what="velocity", unit="cm/sec (05)")
    with pytest.raises(UnitError, match="holds corrected velocity; a table needs acceleration"):
        read(alone)
    raw = agencies.cosmos(VALUES[:, 0], what="acceleration", level="Raw", unit="counts (50)")
    with pytest.raises(UnitError, match="raw counts"):
        read(raw)


def test_a_volume_1_from_film_and_spectra_are_refused_by_their_names_and_the_right_file_is_said():
    film = b"UNCORRECTED ACCELEROGRAM DATA   PROCESSED: 1\r\nNOWHERE\r\nCHAN  1: EW  (STA CHN:  1)\r\n 0.01 0.12\r\n"
    with pytest.raises(InputError, match=r"uncorrected accelerogram \(Volume 1\).*take the V2 file"):
        read(film)
    spectra = b"Response and Fourier amplitude spectra (78 periods,  .04 -  6.0 sec)   for\r\n"
    with pytest.raises(InputError, match="Volume 3 file.*take the V2 file"):
        read(spectra)


def structure(places=("Roof", "Roof", "Roof"), names=("Long", "Tran", "Up")) -> list[bytes]:
    """A structure of six channels, one a file."""
    files = []
    for number, (name, place) in enumerate(zip(names, places, strict=True), 4):
        data = csmip([(name, wave(phase=number))]).replace(b"Chan  1: ", b"Chan  %d: " % number)
        data = data.replace(b"(1 Chns of", b"(6 Chns of")
        files.append(
            data.replace(
                f"Chan  {number}: {name}\r\n".encode(), f"Chan  {number}: {name:<24}  Location: {place}\r\n".encode()
            )
        )
    return files


def test_channels_of_a_structure_come_one_a_file_with_a_location_and_may_be_chosen_by_number(tmp_path):
    for k, data in enumerate(structure()):
        (tmp_path / f"chan{k}.v2").write_bytes(data)
    paths = sorted(tmp_path.glob("*.v2"))
    motion = load_motion(paths)
    assert motion.components == ("Long", "Tran", "Up")
    assert "at Roof" in " ".join(motion.treatment)
    assert load_motion(paths, x="Chan 5", y="4", z="none").components == ("Tran", "Long", "")
    assert load_motion(paths[1]).components == ("Tran", "", "")


def test_channels_of_two_places_of_a_structure_are_warned_of_naming_both(tmp_path):
    for k, data in enumerate(structure(places=("Roof", "Ground", "Roof"))):
        (tmp_path / f"chan{k}.v2").write_bytes(data)
    with pytest.warns(SlipwiseWarning, match="stands at Roof, .* at Ground"):
        load_motion(sorted(tmp_path.glob("*.v2")))


def test_several_channels_of_one_direction_are_listed_by_number(tmp_path):
    for k, data in enumerate(structure(names=("Long", "Long", "Long"))):
        (tmp_path / f"chan{k}.v2").write_bytes(data)
    with pytest.raises(InputError, match=r"Chan 4: Long at Roof.*a component's name or number"):
        load_motion(sorted(tmp_path.glob("*.v2")))


def seismogram(kind: str, tmp_path, **header) -> list:
    obspy = pytest.importorskip("obspy")
    paths = []
    for k, name in enumerate(("HNE", "HNN", "HNZ")):
        trace = obspy.Trace(VALUES[:, k].astype(np.float32), {"delta": 0.01, "channel": name, "station": "TST"})
        trace.stats.update(header)
        paths.append(tmp_path / f"{name}.{kind}")
        trace.write(str(paths[-1]), format=kind)
    return paths


@pytest.mark.parametrize("kind", ["SAC", "MSEED"])
def test_sac_and_miniseed_are_read_by_obspy_and_need_the_unit(kind, tmp_path):
    paths = seismogram(kind, tmp_path)
    motion = load_motion(paths, unit="cm/s^2")
    assert motion.components == ("HNE", "HNN", "HNZ")
    np.testing.assert_allclose(motion.acceleration, VALUES / 100, rtol=1e-6)
    with pytest.raises(UnitError, match="does not state the unit"):
        load_motion(paths)


def test_a_missing_extra_is_named_with_the_command_that_installs_it(tmp_path, monkeypatch):
    path = seismogram("MSEED", tmp_path)[0]
    monkeypatch.setitem(__import__("sys").modules, "obspy", None)
    with pytest.raises(InputError, match=r"pip install 'slipwise\[seismology\]'"):
        load_motion(path, unit="g")


def test_a_damaged_seismogram_is_refused_in_words(tmp_path):
    data = seismogram("SAC", tmp_path)[0].read_bytes()
    (tmp_path / "cut.sac").write_bytes(data[:-40])
    with pytest.raises(InputError, match="not a readable SAC or miniSEED file"):
        load_motion(tmp_path / "cut.sac", unit="g")
    (tmp_path / "binary").write_bytes(b"\x01\x00\x02" * 400)
    with pytest.raises(InputError, match="no text file"):
        load_motion(tmp_path / "binary")


def test_obspy_reads_our_knet_sample_as_we_do():
    obspy = pytest.importorskip("obspy")
    from unit.motion.samples import counts, knet

    data = knet(counts())
    theirs = obspy.read(io.BytesIO(data), format="KNET")[0]
    (ours,) = read(data)
    np.testing.assert_allclose(theirs.data * theirs.stats.calib, ours.acceleration, rtol=1e-6)
