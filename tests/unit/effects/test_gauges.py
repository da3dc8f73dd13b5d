"""Every instrument effect against its own definition, on signals whose changed form is known."""

import numpy as np
import pytest

from slipwise.effects import find_effect
from slipwise.errors import InputError, UnknownNameError
from slipwise.model import use
from slipwise.record import Record

DT = 0.002
TIME = DT * np.arange(3000)


def smooth(time: np.ndarray) -> np.ndarray:
    """Three bursts of a few hertz that begin and end at rest."""
    return sum(
        a * np.exp(-(((time - t) / 0.4) ** 2)) * np.sin(2 * np.pi * f * (time - t) + 0.3)
        for a, f, t in ((1.0, 2.0, 1.8), (0.6, 9.0, 3.0), (0.3, 23.0, 4.2))
    )


def record() -> Record:
    channels = {"slip_x": 0.02 * smooth(TIME), "girder_ax": 5.0 * smooth(TIME + 0.07)}
    for i, pad in enumerate("ABCD"):
        channels |= {f"pad_{pad}_N": 24.5e3 + 4e3 * smooth(TIME - 0.1 * i), f"pad_{pad}_Fx": 2.8e3 * smooth(TIME)}
        channels |= {f"pad_{pad}_Fy": 0.3e3 * smooth(TIME - 0.2)}
    channels |= {f"table_a{axis}": (2.0 + i) * smooth(TIME + 0.03 * i) for i, axis in enumerate("xyz")}
    return Record(TIME, channels)


def read(name: str, target: str, **values: float) -> Record:
    entry = use(name, target, **values)
    return entry.effect.hooks["gauge"](record(), entry.target, **entry.values)


@pytest.mark.parametrize("delay", [0.3e-3, 2e-3, -7.1e-3])
def test_a_delayed_channel_shows_the_past_between_samples_too(delay: float) -> None:
    found = read("channel_delay", "slip_x", delay=delay)["slip_x"]
    np.testing.assert_allclose(found, 0.02 * smooth(TIME - delay), atol=1e-7)


def test_a_delay_leaves_noise_as_strong_as_it_was() -> None:
    rng = np.random.default_rng(0)
    noisy = record().replaced(slip_x=rng.normal(0.0, 1e-5, len(TIME)))
    late = use("channel_delay", "slip_x", delay=1e-3)  # half a sample: straight lines would halve its power
    found = late.effect.hooks["gauge"](noisy, late.target, **late.values)["slip_x"]
    assert np.std(found) == pytest.approx(np.std(noisy["slip_x"]), rel=0.01)


@pytest.mark.parametrize("skew", [1e-4, -5e-4])
def test_a_skewed_clock_is_late_by_a_share_of_the_time(skew: float) -> None:
    found = read("clock_skew", "girder_ax", skew=skew)["girder_ax"]
    inside = slice(50, -50)
    exact = 5.0 * smooth(TIME * (1.0 - skew) + 0.07)
    np.testing.assert_allclose(found[inside], exact[inside], atol=2e-5)


def test_a_filter_lowers_and_delays_a_steady_sine_as_butterworth_says() -> None:
    lag = 5e-3
    corner = np.sqrt(2.0) / lag
    for frequency in (2.0, 15.0, 60.0):
        steady = record().replaced(slip_x=np.sin(2 * np.pi * frequency * TIME))
        entry = use("channel_filter", "slip_x", lag=lag)
        found = entry.effect.hooks["gauge"](steady, entry.target, **entry.values)["slip_x"]
        s = 2j * np.pi * frequency
        factor = 1.0 / (1.0 + np.sqrt(2.0) * s / corner + (s / corner) ** 2)
        middle = slice(1000, 2000)
        np.testing.assert_allclose(found[middle], np.imag(factor * np.exp(s * TIME))[middle], atol=2e-3)
        assert abs(factor) == pytest.approx(1.0 / np.sqrt(1.0 + (2 * np.pi * frequency / corner) ** 4))


@pytest.mark.parametrize("order", [1.0, 2.0, 4.0])
def test_the_lag_of_a_filter_is_that_of_slow_signals_whatever_its_order(order: float) -> None:
    slow = np.sin(2 * np.pi * 0.5 * TIME)
    entry = use("channel_filter", "slip_x", lag=4e-3, order=order)
    found = entry.effect.hooks["gauge"](record().replaced(slip_x=slow), entry.target, **entry.values)["slip_x"]
    middle = slice(1000, 2000)
    np.testing.assert_allclose(found[middle], np.sin(2 * np.pi * 0.5 * (TIME - 4e-3))[middle], atol=2e-4)


def test_gain_sign_offset_and_drift_are_what_their_names_say() -> None:
    true = record()["pad_B_N"]
    np.testing.assert_allclose(read("channel_gain", "pad_B_N", gain=0.03)["pad_B_N"], 1.03 * true)
    np.testing.assert_array_equal(read("channel_sign", "pad_B_N", sign=-1.0)["pad_B_N"], -true)
    np.testing.assert_allclose(read("channel_offset", "pad_B_N", offset=0.01)["pad_B_N"], true + 500.0)
    np.testing.assert_allclose(read("channel_drift", "pad_B_N", drift=1e-4)["pad_B_N"], true + 5.0 * TIME)
    settled = read("channel_drift", "pad_B_N", drift=1e-4, settling=2.0)["pad_B_N"]
    np.testing.assert_allclose(settled, true + 2.5 * (1.0 - np.exp(-2.0 * TIME)), rtol=1e-12)


def test_offsets_are_counted_in_the_span_of_a_gauge_of_that_kind() -> None:
    for target, span in (("pad_A_N", 50e3), ("pad_A_Fx", 10e3), ("slip_x", 0.1), ("girder_ax", 20.0)):
        moved = read("channel_offset", target, offset=0.01)[target] - record()[target]
        np.testing.assert_allclose(moved, 0.01 * span, rtol=1e-9)


def test_a_clipped_channel_stays_between_its_rails() -> None:
    found, true = read("channel_clipping", "pad_A_Fx", upper=0.1, lower=0.05)["pad_A_Fx"], record()["pad_A_Fx"]
    assert found.max() == 1e3 and found.min() == -500.0
    inside = (true < 1e3) & (true > -500.0)
    np.testing.assert_array_equal(found[inside], true[inside])


@pytest.mark.parametrize("burst", [1.0, 4.0])
def test_lost_samples_repeat_the_last_one_and_are_as_many_as_said(burst: float) -> None:
    found, true = read("dropped_samples", "slip_x", share=0.05, burst=burst)["slip_x"], record()["slip_x"]
    lost = found != true
    assert np.mean(lost) == pytest.approx(0.05, abs=0.003)
    for i in np.flatnonzero(lost):
        assert found[i] == found[i - 1]


def test_crosstalk_adds_the_same_cells_load() -> None:
    true, found = record(), read("load_crosstalk", "pad_C_Fx", share=0.01)
    np.testing.assert_allclose(found["pad_C_Fx"], true["pad_C_Fx"] + 0.01 * true["pad_C_N"])
    zeroed = read("load_crosstalk", "pad_C_Fx", share=0.01, zeroed=1.0)["pad_C_Fx"]
    np.testing.assert_allclose(zeroed, true["pad_C_Fx"] + 0.01 * (true["pad_C_N"] - 24.5e3), atol=1e-6)
    every = read("load_crosstalk", "all", share=0.01)
    for pad in "ABCD":
        np.testing.assert_allclose(every[f"pad_{pad}_Fx"], true[f"pad_{pad}_Fx"] + 0.01 * true[f"pad_{pad}_N"])
        np.testing.assert_array_equal(every[f"pad_{pad}_N"], true[f"pad_{pad}_N"])
    other = read("load_crosstalk", "pad_*_N", share=0.01)
    np.testing.assert_allclose(other["pad_D_N"], true["pad_D_N"] + 0.01 * true["pad_D_Fx"])


def test_the_plate_on_a_cell_obeys_newton() -> None:
    """Cell pushes the plate by -F_read, the girder pushes it by F: F - F_read = m a; N_read - N - m g = m a_z."""
    true, found = record(), read("cell_inertia", "pad_B_N", mass=40.0, weighed=1.0)
    np.testing.assert_allclose(true["pad_B_Fx"] - found["pad_B_Fx"], 40.0 * true["table_ax"], atol=1e-9)
    np.testing.assert_allclose(true["pad_B_Fy"] - found["pad_B_Fy"], 40.0 * true["table_ay"], atol=1e-9)
    np.testing.assert_allclose(found["pad_B_N"] - true["pad_B_N"], 40.0 * (true["table_az"] + 9.80665), atol=1e-8)
    np.testing.assert_array_equal(found["pad_A_N"], true["pad_A_N"])
    zeroed = read("cell_inertia", "all", mass=40.0)
    np.testing.assert_allclose(zeroed["pad_D_N"] - true["pad_D_N"], 40.0 * true["table_az"], atol=1e-8)


def test_a_target_may_name_a_group_of_channels() -> None:
    found, true = read("channel_gain", "pad_*_N", gain=0.02), record()
    assert all(np.allclose(found[f"pad_{pad}_N"], 1.02 * true[f"pad_{pad}_N"]) for pad in "ABCD")
    assert all(np.array_equal(found[n], true[n]) for n in true.channels if not n.endswith("_N"))
    for name in true.channels:
        np.testing.assert_allclose(read("channel_gain", "all", gain=0.02)[name], 1.02 * true[name])


def test_a_target_that_is_not_there_is_refused_with_what_there_is() -> None:
    with pytest.raises(UnknownNameError, match="pad_A_N"):
        use("channel_gain", "pad_A_M")
    with pytest.raises(InputError, match="yaw.*it has:.*slip_x"):
        read("channel_gain", "yaw")


def test_filters_and_rails_have_no_inverse() -> None:
    for name in ("channel_filter", "channel_clipping", "dropped_samples"):
        assert "undo" not in find_effect(name).hooks
