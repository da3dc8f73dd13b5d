"""Damaged files of every format: our own errors or a motion, never a traceback and never a silently wrong unit."""

import warnings

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from slipwise.errors import SlipwiseError, SlipwiseWarning
from slipwise.motion import load_motion
from slipwise.motion.detect import detect
from slipwise.motion.source_file import source_of
from slipwise.motion.stated import Given, acceleration_factor
from unit.motion import samples
from unit.motion.agency_samples import unam

FILES = samples.every_format() | {
    "UNAM ASA": unam(np.stack([samples.wave()] * 3, axis=1)),
    "MIDAS": b"*SGSw\n*X-AXIS, Time(sec)\n*Y-AXIS, Accel (g)\n*DATA\n"
    + b"".join(b"%.2f, %.5f\n" % (0.02 * i, v / 1000) for i, v in enumerate(samples.wave())),
    "Abaqus": b"** acceleration in g\n*Amplitude, name=EQ\n"
    + b"".join(b"%.2f, %.5f\n" % (0.02 * i, v / 1000) for i, v in enumerate(samples.wave())),
    "one line": b"dt = 0.01 s, acceleration in g\n" + b" ".join(b"%.5f" % v for v in samples.wave()),
}
BYTES = st.one_of(
    st.sampled_from(
        [b"", b"-", b".", b"9", b"0", b" ", b"\n", b"\r", b",", b"E", b"nan", b"\x00", b"\xff", b"(", b"]"]
    ),
    st.sampled_from(
        [b"g", b"gal", b"cm/s", b"m/s^2", b"SEC", b"e999", b"1e-320", b"99999999999", b"\x83\x5c", b"NPTS"]
    ),
    st.binary(max_size=4),
)
#: Where (as a share of the file), how much is taken out, what is put in.
CUT = st.tuples(st.floats(0, 1), st.integers(0, 12), BYTES)


def mutated(data: bytes, cuts: list[tuple[float, int, bytes]], within: int | None = None) -> bytes:
    for place, length, put in cuts:
        at = int(place * (len(data) if within is None else within))
        gone = len(data[at : at + length])
        data = data[:at] + put + data[at + length :]
        # A header that was shortened ends earlier.
        within = None if within is None else max(0, within + min(0, len(put) - gone))
    return data


def read(data: bytes, **given_by_user):
    """Give the components, or None if our own error refused the file; every other exception is a failure."""
    try:
        source = source_of("fuzz.txt", "fuzz", data)
        return detect(source).read(source, Given(**given_by_user))
    except SlipwiseError as error:
        assert "fuzz.txt" in str(error)
        return None


def quick(examples: int):
    return settings(
        max_examples=examples, deadline=None, database=None, derandomize=True,
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
    )  # fmt: skip


@pytest.mark.parametrize("kind", FILES)
@pytest.mark.filterwarnings("ignore::slipwise.errors.SlipwiseWarning")
@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_a_file_damaged_anywhere_is_read_or_refused_in_words(kind):
    @quick(100)
    @given(st.lists(CUT, min_size=1, max_size=4))
    def holds(cuts):
        for trace in read(mutated(FILES[kind], cuts)) or []:
            assert np.isfinite(trace.acceleration).all() and len(trace.acceleration) > 1 and trace.dt > 0

    holds()


#: How many of the first bytes are the header.
HEADERS = {
    "GeoNet V2A": b"Velocity:", "CSMIP new": b"\r\n   ", "CSMIP old": b"\r\n   ", "JMA CSV": b"NS,EW", "K-NET": b"Memo",
    "KiK-net": b"Memo", "USGS SMC": b"\r\n|", "Slipwise CSV": b"\n", "PEER AT2": b"NPTS", "columns": b"\n",
}  # fmt: skip


@pytest.mark.parametrize("kind", HEADERS)
def test_a_damaged_header_never_changes_the_unit_silently(kind):
    whole = FILES[kind]
    original = read(whole)
    assert original is not None

    @quick(120)
    @given(st.lists(CUT, min_size=1, max_size=3))
    def holds(cuts):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            traces = read(mutated(whole, cuts, within=whole.index(HEADERS[kind])))
        if traces is None or any(issubclass(warning.category, SlipwiseWarning) for warning in caught):
            return
        by_name = {trace.name: trace for trace in original}
        for place, trace in enumerate(traces):
            before = by_name.get(trace.name, original[place])
            # What the record says it read must be what it read: the unit in its words gives the scale.
            factor = stated_factor(trace) / stated_factor(before)
            np.testing.assert_allclose(trace.acceleration, before.acceleration * factor, rtol=2e-3, atol=1e-12)

    holds()


def stated_factor(trace) -> float:
    unit = trace.treatment[1].partition("unit ")[2].partition(", as ")[0]
    return acceleration_factor(unit, "the words of the record")


@quick(120)
@example("m/s")
@example("sec2")
@example("gal(cm/s)")
@given(st.one_of(st.text(max_size=8), st.from_regex(r"[a-zA-Z]{1,3}(/s(ec)?){0,3}(\^?2)?", fullmatch=True)))
def test_any_unit_in_a_header_is_refused_or_means_what_it_says(unit):
    values = samples.wave() / 1000
    body = "".join(f"{i * 0.01:.2f},{value:.6f}\n" for i, value in enumerate(values))
    traces = read(f"time [s],EW [{unit}]\n{body}".encode())
    if traces and "displacement" not in " ".join(traces[0].treatment):
        # All spellings that may pass are of these dimensions, whatever their case.
        factor = acceleration_factor(unit, "test")
        np.testing.assert_allclose(traces[0].acceleration, values * factor, rtol=1e-3, atol=1e-6 * factor)
        assert unit.strip().strip("()") != "" and ("s" in unit.lower() or "g" in unit.lower())


@quick(150)
@given(st.text(alphabet="sinequaktrmulgl:,=.0123456789 HzgmsvÄ-+e/\n", max_size=40))
def test_any_words_for_a_synthetic_motion_make_one_or_are_refused(text):
    for prefix in ("", "sine:2Hz,0.3g,", "quake:"):
        try:
            load_motion(prefix + text)
        except SlipwiseError:
            continue


SHARED_FILES = [
    "knet_ascii/KNG0012408091957.EW",
    "peer_at2/ARL360.at2",
    "peer_at2/elCentro_Peknold.AT2",
    "usgs_smc/0111a.smc",
    "csmip_v2/ce36456p_CE36456.V2",
    "csv_g/Northridge_1994_PAC-175.csv",
    "dat_two_column/Northridge.dat",
]


@pytest.mark.skipif(not samples.SHARED.is_dir(), reason="../shared/motions is absent: agencies' headers not fuzzed")
@pytest.mark.parametrize("file", SHARED_FILES)
@pytest.mark.filterwarnings("ignore::slipwise.errors.SlipwiseWarning")
def test_an_agencys_own_file_with_a_damaged_header_is_read_or_refused_in_words(file):
    whole = (samples.SHARED / file).read_bytes()
    before = read(whole)
    assert before is not None

    @quick(40)
    @given(st.lists(CUT, min_size=1, max_size=3))
    def holds(cuts):
        traces = read(mutated(whole, cuts, within=min(900, len(whole))))
        assert traces is None or all(np.isfinite(trace.acceleration).all() for trace in traces)

    holds()
