"""The law of friction that a calculation used is read back from its forces, with its numbers."""

import numpy as np
import pytest

from slipwise.campaign import Run
from slipwise.errors import InputError
from slipwise.prediction.friction_families import (
    FAMILIES,
    Sliding,
    collect_sliding,
    fit_families,
    plainest_law,
)
from slipwise.record import Record

AREA, REST = 1.45e-3, 24.5e3
NUMBERS = {
    "coulomb": [0.1],
    "coulomb at constant load": [0.1],
    "speed": [0.04, 0.06, 25.0],
    "speed at constant load": [0.04, 0.06, 25.0],
    "speed and pressure": [1.4e6, 20.0, 1.0e-7, 0.045],
}


def samples_of(name: str) -> Sliding:
    """Pads that slide at 1 cm/s to 0.6 m/s under loads from a third to twice their share of the weight."""
    rng = np.random.default_rng(3)
    speed, load = rng.uniform(0.01, 0.6, 2000), REST * rng.uniform(0.35, 2.0, 2000)
    still = Sliding(speed, load, np.full(2000, REST), np.full(2000, AREA), load)
    family = next(f for f in FAMILIES if f.name == name)
    return Sliding(speed, load, still.rest, still.area, family.law(still, NUMBERS[name]))


@pytest.mark.parametrize("name", NUMBERS)
def test_the_family_and_its_numbers_are_read_back(name):
    law = plainest_law(fit_families(samples_of(name)))
    assert law.family.name == name
    assert list(law.numbers.values()) == pytest.approx(NUMBERS[name], rel=0.02)
    assert not law.is_foreign


def test_a_law_that_is_none_of_them_is_said_to_be_foreign():
    made = samples_of("coulomb")
    warm = Sliding(made.speed, made.load, made.rest, made.area, made.force * (1.0 - 0.5 * np.linspace(0, 1, 2000)))
    assert plainest_law(fit_families(warm)).is_foreign


def test_nothing_is_read_where_no_pad_slides_under_a_known_load():
    time = np.linspace(0.0, 1.0, 200)
    run = Run("one", "fit", Record(time, {"slip_x": np.sin(time)}), None, None, "one.csv", "")
    with pytest.raises(InputError, match="no law of friction can be read"):
        collect_sliding([run], {"A": AREA})
