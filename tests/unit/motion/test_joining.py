"""Components of one table are of one record: station, sensor, event and start, each named where they differ."""

import warnings

import pytest

from slipwise.errors import InputError, SlipwiseWarning
from slipwise.motion import load_motion
from slipwise.motion.orientation import orientation
from unit.motion import agency_samples as agencies
from unit.motion import samples


def joined(tmp_path, *contents: bytes, **settings):
    paths = []
    for k, data in enumerate(contents):
        paths.append(tmp_path / f"{k}.dat")
        paths[-1].write_bytes(data)
    with warnings.catch_warnings():
        warnings.simplefilter("error", SlipwiseWarning)
        return load_motion(paths, **settings)


def knet(direction: str, **changes: str) -> bytes:
    data = samples.knet(samples.counts(), direction=direction)
    for old, new in changes.items():
        was = {"station": "TST001", "recorded": "2001/02/03 04:05:06", "origin": "2001/02/03 04:05:00"}[old]
        data = data.replace(was.encode(), new.encode(), 1)
    return data


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"station": "TST002"}, "station TST001 and TST002"),
        ({"recorded": "2001/02/03 04:05:12"}, "start 2001-02-03 04:05:06 and 2001-02-03 04:05:12"),
        ({"origin": "2001/02/03 03:00:00"}, "event 2001/02/03 04:05:00 and 2001/02/03 03:00:00"),
    ],
)
def test_components_of_two_records_are_refused_naming_both_and_joined_on_request(tmp_path, changes, words):
    parts = knet("E-W"), knet("N-S", **changes)
    with pytest.raises(InputError, match=rf"{words}.*--join-anyway"):
        joined(tmp_path, *parts)
    with pytest.raises(SlipwiseWarning, match=rf"{words}.*joined all the same"):
        joined(tmp_path, *parts, join_anyway=True)


def test_borehole_and_surface_of_one_station_are_two_sensors(tmp_path):
    assert joined(tmp_path, knet("5"), knet("4"), knet("6")).components == ("EW", "NS", "UD")
    with pytest.raises(InputError, match="sensor surface and borehole"):
        joined(tmp_path, knet("5"), knet("1"))
    values = samples.wave() / 1000
    with pytest.raises(InputError, match="sensor surface and borehole"):
        joined(tmp_path, samples.at2(values, component="EW2"), samples.at2(values, component="NS1"))
    assert joined(tmp_path, *(samples.at2(values, component=name) for name in ("UD2", "NS2", "EW2"))).components == (
        "EW2",
        "NS2",
        "UD2",
    )


@pytest.mark.parametrize(
    ("one", "other", "words"),
    [
        (agencies.esm(samples.wave()), agencies.esm(samples.wave(), "HNN", station="TST2"), "station TST1 and TST2"),
        (
            agencies.esm(samples.wave()),
            agencies.esm(samples.wave(), "HNN", SENSOR_DEPTH_M="30.0"),
            "sensor surface and 30 m deep",
        ),
        (agencies.csmnc(samples.wave()), agencies.csmnc(samples.wave(), "NS", station="51ABC"), "51TST and 51ABC"),
        (
            samples.at2(samples.wave() / 1000),
            samples.at2(samples.wave() / 1000, component="NS").replace(b"Test Town", b"Elsewhere"),
            "station Test Town and Elsewhere",
        ),
    ],
)
def test_other_formats_state_their_origin_too(tmp_path, one, other, words):
    with pytest.raises(InputError, match=words):
        joined(tmp_path, one, other)


def test_starts_less_than_a_second_apart_are_warned_of(tmp_path):
    late = agencies.esm(samples.wave(), "HNN").replace(b"040506.780", b"040506.900")
    with pytest.raises(SlipwiseWarning, match="as if they started together"):
        joined(tmp_path, agencies.esm(samples.wave()), late)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("HNE", "east-west"), ("BHZ", "up"), ("HN1", "horizontal"), ("EW2", "east-west"), ("UD2", "up"),
        ("FN", "horizontal"), ("FP", "horizontal"), ("090 (STATION)", "east-west"), ("Radial", "horizontal"),
        ("Transverse", "horizontal"), ("acc_NS", "horizontal"), ("Acc X", "table x"), ("a_z", "up"),
        ("North-South", "horizontal"), ("N00E", "horizontal"), ("Up/Down", "up"), ("one", "unknown"),
        ("Northridge", "unknown"), ("girder", "unknown"), ("Long", "horizontal"), ("Tran", "horizontal"),
    ],
)  # fmt: skip
def test_component_names_of_the_world(name, expected):
    assert orientation(name) == expected
