"""Pads that lift and land: against an integration from event to event, and by what must hold in every step."""

import numpy as np
import pytest

from event_driven import integrate
from shaking import G, coulomb, shaken

DT = 5e-4


def pulse(time, frequency: float, cycles: int, peak: float) -> np.ndarray:
    """A sine of some cycles from 0.1 s on that swells and fades [m/s^2]."""
    s = np.asarray(time) - 0.1
    inside = (s > 0.0) & (s < cycles / frequency)
    return peak * np.sin(2 * np.pi * frequency * s) * np.sin(np.pi * frequency * s / cycles) ** 2 * inside


def table(time, along: tuple[float, int, float], upwards: tuple[float, int, float]) -> tuple[np.ndarray, np.ndarray]:
    return pulse(time, *along), pulse(time, *upwards)


def sampled(shakes, seconds: float, dt: float = DT) -> np.ndarray:
    time = np.arange(round(seconds / dt)) * dt
    out = np.zeros((len(time), 3))
    out[:, 0], out[:, 2] = table(time, *shakes)
    return out


HOP = ((2.0, 4, 0.5 * G), (4.0, 4, 1.6 * G))
BRIDGE_1 = ((2.0, 4, 0.6 * G), (3.3, 6, 1.5 * G))
BRIDGE_2 = ((2.0, 4, 0.6 * G), (3.3, 6, 1.3 * G))
ROCK = ((1.5, 3, 0.75 * G), (1.0, 1, 0.0))
#: Long enough for ten to twenty hops; later ones hang on the last digits of those before.
CASES = {
    "hop": (coulomb("block", 0.1), HOP, 1.39),
    "bridge1": (coulomb("bridge1", 0.113), BRIDGE_1, 1.8),
    "bridge2": (coulomb("bridge2", 0.113), BRIDGE_2, 1.8),
}


def lifts(replay, pad: str) -> np.ndarray:
    lifted = replay.record[f"pad_{pad}_N"] <= 0.0
    return replay.record.time[1:][lifted[1:] & ~lifted[:-1]]


def reference(model, shakes, seconds: float):
    mu = model.specimen.shear_strength / model.specimen.plastic_pressure

    def at(time: float) -> tuple[float, float]:
        along, upwards = table(time, *shakes)
        return float(along), float(upwards)

    return integrate(model.built_specimen(), mu, at, seconds, DT)


@pytest.mark.parametrize("case", CASES)
def test_hops_and_slips_as_an_integration_from_event_to_event_says(case):
    model, shakes, seconds = CASES[case]
    expected, replay = reference(model, shakes, seconds), shaken(model, sampled(shakes, seconds))
    for side, pad in enumerate("AB"):
        assert len(expected.lifts[side]) > 3
        found = lifts(replay, pad)
        assert len(found) == len(expected.lifts[side])
        # A record shows a lift at the first of its steps at which the load is zero.
        assert found == pytest.approx(expected.lifts[side], abs=1e-3 + DT / 2)
    assert replay.record["slip_x"].max() == pytest.approx(expected.slip.max(), rel=0.005)
    assert replay.record["slip_x"].min() == pytest.approx(expected.slip.min(), rel=0.005)
    assert sum(replay.pad_energy.values()) == pytest.approx(expected.energy, rel=0.005)


def test_a_tall_block_that_does_not_slide_rocks_as_the_integration_says():
    model = coulomb("block", 0.7, centre_height=2.2)
    expected, replay = reference(model, ROCK, 1.6), shaken(model, sampled(ROCK, 1.6))
    assert [len(times) for times in expected.lifts] == [1, 4]
    for side, pad in enumerate("AB"):
        assert lifts(replay, pad) == pytest.approx(expected.lifts[side], abs=1e-3)
    assert np.abs(replay.record["slip_x"]).max() < 2e-5


@pytest.mark.parametrize("rig", ["bridge1", "bridge2"])
def test_friction_follows_the_load_of_its_own_step(rig):
    record = shaken(coulomb(rig, 0.113), sampled(BRIDGE_1, 2.6)).record
    for pad in "ABCD":
        load = record[f"pad_{pad}_N"]
        friction = np.hypot(record[f"pad_{pad}_Fx"], record[f"pad_{pad}_Fy"])
        assert (load <= 0.0).any()
        assert np.all(load >= 0.0)
        assert np.all(friction <= 0.113 * load * (1 + 1e-9) + 1e-6)


@pytest.mark.parametrize("rig", ["bridge1", "bridge2"])
def test_energy_closes_where_pads_lift(rig):
    coarse = shaken(coulomb(rig, 0.113), sampled(BRIDGE_1, 2.6))
    fine = shaken(coulomb(rig, 0.113), sampled(BRIDGE_1, 2.6, 5e-5), dt=5e-5)
    assert coarse.uplift > 1.0
    assert abs(coarse.energy_error) < 2e-4
    assert abs(fine.energy_error) < 2e-5


def test_nothing_moves_when_the_step_is_halved():
    model, shakes, seconds = CASES["bridge1"]
    one = shaken(model, sampled(shakes, seconds))
    half = shaken(model, sampled(shakes, seconds, DT / 2), dt=DT / 2, output_dt=DT)
    assert half.record["slip_x"] == pytest.approx(one.record["slip_x"], abs=1e-4 * np.ptp(one.record["slip_x"]))
    assert sum(half.pad_energy.values()) == pytest.approx(sum(one.pad_energy.values()), rel=0.003)
    assert half.uplift == pytest.approx(one.uplift, abs=3e-3)


def test_both_engines_refine_the_same_steps():
    motion = sampled(HOP, 0.8)
    compiled, python = (shaken(coulomb("block", 0.1), motion, engine=engine) for engine in ("compiled", "python"))
    assert compiled.uplift > 0.1
    assert python.uplift == pytest.approx(compiled.uplift, abs=1e-12)
    for name, values in compiled.record.channels.items():
        assert python.record[name] == pytest.approx(values, rel=1e-9, abs=1e-9 * max(1.0, np.abs(values).max())), name
