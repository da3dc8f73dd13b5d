"""Standard files of acceleration (UNAM ASA): labels, lines and names as networks write them; damaged ones."""

import numpy as np
import pytest

from slipwise.errors import InputError, SlipwiseWarning
from slipwise.motion import load_motion
from unit.motion.agency_samples import unam
from unit.motion.samples import wave

VALUES = np.stack([0.2 * wave(phase=1.0), wave(), 0.7 * wave(phase=2.0)], axis=1)


@pytest.fixture
def load(tmp_path):
    def write_and_load(data: bytes, **settings):
        path = tmp_path / "TEST0101.011"
        path.write_bytes(data)
        return load_motion(path, **settings)

    return write_and_load


@pytest.mark.parametrize(
    ("names", "x", "y", "z"),
    [
        (("V", "N00E", "N90E"), "N90E", "N00E", "V"),
        (("+V", "N00E", "N90E"), "N90E", "N00E", "+V"),
        (("VERT", "N-S", "E-O"), "E-O", "N-S", "VERT"),
        (("Vertical", "Norte-Sur", "Este-Oeste"), "Este-Oeste", "Norte-Sur", "Vertical"),
        (("-V", "N10E", "N80O"), "N10E", "N80O", "--V"),
        (("Z", "L", "T"), "L", "T", "Z"),
        (("+V", "S00E", "S90E"), "S90E", "S00E", "+V"),
    ],
)
def test_components_find_their_axes_by_the_names_that_networks_use(load, names, x, y, z):
    motion = load(unam(VALUES, names))
    assert motion.components == (x, y, z)
    signs = {name: -1.0 if "-" + name == z else 1.0 for name in names}
    for axis, name in enumerate((x, y, names[0])):
        np.testing.assert_allclose(
            motion.acceleration[:, axis], signs[name] * VALUES[:, names.index(name)] / 100, atol=1e-6
        )


def test_a_component_whose_name_has_a_sign_is_chosen_by_the_name_as_it_stands(load):
    data = unam(VALUES, ("+V", "N00E", "N90E"))
    assert load(data, x="N90E", y="N00E", z="+V").components == ("N90E", "N00E", "+V")
    assert load(data, x="-N90E", y="none", z="none").components == ("-N90E", "", "")


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (b"ACEL. MAX.(Gal), C1-C6", b"ACEL. MAX. (Gal), C1-C6"),
        (b"ACEL. MAX.(Gal), C1-C6", b"ACEL.MAX. (Gal) C1-C6  "),
        (b"ARCHIVO ESTANDAR DE", b"ARCHIVO ESTANDAR De"),
        (b"ARCHIVO ESTANDAR DE ACELERACION", "ARCHIVO ESTÁNDAR DE ACELERACIÓN".encode()),
        (b"NUM. TOTAL DE MUESTRAS, C1-C6", b"NUM.TOTAL DE MUESTRAS C1 - C6"),
        (b"UNIDADES DE LOS DATOS", b"Unidades de los datos"),
        (b"INTERVALO DE MUESTREO, C1-C6 (s)", b"INTERVALO DE MUESTREO, C1-C6, (s)"),
        (b"/V/N00E/N90E", b"/V;V/T;N00E/L;N90E/"),
        (b"ACEL. MAX., C1-C6, EN LA MUESTRA       : /", b"OTRA: //"),
        (b"CLAVE DE LA ESTACION", b"CLAVE"),
        (b"INSTITUTO\n", b"INSTITUTO\n\nRED\nDATOS\n"),
        (b"GRUPO\n", b""),
        (b"---------+---------\n   CANAL", b"DATOS DE ACELERACION:\n---------+---------\n   CANAL"),
    ],
)
def test_blanks_case_accents_and_shifted_lines_do_not_matter(load, old, new):
    plain = unam(VALUES)
    assert old in plain
    motion = load(plain.replace(old, new))
    np.testing.assert_array_equal(motion.acceleration, load(plain).acceleration)
    assert motion.dt == 0.005


def test_a_stated_peak_that_disagrees_matters_only_where_the_component_is_used(load):
    data = unam(VALUES)
    peak = f"/{VALUES[np.abs(VALUES[:, 0]).argmax(), 0]:.4f}/".encode()
    assert peak in data
    wrong = data.replace(peak, b"/9.2000/")
    with pytest.raises(InputError, match=r"states a peak of 0\.092 m/s\^2 \(9\.2000 Gal \(cm/s/s\)\) for V"):
        load(wrong)
    with pytest.warns(SlipwiseWarning, match="for V, .* it is not used"):
        assert load(wrong, z="none").components[2] == ""


def test_a_stated_peak_of_one_digit_may_be_off_by_that_digit(load):
    values = VALUES * np.array([0.0155, 1.0, 1.0])  # V reaches 0.36 gal
    data = unam(values)
    peak = f"/{values[np.abs(values[:, 0]).argmax(), 0]:.4f}/".encode()
    assert len(load(data.replace(peak, b"/0.3/"))) == 40
    with pytest.raises(InputError, match="states a peak"):
        load(data.replace(peak, b"/0.2000/"))


def test_a_record_a_few_rows_short_is_taken_on_demand_and_it_is_said(load):
    data = unam(VALUES)
    short = data[: data.rstrip().rfind(b"\n")] + b"\n"
    with pytest.raises(InputError, match="promises 40 values, 39 are there; .* --allow-short"):
        load(short)
    with pytest.warns(SlipwiseWarning, match="39 are there; taken as it is"):
        assert len(load(short, allow_short=True)) == 39


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda data: data[:900], "two rulers of hyphens"),
        (lambda data: data[:-300], "truncated|expected"),
        (lambda data: data.replace(b"/0.005/0.005/0.005", b"/0.005/0.01/0.005"), "do not agree in steps"),
        (lambda data: data.replace(b"NUM. TOTAL", b"NUMERO"), "does not state NUM. TOTAL DE MUESTRAS;"),
        (lambda data: data.replace(b"Gal (cm/s/s)", b"Gal (m/s/s)"), "contradicts itself"),
        (lambda data: data + data.split(b"---------+---------\n")[-1], "promises 40 values, but 80"),
    ],
)
def test_damaged_files_are_refused_in_one_sentence_without_a_pattern(load, damage, words):
    with pytest.raises(Exception, match=words) as refused:
        load(damage(unam(VALUES)))
    assert "\\" not in str(refused.value)
