"""A record made from simple kinematics: slip is given, forces follow from the paper's law, the table from balance."""

import numpy as np
import pytest

from slipwise.record import Record
from slipwise.view.geometry import RigGeometry

PLACES = ((1.5, 2.5), (-1.5, 2.5), (1.5, -2.5), (-1.5, -2.5))
GEOMETRY = RigGeometry(
    girder_size=(3.0, 5.0, 0.5),
    girder_centre_height=0.366,
    pad_places=PLACES,
    pad_radius=0.0215,
    buffer_places=((0.0, 1.5), (0.0, -1.5)),
    table_size=(3.5, 5.5, 0.2),
    mass=10e3,
    gravity=9.80665,
)
AREA, STIFFNESS = np.pi * 0.0215**2, 3.4612e6


def friction(load: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """Give eq. (7), exp(-kP), with a stick zone of 1 mm/s."""
    pressure = np.maximum(load, 0.0) / AREA
    shear = 1.379e6 * (1 - np.exp(-19.7 * np.abs(speed))) * (1 - np.exp(-0.102e-6 * pressure)) + 0.046 * pressure
    return AREA * shear * np.tanh(speed / 1e-3)


def displacement(acceleration: np.ndarray, dt: float) -> np.ndarray:
    """Integrate twice in the frequency domain, without what is slower than 0.5 Hz."""
    omega = 2 * np.pi * np.fft.rfftfreq(len(acceleration), dt)
    spectrum = np.fft.rfft(acceleration)
    keep = omega > np.pi
    return np.fft.irfft(np.where(keep, -spectrum / np.where(keep, omega, 1.0) ** 2, 0.0), len(acceleration))


def make_record(seconds: float = 8.0, dt: float = 0.005, drop: float = 11.5, seed: int = 1) -> Record:
    """Give a replay-like record; `drop` [m/s^2] is the strongest downward pulse, above g it lifts every pad."""
    time = np.arange(round(seconds / dt)) * dt
    rng = np.random.default_rng(seed)
    envelope = np.exp(-(((time - 0.45 * seconds) / (0.22 * seconds)) ** 2)) * np.clip((time - 0.4) / 0.2, 0, 1)
    slip, across = np.zeros_like(time), np.zeros_like(time)
    for frequency, size in ((1.6, 0.012), (2.3, 0.009), (3.1, 0.006)):
        slip += size * envelope * np.sin(2 * np.pi * frequency * time + rng.uniform(0, 6))
        across += 0.15 * size * envelope * np.sin(2 * np.pi * frequency * time + rng.uniform(0, 6))
    vx, vy = np.gradient(slip, dt), np.gradient(across, dt)
    az = 2.5 * envelope * np.sin(2 * np.pi * 6.0 * time)
    for pulse in (0.42, 0.55):
        az -= drop * np.exp(-(((time - pulse * seconds) / 0.03) ** 2))
    speed = np.hypot(vx, vy) + 1e-12
    loads = np.tile(GEOMETRY.pad_load, (len(time), 4))
    for _ in range(3):
        size = friction(loads, speed[:, None])
        ax = -(np.sum(size, axis=1) * vx / speed + STIFFNESS * slip) / GEOMETRY.mass
        tilt = GEOMETRY.mass * (slip * (9.80665 + az) - ax * 0.366) / 1.5 / 4
        loads = np.maximum(2500 * (9.80665 + az)[:, None] + np.outer(tilt, [1, -1, 1, -1]), 0.0)
    channels = {"girder_ax": ax, "girder_ay": np.gradient(vy, dt), "girder_az": az}
    channels["table_ax"] = ax - np.gradient(vx, dt)
    channels["table_ay"], channels["table_az"] = 0.0 * time, az
    for axis in "xyz":
        channels[f"table_d{axis}"] = displacement(channels[f"table_a{axis}"], dt)
    channels |= {"slip_x": slip, "slip_y": across, "slip_vx": vx, "slip_vy": vy}
    channels |= {"yaw": 2e-3 * slip / 0.02, "pitch": tilt / 1e9, "roll": 0.0 * time}
    channels["heave"] = np.where(loads.sum(axis=1) > 0, -loads.sum(axis=1) / 6e8, 2e-3)
    for i, pad in enumerate("ABCD"):
        channels[f"pad_{pad}_N"] = loads[:, i]
        channels[f"pad_{pad}_Fx"] = size[:, i] * vx / speed
        channels[f"pad_{pad}_Fy"] = size[:, i] * vy / speed
    for buffer in "12":
        channels[f"buffer_{buffer}_Fx"] = 0.5 * STIFFNESS * slip
        channels[f"buffer_{buffer}_Fy"] = 0.5 * STIFFNESS * across
    return Record(time, channels, {"rig": "bridge1", "motion": "synthetic"})


@pytest.fixture(scope="session")
def record() -> Record:
    return make_record()


@pytest.fixture(scope="session")
def geometry() -> RigGeometry:
    return GEOMETRY
