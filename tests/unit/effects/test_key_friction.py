"""A key that gives way elastically before it rubs: the share of its friction follows the way, not the speed."""

import numpy as np
import pytest

from slipwise.effects._prandtl import prandtl
from slipwise.model import base_model, use
from slipwise.simulation.predict import predictor

DT, TURNS = 1e-4, 20000
TIME = DT * np.arange(TURNS)
#: Way in lengths of the spring: three of them up and down, slower and slower.
WAY = 3.0 * np.cos(2.0 * np.pi * 4.0 * TIME) * np.exp(-TIME)


def _share(way: np.ndarray) -> np.ndarray:
    """Prandtl's element by its play: the slider is dragged along wherever it is one length away from the way."""
    slider, out = 0.0, np.zeros_like(way)
    for i, x in enumerate(way - way[0]):
        slider = min(max(slider, x - 1.0), x + 1.0)
        out[i] = x - slider
    return out


def test_the_element_follows_its_play() -> None:
    rate = np.gradient(WAY, DT)
    np.testing.assert_allclose(prandtl(rate, DT), _share(WAY), atol=0.01)
    coarse = prandtl(rate[::20], 20 * DT)
    np.testing.assert_allclose(coarse, _share(WAY)[::20], atol=0.05)


@pytest.mark.parametrize("engine", ["compiled", "python"])
def test_the_step_says_the_same_as_the_balance(engine: str) -> None:
    elastic = 2.5e5
    model = base_model("bridge1").adding(use("key_friction", friction=0.2, slow=1.0, elastic=elastic))
    law = predictor(model, engine=engine)
    lift = law.law.functions["girder_lift"]
    rate = np.gradient(WAY, DT) / elastic
    force = np.array(
        [lift(law.numbers, 3e4, 4e4, 0.0, 0.0, w, 0.0, 0.0, t, DT) for w, t in zip(rate, TIME, strict=True)]
    )
    np.testing.assert_allclose(force, -0.2 * 5e4 * _share(WAY), atol=0.02 * 1e4)


def test_a_rigid_key_keeps_no_memory() -> None:
    law = predictor(base_model("bridge1").adding(use("key_friction", friction=0.2, slow=1e-3)))
    lift = law.law.functions["girder_lift"]
    assert lift(law.numbers, 1e4, 0.0, 0.0, 0.0, 2e-3, 0.0, 0.0, 0.0, DT) == pytest.approx(-2e3 * np.tanh(2.0))
    assert lift(law.numbers, 1e4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, DT, DT) == 0.0
