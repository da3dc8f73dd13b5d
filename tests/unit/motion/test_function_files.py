"""Time functions of finite-element programs: pairs, Abaqus amplitudes, MIDAS functions, one line; damaged twins."""

import numpy as np
import pytest

from slipwise.errors import InputError, UnitError
from slipwise.motion import load_motion
from unit.motion.samples import wave

VALUES = np.round(wave(48) / 500, 5)
TIMES = 0.02 * np.arange(48)
G = 9.80665


@pytest.fixture
def load(tmp_path):
    def write_and_load(text: str, name: str = "function.txt", **settings):
        path = tmp_path / name
        path.write_text(text)
        return load_motion(path, **settings)

    return write_and_load


def pairs(per_line: int, separator: str = " ", count: int = 48) -> str:
    written = [f"{t:.4f}{separator}{v:.5f}" for t, v in zip(TIMES[:count], VALUES[:count], strict=True)]
    return "".join(separator.join(written[i : i + per_line]) + "\n" for i in range(0, count, per_line))


def check(motion, values=VALUES, factor=G):
    assert motion.dt == pytest.approx(0.02)
    np.testing.assert_allclose(motion.acceleration[:, 0], values * factor, atol=1e-9)


@pytest.mark.parametrize("per_line", [2, 3, 4, 5, 24, 48])
@pytest.mark.parametrize("separator", [" ", ", ", "\t"])
def test_pairs_of_time_and_value_are_read_however_many_stand_in_a_line(load, per_line, separator):
    motion = load(pairs(per_line, separator), unit="g")
    check(motion)
    assert f"{per_line} pairs of time and value a line" in " ".join(motion.treatment)


def test_pairs_bind_as_every_header_does(load):
    check(load("$ ACCELERATION IN G\n" + pairs(4)))
    check(load("TIME ACC TIME ACC TIME ACC TIME ACC\n" + pairs(4), unit="g"))
    with pytest.raises(InputError, match=r"states a step of 0\.02 s, 0\.01 s was given"):
        load(pairs(4), unit="g", dt="0.01 s")
    with pytest.raises(InputError, match=r"the header states a step of 0\.01 s, its time column 0\.02 s"):
        load("dt = 0.01 s\n" + pairs(4), unit="g")


@pytest.mark.parametrize("damage", [lambda t: t[:-12], lambda t: t + t, lambda t: t.replace("0.4000", "0.9000")])
def test_damaged_pairs_are_refused(load, damage):
    with pytest.raises(InputError):
        load(damage(pairs(4)), unit="g")


@pytest.mark.parametrize("header", ["", "Acceleration in g, dt = 0.02 s\n", "48 0.02\n", "units: g\n48\n"])
@pytest.mark.parametrize("separator", [" ", ",", ", ", ";"])
def test_a_series_in_one_line(load, header, separator):
    text = header + separator.join(f"{v:.5f}" for v in VALUES) + "\n"
    check(load(text, unit="g", dt="0.02 s"))


def amplitude(name: str, values: np.ndarray, keyword: str = "*Amplitude, name=") -> str:
    written = [f"{t:.2f}, {v:.5f}" for t, v in zip(TIMES, values, strict=True)]
    rows = "".join(", ".join(written[i : i + 4]) + "\n" for i in range(0, len(written), 4))
    return f"{keyword}{name}, time=TOTAL TIME\n{rows}"


def test_abaqus_amplitudes_are_components(load):
    check(load("** ground motion\n" + amplitude("EQ", VALUES), unit="g"))
    check(load("** Acceleration in g\n" + amplitude("EQ", VALUES, "*AMPLITUDE, NAME=")))
    both = amplitude("EQ-X", VALUES) + amplitude("EQ-Z", VALUES / 2) + "*Step, name=Step-1\n*Dynamic\n0.01, 1.\n"
    motion = load(both, name="model.inp", unit="g", x="EQ-X", y="none", z="EQ-Z")
    check(motion)
    np.testing.assert_allclose(motion.acceleration[:, 2], VALUES / 2 * G, atol=1e-4)
    with pytest.raises(InputError, match="EQ-X .* EQ-Z"):
        load(both, unit="g")


def test_an_abaqus_amplitude_at_equal_spaces_states_its_interval(load):
    rows = "\n".join(", ".join(f"{v:.5f}" for v in VALUES[i : i + 8]) for i in range(0, 48, 8))
    check(load(f"*Amplitude, name=A, definition=EQUALLY SPACED, fixed interval=0.02, begin=0.\n{rows}\n", unit="g"))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (amplitude("EQ", VALUES)[:-9], "pairs of time and value are needed|not a number"),
        (amplitude("EQ", VALUES) + "0.96\n", "holds 97 numbers; pairs of time and value"),
        (amplitude("EQ", VALUES).replace("0.20,", "0.10,"), "repeats|runs backwards|not evenly spaced"),
        ("** dt = 0.01 s\n" + amplitude("EQ", VALUES), r"the header states a step of 0\.01 s, its time column"),
        (
            "*Amplitude, name=S, definition=EQUALLY SPACED, fixed interval=0.02\n1., 2., 3.\n2.\n1., 0., 1.\n",
            "line 3: 1 values stand where 3 were expected",
        ),
        ("*Amplitude, name=P, definition=PERIODIC\n1, 6.28, 0, 1\n", "of the kind periodic holds no values"),
    ],
)
def test_damaged_abaqus_amplitudes_are_refused_in_one_sentence(load, text, words):
    with pytest.raises(InputError, match=words):
        load(text, unit="g")


MIDAS = "*SGSw\n*TITLE, TEST\n*TITLE, \n*X-AXIS, Time(sec)\n*Y-AXIS, Ground Accel. (g)\n*UNIT&TYPE, GRAV, ACCEL\n"
MIDAS += "*FLAGS, 0, 0\n*DATA\n"
ROWS = "".join(f"{t:.3f}, {v:.5f}\n" for t, v in zip(TIMES, VALUES, strict=True))


@pytest.mark.parametrize(
    ("head", "factor"),
    [
        (MIDAS, G),
        (MIDAS.replace("(g)", ""), G),
        (MIDAS.replace("GRAV", "M/SEC2").replace("(g)", "(m/sec2)"), 1.0),
        (MIDAS.replace("*UNIT&TYPE, GRAV, ACCEL\n", "").replace("Ground Accel. (g)", "Accel (gal)"), 0.01),
        (MIDAS.replace("*SGSw\n", ""), G),
        (MIDAS.lower().replace("*data", "*DATA"), G),
    ],
)
@pytest.mark.parametrize("end", ["", "*ENDDATA\n"])
def test_midas_names_both_axes_in_lines_of_their_own(load, head, factor, end):
    motion = load(head + ROWS + end, name="quake.sgs")
    check(motion, factor=factor)
    assert motion.title.upper() == "TEST"


@pytest.mark.parametrize(
    ("text", "error", "words", "settings"),
    [
        (MIDAS + ROWS, UnitError, "states 'g' as its unit, 'gal' was given", {"unit": "gal"}),
        (MIDAS + ROWS, InputError, r"states a step of 0\.02 s, 0\.01 s was given", {"dt": "0.01 s"}),
        (MIDAS.replace("(g)", "(gal)") + ROWS, UnitError, "states 'g', the column 'gal'", {}),
        (MIDAS.replace("ACCEL\n", "DISP\n") + ROWS, UnitError, "of the type DISP", {}),
        (MIDAS + ROWS[:-10], InputError, "1 values stand where 2 were expected", {}),
        (MIDAS + ROWS + ROWS, InputError, "runs backwards", {}),
        (MIDAS, InputError, "no values stand below", {}),
        (MIDAS.replace("*DATA\n", "") + ROWS, InputError, "holds its values below", {}),
    ],
)
def test_damaged_or_contradicted_midas_functions_are_refused(load, text, error, words, settings):
    with pytest.raises(error, match=words):
        load(text, name="quake.sgs", **settings)


def test_two_midas_functions_in_one_file_are_refused(load):
    function = "*SGSw\n*X-AXIS, Time(sec)\n*Y-AXIS, Ground Accel. (g)\n*DATA\n" + ROWS
    with pytest.raises(InputError, match="2 time functions are in this file"):
        load(function + function, name="quake.sgs", unit="g")
