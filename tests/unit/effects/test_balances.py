"""What effects add to the girder's balances, against a simulation that knows nothing of `balance` hooks."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from shaking import coulomb, shaken
from slipwise.effects import BalanceStates
from slipwise.model import Model, base_model, use
from slipwise.record import Record
from slipwise.rig.load_basis import basis_of
from slipwise.rig.load_modes import load_modes
from slipwise.signals.ends import in_frequency
from slipwise.signals.oscillator import oscillator

DT = 5e-4
G = 9.80665


@cache
def shaking() -> np.ndarray:
    """Two horizontal frequencies and a vertical one, in and out over half a second."""
    time = DT * np.arange(6000)
    ramp = np.clip(time / 0.5, 0.0, 1.0) * np.clip((3.0 - time) / 0.5, 0.0, 1.0)
    out = np.zeros((len(time), 3))
    out[:, 0] = ramp * (3.0 * np.sin(2 * np.pi * 2.2 * time) + 2.0 * np.sin(2 * np.pi * 4.7 * time + 1.0))
    out[:, 2] = ramp * 2.0 * np.sin(2 * np.pi * 6.0 * time)
    return out


def states(model: Model, record: Record) -> BalanceStates:
    def three(name: str, axes: str = "xyz") -> np.ndarray:
        return np.stack([record[name.format(axis)] for axis in axes], axis=1)

    buffers = np.stack([three(f"buffer_{b}_F{{}}", "xy") for b in "12"], axis=1)
    return BalanceStates(
        time=record.time,
        specimen=model.built_specimen(),
        slip=three("slip_{}", "xy"),
        velocity=three("slip_v{}", "xy"),
        load=record.stacked("pad_{}_N"),
        pad_force=np.stack([three(f"pad_{p}_F{{}}", "xy") for p in "ABCD"], axis=1),
        girder_acceleration=three("girder_a{}"),
        table_acceleration=three("table_a{}"),
        buffer_force=buffers.sum(axis=1),
        buffer_size=np.linalg.norm(buffers, axis=2),
        heave_rate=np.gradient(record["heave"], record.dt),
    )


def _through_pitch(moment: np.ndarray, model: Model) -> np.ndarray:
    """Pass a moment through the girder's pitch on its pads; without it 390 N of ringing are left."""
    specimen = model.specimen
    w = np.sqrt(4 * specimen.pad_stiffness * specimen.half_spacing[0] ** 2 / specimen.inertia[1])
    spring = lambda f: 1.0 + 2j * np.pi * f * specimen.pad_damping / specimen.pad_stiffness  # noqa: E731
    return in_frequency(moment, DT, lambda f: spring(f) / (spring(f) - (2 * np.pi * f / w) ** 2), 500)


def open_balances(model: Model) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """What a rigid girder's balances leave open without hooks, and what the hooks say of it."""
    record = shaken(model, shaking(), dt=DT).record
    seen = states(model, record)
    specimen, modes = seen.specimen, load_modes(seen.load, basis_of(seen.specimen))
    (half_x, half_y), height = specimen.half_spacing, specimen.centre_height
    acceleration, total = seen.girder_acceleration, seen.load.sum(axis=1)
    friction, key = seen.pad_force[:, :, 0].sum(axis=1), seen.buffer_force
    turning = height * friction + (height - specimen.buffer_height) * key[:, 0] + seen.slip[:, 0] * total
    across = specimen.mass * acceleration[:, 1] * height + key[:, 1] * specimen.buffer_height
    left = {
        "heave": modes.heave - specimen.mass * (G + acceleration[:, 2]),
        "pitch": modes.pitch - _through_pitch(turning, model) / half_x,
        "roll": modes.roll - (seen.slip[:, 1] * total - across) / half_y,
        "warp": modes.warp[:, 0],
        "girder": -(specimen.mass * acceleration[:, 0] + friction + key[:, 0]),
    }
    lean = height * np.gradient(np.gradient(record["pitch"], DT), DT)
    slipping = np.gradient(record["slip_vx"], DT)
    left["motion"] = specimen.mass * (acceleration[:, 0] - record["table_ax"] - slipping - lean)
    predicted: dict[str, np.ndarray] = {}
    for entry in model.with_hook("balance"):
        predicted |= entry.effect.hooks["balance"](seen, target=entry.target, **entry.values)
    if "motion" in predicted:
        predicted["motion"] = specimen.mass * predicted["motion"]
    return left, predicted


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


#: effect -> largest share of what it leaves open in each balance that is still open with its hook.
CLOSED = {
    "uneven_seating": {"warp": 1e-3},
    "mass_eccentricity": {"pitch": 0.06, "roll": 0.02},
    "key_friction": {"heave": 0.02},
    "girder_bending": {"heave": 0.01},
    "guide_drag": {"girder": 0.02},
    "table_pitch": {"pitch": 0.06, "girder": 0.03, "motion": 0.2},
}


@cache
def base() -> dict[str, np.ndarray]:
    return open_balances(base_model("bridge1"))[0]


def test_the_balances_close_without_effects() -> None:
    left = base()
    assert rms(left["heave"]) < 1.0 and rms(left["warp"]) < 1e-6 and rms(left["roll"]) < 1e-3
    assert rms(left["girder"]) < 3.0 and rms(left["pitch"]) < 80.0


@pytest.mark.parametrize("name", CLOSED)
def test_what_a_hook_adds_closes_the_balances_again(name: str) -> None:
    values = {"along": 0.02, "across": 0.03} if name == "mass_eccentricity" else {}
    left, predicted = open_balances(base_model("bridge1").adding(use(name, **values)))
    assert {balance for balance, more in predicted.items() if rms(more) > 1e-6} == set(CLOSED[name])
    for balance, share in CLOSED[name].items():
        opened, still = rms(left[balance]), rms(left[balance] - predicted[balance])
        assert opened > 10.0, "it must be seen at all"
        assert still < share * opened, f"{balance}: {still:.1f} of {opened:.1f} N"


def test_keys_that_are_pressed_unlike_tip_the_girder() -> None:
    both = base_model("bridge1").adding(use("key_friction")).adding(use("buffer_mismatch", difference=0.3))
    left, predicted = open_balances(both)
    assert rms(left["roll"]) > 50.0
    assert rms(left["roll"] - predicted["roll"]) < 0.1 * rms(left["roll"])


def test_keys_above_the_sliding_plane_turn_the_girder_by_their_force() -> None:
    """docs/theory.md, section 1.2: a buffer at height z_b adds dN = -F_b z_b / (2 b) per pad."""
    left, _ = open_balances(base_model("bridge1").adding(use("buffer_height", height=0.2)))
    assert rms(left["pitch"]) < 1.1 * rms(base()["pitch"])
    record = shaken(base_model("bridge1").adding(use("buffer_height", height=0.366)), shaking(), dt=DT).record
    plain = shaken(base_model("bridge1"), shaking(), dt=DT).record
    swing = [
        np.std(load_modes(r.stacked("pad_{}_N"), basis_of(base_model("bridge1").specimen)).pitch)
        for r in (record, plain)
    ]
    assert swing[0] < 0.7 * swing[1], "at the height of the centre of gravity only friction loads the pads"


def test_the_bending_girder_is_two_masses_on_springs() -> None:
    """m_r z'' = -k z - c z' + k_e q + c_e q', m_e (z'' + q'') = -k_e q - c_e q' in a table frame that moves by a_z."""
    frequency, share, damping = 12.0, 0.4, 0.03
    model = coulomb("block").adding(use("girder_bending", share=share, frequency=frequency, damping=damping))
    specimen = model.specimen
    dt = 2.5e-4
    time = dt * np.arange(6000)
    shake = np.zeros((len(time), 3))
    shake[:, 2] = np.clip(time / 0.3, 0.0, 1.0) * 1.5 * np.sin(2 * np.pi * 9.0 * time)
    record = shaken(model, shake, dt=dt).record
    mass, k, c = specimen.mass, 4 * specimen.pad_stiffness, 4 * specimen.pad_damping
    m_e, w = share * mass, 2 * np.pi * frequency
    k_e, c_e = m_e * w**2, 2 * damping * w * m_e

    def equation(t: float, y: np.ndarray) -> list[float]:
        z, q, dz, dq = y
        up = min(t / 0.3, 1.0) * 1.5 * np.sin(2 * np.pi * 9.0 * t)
        ddz = (-k * z - c * dz + k_e * q + c_e * dq) / (mass - m_e) - up
        return [dz, dq, ddz, -(k_e * q + c_e * dq) / m_e - up - ddz]

    exact = solve_ivp(equation, (0.0, time[-1]), [0.0] * 4, "DOP853", time, rtol=1e-9, atol=1e-13, max_step=2e-3).y
    load = mass * G - k * exact[0] - c * exact[2]
    ours = record.stacked("pad_{}_N").sum(axis=1)
    assert rms(load - mass * G) > 3e3, "it must ring"
    assert rms(ours - load) < 0.01 * rms(load - mass * G)


def test_a_gauge_in_the_middle_of_a_bending_girder_is_read_as_such() -> None:
    """It reads a_z + (4/pi) q''; from that the balance must find the same load as a gauge over the pads does."""
    share, frequency, damping = 0.4, 12.0, 0.03
    model = base_model("bridge1").adding(use("girder_bending", share=share, frequency=frequency, damping=damping))
    record = shaken(model, shaking(), dt=DT).record
    swing = oscillator(-record["girder_az"], DT, frequency, damping, 2)
    total = record.stacked("pad_{}_N").sum(axis=1)
    middle = record.replaced(girder_az=record["girder_az"] + 4.0 / np.pi * swing)
    left = {}
    for midspan in (0.0, 1.0):
        seen = states(model, middle)
        values = {"share": share, "frequency": frequency, "damping": damping, "midspan": midspan}
        more = model["girder_bending"].effect.hooks["balance"](states=seen, **values)["heave"]
        left[midspan] = rms(total - model.specimen.mass * (G + middle["girder_az"]) - more)
    assert left[0.0] > 1e3, "it must matter"
    assert left[1.0] < 0.02 * left[0.0]


def test_a_girder_may_push_the_table_over() -> None:
    rocking = use("table_pitch", compliance=0.0, specimen=1.5e-4, frequency=14.0, damping=0.35)
    model = base_model("bridge1").adding(rocking)
    record = shaken(model, shaking(), dt=DT).record
    left, predicted = open_balances(model)
    turned = _through_pitch(predicted["pitch"], model)
    assert rms(left["pitch"] - turned) < 0.1 * rms(left["pitch"]) > 10.0
    w = 2.0 * np.pi * 14.0
    angle = oscillator(1.5e-4 * w**2 * record["girder_ax"], float(record.time[1] - record.time[0]), 14.0, 0.35, 0)
    assert rms(angle) > 2e-4, "it must be seen at all"
    assert rms(record["table_pitch"] - angle) < 0.02 * rms(angle)
