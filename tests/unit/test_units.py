"""Units as laboratories write them."""

import pytest

from slipwise.errors import UnitError
from slipwise.units import affine, parse_unit, quantity


@pytest.mark.parametrize(
    ("text", "dimension", "expected"),
    [
        ("10.02 t", "kg", 10020.0), ("1 tonf", "N", 9806.65), ("1 kgf", "N", 9.80665), ("1 KGF", "N", 9.80665),
        ("5 KN", "N", 5e3), ("5kN", "N", 5e3), ("3 N/mm2", "Pa", 3e6), ("3 N/mm^2", "Pa", 3e6), ("2 MPA", "Pa", 2e6),
        ("2 GAL", "m/s^2", 0.02), ("2 gal", "m/s^2", 0.02), ("2 Gal", "m/s^2", 0.02), ("2 m/s2", "m/s^2", 2.0),
        ("2 M/S2", "m/s^2", 2.0), ("2 cm/sec2", "m/s^2", 0.02), ("2 cm/sec/sec", "m/s^2", 0.02),
        ("2 m/sec^2", "m/s^2", 2.0), ("2 m s-2", "m/s^2", 2.0), ("2 m s^-2", "m/s^2", 2.0), ("2 m·s⁻²", "m/s^2", 2.0),
        ("2 m/s²", "m/s^2", 2.0), ("0.3 g", "m/s^2", 2.941995), ("0.3 G", "m/s^2", 2.941995),
        ("5 mg", "m/s^2", 0.04903325), ("3 Sec", "s", 3.0), ("1e-3 s", "s", 1e-3), ("30 min", "s", 1800.0),
        ("2 MM", "m", 2e-3), ("2 m.s-2", "m/s^2", 2.0), ("2 cm.s^-2", "m/s^2", 0.02), ("2 s-2.m", "m/s^2", 2.0),
        ("3 Nm", "N*m", 3.0), ("3 kNm", "N*m", 3e3), ("3 N.m", "N*m", 3.0), ("3 kNmm/rad", "J", 3.0),
        ("3 nm", "m", 3e-9),
        ("2 Inch", "m", 0.0508), ("2 in", "m", 0.0508), ("3 kN/mm", "N/m", 3e6), ("3 kN cm", "J", 30.0),
        ("1 HZ", "Hz", 1.0),
        ("20 °C", "K", 293.15),         ("1 μm", "m", 1e-6), ("5 %", "1", 0.05), ("1 kip", "N", 4448.2216),
    ],
)  # fmt: skip
def test_a_unit_is_read_as_it_is_written(text, dimension, expected):
    assert quantity(text, dimension, "x") == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize("unit", ["ton", "tons", "Ton"])
def test_a_ton_is_refused_with_what_to_write(unit):
    with pytest.raises(UnitError, match="write t for 1000 kg"):
        quantity(f"10 {unit}", "kg", "mass")
    with pytest.raises(UnitError, match="tonf"):
        parse_unit(unit, "N", "column 'load'")


def test_an_offset_unit_has_its_offset():
    assert affine("degC", "K", "x") == (pytest.approx(1.0), pytest.approx(273.15))


@pytest.mark.parametrize(
    ("text", "dimension"), [("3 bananas", "m"), ("3", "m"), ("x m", "m"), ("3 kg", "N"), ("3 m^", "m")]
)
def test_what_is_no_unit_of_the_dimension_is_refused(text, dimension):
    with pytest.raises(UnitError):
        quantity(text, dimension, "x")
