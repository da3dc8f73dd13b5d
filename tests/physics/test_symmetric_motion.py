"""Slip of symmetric motions at the default step, against an integration from event to event."""

from dataclasses import replace

import numpy as np
import pytest

from shaking import FAST, coulomb, shaken
from sliding_block import Friction, integrate
from slipwise.errors import SlipwiseWarning
from slipwise.model import Model, base_model
from slipwise.motion import parse_motion
from slipwise.motion.resample import resample
from slipwise.simulation.replay import replay

DT = 5e-4
#: Times finer that the reference knows the motion.
FINER = 10
SATURATION, STRENGTH, RATE, SLOW = 0.102e-6, 1.379e6, 19.7, 0.046


def low(model: Model) -> Model:
    """The block as its reference is: with so low a centre and so stiff pads that it does not rock."""
    places = tuple(replace(p, stiffness=4.0 * p.stiffness, damping=2.0 * p.damping) for p in model.specimen.places)
    return replace(model, specimen=replace(model.specimen, centre_height=0.01, places=places))


def laws() -> dict[str, tuple[Model, Friction]]:
    faster = base_model("block", ("shear_rate",))
    return {
        "coulomb": (low(coulomb("block")), Friction(FAST)),
        "paper": (low(base_model("block")), Friction(SLOW, STRENGTH * SATURATION, RATE, SATURATION)),
        "speed": (low(faster), Friction(SLOW, STRENGTH / faster.specimen.plastic_pressure, RATE)),
    }


def sampled(text: str, dt: float) -> np.ndarray:
    return np.array(resample(parse_motion(text), dt).acceleration)


def middles(slip: np.ndarray, period: float, cycles: int) -> np.ndarray:
    """Middle between largest and smallest slip of every full cycle but those of the ramps [m]."""
    edges = np.round(np.arange(6, cycles - 4) * period / DT).astype(int)
    return np.array([(slip[a:b].max() + slip[a:b].min()) / 2.0 for a, b in zip(edges, edges[1:], strict=False)])


def compared(law: str, frequency: float, peak: float, vertical: tuple[float, float] | None, cycles: int):
    """Share by which the largest slip errs, and by which the middle walks in a cycle, over the amplitude."""
    model, friction = laws()[law]
    text = f"sine:{frequency!r}Hz,{peak}g,cycles={cycles}"
    text += f",vertical={vertical[0]}Hz,{vertical[1]}g" if vertical else ""
    expected = integrate(model.specimen, friction, sampled(text, DT / FINER), DT / FINER)[::FINER]
    slip = shaken(model, sampled(text, DT)).record["slip_x"][: len(expected)]
    expected = expected[: len(slip)]
    middle = len(slip) // 2
    amplitude = np.ptp(expected[middle : middle + round(1.0 / frequency / DT)]) / 2.0
    walk = middles(slip, 1.0 / frequency, cycles) - middles(expected, 1.0 / frequency, cycles)
    largest = np.abs(slip).max() / np.abs(expected).max() - 1.0
    return largest, (walk[-1] - walk[0]) / (len(walk) - 1) / amplitude, slip


def drawn(count: int, seed: int):
    """Motions of 1 to 20 Hz; every other with a period of whole steps, every other pair with vertical motion."""
    rng = np.random.default_rng(seed)
    for i in range(count):
        steps = rng.choice([100, 120, 150, 200, 250, 300, 400, 500, 600, 800, 1000])
        frequency = 1.0 / (steps * DT) if i % 2 == 0 else rng.uniform(1.0, 12.0)
        vertical = (round(rng.uniform(3.0, 12.0), 3), round(rng.uniform(0.05, 0.3), 3)) if i % 4 >= 2 else None
        law = ("coulomb", "paper", "speed")[i % 3]
        yield law, float(frequency), round(rng.uniform(0.16, 0.8), 3), vertical


@pytest.mark.parametrize(("text", "millimetres"), [("10Hz,0.565g,cycles=100", 1.717), ("5Hz,0.4g,cycles=60", 3.632)])
def test_a_block_does_not_walk_to_one_side_where_a_period_is_a_whole_number_of_steps(text, millimetres):
    slip = replay(low(coulomb("block")), f"sine:{text}").record["slip_x"]
    assert np.abs(slip).max() * 1e3 == pytest.approx(millimetres, rel=0.005)


@pytest.mark.parametrize("case", list(drawn(8, seed=51)), ids=str)
def test_slip_of_a_symmetric_motion_is_that_of_an_integration_from_event_to_event(case):
    largest, walk, _ = compared(*case, cycles=20)
    assert abs(largest) < 0.005
    assert abs(walk) < 1e-4


@pytest.mark.long
def test_fifty_symmetric_motions_neither_err_nor_walk():
    found = [(case, *compared(*case, cycles=30)[:2]) for case in drawn(50, seed=2026)]
    assert [f for f in found if abs(f[1]) > 0.005] == []
    assert [f for f in found if abs(f[2]) > 1e-4] == []


def test_the_middle_of_a_steady_slip_stays_for_as_long_as_it_is_shaken():
    # A table that the girder turns by a millionth lets it slide down: over minutes that is seen.
    record = replay(coulomb("block"), "sine:2Hz,0.436g,cycles=120").record
    slip = record["slip_x"]
    period = round(0.5 / record.dt)
    cycles = slip[10 * period : 110 * period].reshape(100, period)
    middle = (cycles.max(axis=1) + cycles.min(axis=1)) / 2.0
    assert np.ptp(middle) < 100 * 1e-4 * np.ptp(slip) / 2.0
    assert np.abs(record["table_dz"]).max() < 1e-12


def test_both_engines_turn_friction_round_alike():
    motion = sampled("sine:7Hz,0.4g,cycles=9,vertical=5Hz,0.2g", DT)[:1200]
    compiled, python = (shaken(base_model("bridge1"), motion, engine=engine) for engine in ("compiled", "python"))
    for name, values in compiled.record.channels.items():
        assert python.record[name] == pytest.approx(values, rel=1e-9, abs=1e-9 * max(1.0, np.abs(values).max())), name


def test_friction_and_acceleration_balance_in_the_very_step_in_which_it_turns_round():
    record = shaken(coulomb("block"), sampled("sine:7Hz,0.4g,cycles=12", DT)).record
    friction = sum(record[f"pad_{pad}_Fx"] for pad in "ABCD")
    turning = np.abs(np.diff(friction, prepend=0.0)) > 0.1 * friction.max()
    assert turning.sum() > 20
    left = (1e4 * record["girder_ax"] + friction)[turning]
    assert np.abs(left).max() < 1e-3 * friction.max()


def test_motion_at_an_angle_is_the_same_as_along_x():
    along = sampled("sine:7Hz,0.4g,cycles=12", DT)
    model = low(coulomb("block"))
    straight = shaken(model, along).record["slip_x"]
    turned = along.copy()
    turned[:, 0], turned[:, 1] = along[:, 0] * np.cos(0.5), along[:, 0] * np.sin(0.5)
    record = shaken(model, turned).record
    slip = record["slip_x"] * np.cos(0.5) + record["slip_y"] * np.sin(0.5)
    assert slip == pytest.approx(straight, abs=2e-3 * np.ptp(straight))


def test_a_step_too_coarse_for_a_law_is_told_with_one_that_would_do():
    steep = low(base_model("block", ("shear_rate",))).setting("shear_rate", rate=1000.0)
    with pytest.warns(SlipwiseWarning, match=r"friction changes more .* a step of 0\.2 ms would do"):
        replay(steep, "sine:6.667Hz,0.5g,cycles=12")


def test_a_motion_of_two_samples_is_told_to_be_too_short(tmp_path):
    path = tmp_path / "two.csv"
    path.write_text("time [s],ax [m/s^2]\n0,0\n0.02,3\n")
    with pytest.warns(SlipwiseWarning, match="lacks 4.2% of the input, over 41 steps"):
        replay("block", path)
