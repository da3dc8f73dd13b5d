"""Heating against the closed form of a half-space and against another program."""

import gzip

import numpy as np
import pytest
from scipy.special import erf

from shaking import needs_shared
from slipwise.model import base_model, use
from slipwise.rig import load_specimen
from slipwise.simulation.kernel import places
from slipwise.simulation.kernel.layout import pad_memories
from slipwise.simulation.predict import Predictor, predictor

PRESSURE = 16.882e6


def _flux(law: Predictor, flux: float, seconds: float, dt: float, slip: float = 0.0) -> np.ndarray:
    """Drive the four pads with a constant heat flux [W/m^2] and give pad A's temperature rise over time."""
    advance, layout, u = law.law.functions["pad_advance"], law.law.layout, law.numbers
    z, area, speed = layout.first_pad, u[layout.first_pad + places.APPARENT_AREA], 0.1
    place = z + places.PAD_MEMORY + layout.pad_memory["heating"] + 9
    out = []
    for i in range(round(seconds / dt)):
        advance(u, z, 0.0, flux * area / speed, 24.5e3, speed, 0.0, slip, 0.0, 1.0, 1.0, i * dt, dt)
        out.append(u[place])
    return np.array(out)


@pytest.mark.parametrize(("flux", "rise"), [(0.191e6, 56.3), (0.382e6, 112.7)])
def test_a_constant_flux_warms_the_face_as_the_half_space_does(flux: float, rise: float) -> None:
    """docs/theory.md, section 2.5: dT = 2 q sqrt(D t / pi) / k_s after 5 s."""
    warm = _flux(predictor(base_model("bridge1").adding(use("heating"))), flux, 5.0, 0.002)
    assert warm[-1] == pytest.approx(rise, rel=0.01)
    time = 0.002 * np.arange(1, len(warm) + 1)
    exact = 2.0 * flux * np.sqrt(4.44e-6 * time / np.pi) / 18.0
    np.testing.assert_allclose(warm[time > 0.01], exact[time > 0.01], rtol=0.01)


@pytest.mark.parametrize("cooling", [5.0, 600.0])
@pytest.mark.parametrize("dt", [0.001, 0.02, 3.0])
def test_each_relaxation_is_exact_under_a_constant_flux(cooling: float, dt: float) -> None:
    """memory = q l [1 - exp(-t/l)], 1/l = 1/(0.02 s 7^i) + 1/t_c, and a step that lasts longer counts as such."""
    law, flux, count = predictor(base_model("bridge1").adding(use("heating", cooling=cooling))), 2e5, 50
    _flux(law, flux, 0.5 * count * dt, 0.5 * dt)
    _flux(law, flux, 0.5 * count * dt, dt)
    first = law.law.layout.pad_memory["heating"]
    lasting = 1.0 / (1.0 / (0.02 * 7.0 ** np.arange(8)) + 1.0 / cooling)
    exact = flux * lasting * -np.expm1(-count * dt / lasting)
    found = pad_memories(law.law.layout, law.numbers)[0][first : first + 8]
    np.testing.assert_allclose(found, exact, rtol=1e-12)


def test_the_rise_does_not_depend_on_the_sampling() -> None:
    model = base_model("bridge1").adding(use("heating"))
    fine, coarse = _flux(predictor(model), 2e5, 1.0, 0.0005), _flux(predictor(model), 2e5, 1.0, 0.005)
    assert fine[-1] == pytest.approx(coarse[-1], rel=1e-9)


@pytest.mark.parametrize("pause", [1.0, 30.0, 600.0, 1800.0])
@pytest.mark.parametrize("cooling", [100.0, 3600.0])
def test_a_burst_of_heat_is_forgotten_as_one_over_root_of_time_and_lost(pause: float, cooling: float) -> None:
    """Heated for t1, at rest for t: dT = q sqrt(D/pi)/k_s sqrt(pi t_c) [erf(sqrt(u/t_c))] from t to t + t1."""
    law = predictor(base_model("bridge1").adding(use("heating", cooling=cooling)))
    _flux(law, 2e5, 5.0, 0.005)
    law.rest(pause)
    left = pad_memories(law.law.layout, law.numbers)[0][law.law.layout.pad_memory["heating"] + 9]
    lasting = erf(np.sqrt((5.0 + pause) / cooling)) - erf(np.sqrt(pause / cooling))
    exact = 2e5 * np.sqrt(4.44e-6 / np.pi) / 18.0 * np.sqrt(np.pi * cooling) * lasting
    assert left == pytest.approx(exact, rel=0.03, abs=1e-3)


def test_a_point_that_the_pad_has_left_is_not_heated() -> None:
    """r sqrt(pi) / 2 = 19.05 mm for a pad of 43 mm."""
    model = base_model("bridge1").adding(use("heating"))
    assert _flux(predictor(model), 2e5, 0.1, 0.002, slip=0.0190)[-1] > 1.0
    assert _flux(predictor(model), 2e5, 0.1, 0.002, slip=0.0191)[-1] == 0.0


def test_the_face_of_the_pad_itself_is_heated_wherever_it_is() -> None:
    model = base_model("bridge1").adding(use("heating", cover=0.0))
    here, there = (_flux(predictor(model), 2e5, 0.1, 0.002, slip=slip)[-1] for slip in (0.0, 0.03))
    assert here == there > 1.0


def test_one_body_warms_towards_a_limit_and_cools_with_its_time_constant() -> None:
    model = base_model("bridge1").adding(use("heating", lump=1.0, cooling=4.0))
    law = predictor(model)
    warm = _flux(law, 2e5, 40.0, 0.01)
    time = 0.01 * np.arange(1, len(warm) + 1)
    np.testing.assert_allclose(warm, warm[-1] / (1 - np.exp(-10.0)) * (1.0 - np.exp(-time / 4.0)), rtol=1e-9)
    at_four = 2.0 * 2e5 * np.sqrt(4.44e-6 * 4.0 / np.pi) / 18.0
    assert warm[np.searchsorted(time, 4.0 - 1e-9)] == pytest.approx(at_four, rel=1e-6)
    law.rest(4.0)
    left = pad_memories(law.law.layout, law.numbers)[0][law.law.layout.pad_memory["heating"] + 9]
    assert left == pytest.approx(warm[-1] * np.exp(-1.0), rel=1e-9)


def test_friction_falls_by_the_published_factor() -> None:
    """Kumar et al. (2015): k_T = 0.789 (0.7^(T/50) + 0.4), which is 0.9997 at 20 degC; ours is 1 there."""
    law = predictor(base_model("bridge1").adding(use("heating")))
    bound, layout = law.law.functions["pad_bound"], law.law.layout
    place = layout.first_pad + places.PAD_MEMORY + layout.pad_memory["heating"] + 9
    state = (24.5e3, 0.2, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.002)
    cold = bound(law.numbers, layout.first_pad, *state)
    for celsius in (45.0, 69.0, 100.0, 150.0):
        law.numbers[place] = celsius - 20.0
        factor = 0.789 * (0.7 ** (celsius / 50.0) + 0.4)
        assert bound(law.numbers, layout.first_pad, *state) / cold == pytest.approx(factor, rel=5e-4)


def test_ten_cycles_lose_what_another_program_loses() -> None:
    """OpenSees FPBearingPTV: peak force 2943 -> 2532 N over ten cycles of 50 mm at 0.5 Hz.

    Its friction, 0.12 (1 - 0.5 exp(-100 V)), is `shear_rate` on an area proportional to load with alpha = 0.06 and
    s' = 0.06 p_m: so the whole course of the force is comparable, not the heating alone.
    """
    path = needs_shared("reference", "ptv_sine_TV_heating.csv.gz")
    with gzip.open(path, "rt") as stream:
        reference = np.loadtxt(stream, delimiter=",")
    time, slip, friction, load = reference.T
    specimen = load_specimen("bridge1")
    speed_law = use("shear_rate", strength=0.06 * specimen.plastic_pressure, rate=100.0, slow=0.06)
    law = predictor(base_model(specimen, [speed_law, use("heating")]))
    four = np.ones((1, 4))
    velocity = np.zeros((len(time), 4, 2))
    velocity[:, :, 0] = (0.05 * np.pi * np.cos(np.pi * time))[:, None]
    place = np.zeros_like(velocity)
    place[:, :, 0] = slip[:, None]
    ours = np.abs(law.pads(time, load[:, None] * four, velocity, place).force[:, 0, 0])
    theirs = np.abs(friction)
    first, last = time < 2.0, time > 18.0
    assert theirs[first].max() == pytest.approx(2943, abs=1) and theirs[last].max() == pytest.approx(2532, rel=0.01)
    assert ours[last].max() == pytest.approx(theirs[last].max(), rel=0.02)
    sliding = (np.abs(velocity[:, 0, 0]) > 0.03) & (time > 0.1)
    difference = (ours - theirs)[sliding] / theirs[sliding]
    assert np.sqrt(np.mean(difference**2)) < 0.02
