"""Response spectra against closed forms, and motions scaled to one."""

import numpy as np
import pytest

from slipwise.errors import InputError, UnitError
from slipwise.motion import TableMotion, load_motion, read_spectrum, response_spectrum, scale_to_spectrum


def harmonic(frequency, peak, seconds=20.0, dt=0.002):
    time = np.arange(0.0, seconds, dt)
    acceleration = np.zeros((len(time), 3))
    acceleration[:, 0] = peak * np.sin(2.0 * np.pi * frequency * time)
    return TableMotion(dt, acceleration, "a sine", ("x", "", ""))


def test_a_long_sine_shakes_an_oscillator_at_resonance_by_one_over_twice_the_damping():
    found = response_spectrum(harmonic(2.0, 1.0), [0.5])
    assert found.acceleration[0] == pytest.approx(1.0 / (2.0 * 0.05), rel=0.01)


def test_a_stiff_oscillator_moves_with_the_ground():
    assert response_spectrum(harmonic(1.0, 2.0), [0.03]).acceleration[0] == pytest.approx(2.0, rel=0.01)


def test_a_scaled_motion_has_the_level_of_the_target_and_keeps_its_shape(tmp_path):
    (tmp_path / "site.csv").write_text("period [s],acceleration [g]\n0.1,0.4\n0.5,0.4\n2.0,0.1\n")
    target = read_spectrum(tmp_path / "site.csv")
    assert target.acceleration == pytest.approx(9.80665 * np.array([0.4, 0.4, 0.1]))
    motion = load_motion("quake:seed=3,peak=0.2g,f=2Hz,vertical=0.1g")
    scaled = scale_to_spectrum(motion, target)
    periods = np.geomspace(0.1, 2.0, 3)
    wanted = np.exp(np.interp(np.log(periods), np.log(target.period), np.log(target.acceleration)))
    assert np.mean(np.log(response_spectrum(scaled, periods).acceleration / wanted)) == pytest.approx(0.0, abs=1e-9)
    assert np.ptp(scaled.acceleration[:, 2]) / np.ptp(scaled.acceleration[:, 0]) == pytest.approx(
        np.ptp(motion.acceleration[:, 2]) / np.ptp(motion.acceleration[:, 0])
    )


@pytest.mark.parametrize(
    ("text", "kind", "words"),
    [
        ("period [s],acceleration\n0.1,0.4\n0.5,0.4\n", UnitError, "acceleration"),
        ("period [s],acceleration [g]\n0.5,0.4\n0.1,0.4\n", InputError, "rise from line to line"),
        ("period [s],a [g],b [g]\n0.1,0.4,1\n0.5,0.4,1\n", InputError, "two columns"),
    ],
)
def test_a_file_that_is_no_spectrum_is_refused_in_a_sentence(tmp_path, text, kind, words):
    (tmp_path / "site.csv").write_text(text)
    with pytest.raises(kind, match=words):
        read_spectrum(tmp_path / "site.csv")
