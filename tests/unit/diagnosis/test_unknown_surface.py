"""Structure can be predicted on runs that no fit has seen; noise, and one early reversal, cannot."""

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from slipwise.diagnosis.unknown_surface import _surfaces, structured


def _best(relation: str, left: Any, states: dict[str, Any]) -> Any:
    """Hold a residual over some states of a fitted and a held-out run, half of the samples each."""
    count = len(left) // 2
    whole = {"left": left, "sigma": np.ones_like(left), **states}
    halves = [{k: v[part] for k, v in whole.items()} for part in (slice(count), slice(count, None))]
    problem = SimpleNamespace(fitted=[0], held_out=[1])
    found = _surfaces(cast(Any, SimpleNamespace(problem=problem)), relation, halves)
    return max(found, key=lambda s: s.level)


@pytest.fixture
def noise() -> np.random.Generator:
    return np.random.default_rng(3)


def test_a_force_over_speed_is_found_where_it_depends_on_speed(noise):
    speed, slip = noise.normal(size=8000), noise.normal(size=8000)
    left = noise.normal(size=8000) + 2.0 * np.tanh(speed)
    best = _best("pads", left, {"velocity": speed, "slip": slip})
    assert structured(best)
    assert "velocity" in best.states


def test_noise_is_no_structure(noise):
    assert not structured(_best("pads", noise.normal(size=8000), {"velocity": noise.normal(size=8000)}))


def test_one_early_reversal_in_each_run_is_no_structure(noise):
    speed = noise.normal(size=8000)
    left = noise.normal(size=8000)
    early = np.r_[100:106, 5000:5006]
    left[early], speed[early] = 90.0, -4.0
    assert not structured(_best("pads", left, {"velocity": speed}))


def test_the_noise_of_the_vertical_accelerometer_does_not_foretell_itself_in_heave(noise):
    gauge = noise.normal(size=8000)
    load = 0.1 * noise.normal(size=8000)
    assert not structured(
        _best("heave", -gauge, {"vertical": gauge, "load": load, "velocity": noise.normal(size=8000)})
    )
