"""Tests of single bearings under a load that is held: `make_bearing(folder, kind, seed)` writes one, with its answer.

An actuator prescribes the slip, another holds the vertical load, and their gauges are read as a laboratory reads them:
noise of every gauge, a zero that is a little off, a load that follows its set value with a slow error of its own. Force
follows from equilibrium on the face, in closed form: nothing here is the library's.

    pendulum    F = N (x/sqrt(R^2 - x^2) + m) / (1 - m x/sqrt(R^2 - x^2)),      m = mu(V) sign(v)
    rim         F = mu(V) N sign(v) + k (|x| - g) sign(x) beyond the gap g
    spring      F = k x + k_w (|x| - g) sign(x) beyond the gap g, without any friction
    flat        F = mu(V) N sign(v)

with mu(V) = mu_fast - (mu_fast - mu_slow) exp(-a V).

Source: Zayas, Low, Mahin (1990), Earthquake Spectra 6(2); Constantinou, Mokha, Reinhorn (1990), Journal of Structural
Engineering 116(2), for mu(V) and 20 to 100 s/m; noise and errors of control assumed: 0.05 to 0.4 % of what a gauge
reads.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise_benchmarks.slider_friction import FRICTION, Drive

Array = NDArray[np.float64]
KINDS: tuple[str, ...] = ("pendulum", "spring", "rim", "flat")
#: What a verdict may name.
MAY_NAME: dict[str, frozenset[str]] = {
    "pendulum": frozenset({"slide_curvature"}),
    "spring": frozenset({"slide_curvature", "restrainer"}),
    "rim": frozenset({"restrainer"}),
    "flat": frozenset(),
}
#: Mean pressure on a pad [Pa], and how real contact saturates with it [1/Pa]: that of the paper.
PRESSURE, SATURATION = 30.0e6, 0.102e-6
#: Slip over which friction turns round, over the stroke: hard faces on a stiff machine [1].
TURNS = 2e-5
#: Steps of the path between two samples.
FINE = 40
#: Samples of a record at most: a slow test is logged slowly.
_SAMPLES = 4000


Force = Callable[["Bearing", Drive], Array]


@dataclass(frozen=True)
class Bearing:
    """What a seed stands for.

    Attributes:
        kind: one of `KINDS`.
        load: that is held [N].
        stroke: largest slip to either side [m].
        mu_fast, mu_slow: coefficients of friction far above and at no speed [1].
        rate: a, how soon speed adds friction [s/m].
        radius: of the sphere [m]; infinite for a flat face.
        stiffness: of a spring through the middle [N/m].
        wall: stiffness beyond the gap [N/m].
        gap: slip at which the wall is met [m].
        step: of the logger in a fast test [s].
        noise: of force, load and slip over what they read at most [1].
        control: slow error of the load over the load [1].
        zero: of the force gauge [N].
        turning: slip over which friction turns round, over the stroke [1].
        varying: share by which a programme swings the load about its mean [1]; 0: it is held.
        hidden: (effect, size) of what friction has beside mu(V); see `slipwise_benchmarks.slider_friction`.
    """

    kind: str
    load: float
    stroke: float
    mu_fast: float
    mu_slow: float
    rate: float
    radius: float
    stiffness: float
    wall: float
    gap: float
    step: float
    noise: tuple[float, float, float]
    control: float
    zero: float
    turning: float = TURNS
    varying: float = 0.0
    hidden: tuple[tuple[str, float], ...] = ()

    def force(self, drive: Drive) -> Array:
        """Give the force along the table [N] in a test."""
        load, slip, velocity = drive.load, drive.slip, drive.velocity
        turned = _turned(slip, self.turning * self.stroke)
        friction = self.mu_fast - (self.mu_fast - self.mu_slow) * np.exp(-self.rate * np.abs(velocity))
        if self.varying:  # the sheared part goes with the real area of contact, which saturates
            area = -np.expm1(-SATURATION * PRESSURE * load / self.load) / -np.expm1(-SATURATION * PRESSURE)
            friction = self.mu_slow + (friction - self.mu_slow) * area * self.load / load
        for name, size in self.hidden:
            friction = FRICTION[name](friction, drive, size)
        slope = slip / np.sqrt(self.radius**2 - slip**2) if np.isfinite(self.radius) else np.zeros_like(slip)
        share = friction * turned
        beyond = np.sign(slip) * np.maximum(np.abs(slip) - self.gap, 0.0)
        return load * (slope + share) / (1.0 - share * slope) + self.stiffness * slip + self.wall * beyond


def draw_bearing(kind: str, seed: int) -> Bearing:
    """Draw a bearing and its laboratory."""
    rng = np.random.default_rng([seed, 5, KINDS.index(kind)])
    load = float(np.exp(rng.uniform(np.log(100e3), np.log(5e6))))
    radius = float(rng.uniform(0.8, 6.0)) if kind == "pendulum" else np.inf
    stroke = float(rng.uniform(0.05, 0.25)) * min(radius, 1.5)
    mu_fast = float(rng.uniform(0.02, 0.12))
    mu_slow = mu_fast * float(rng.uniform(0.3, 0.8))
    stiffness = wall = 0.0
    gap = np.inf
    if kind in ("rim", "spring"):
        gap = stroke * float(rng.uniform(0.3, 0.8))
        wall = load / stroke * float(rng.uniform(0.1, 0.6))
    if kind == "spring":
        stiffness = wall * float(rng.uniform(0.1, 0.5))
        mu_fast = mu_slow = 0.0
    noise = tuple(float(x) for x in np.exp(rng.uniform(np.log(5e-4), np.log(3e-3), 3)) * (1.0, 1.0, 0.1))
    return Bearing(
        kind=kind,
        load=load,
        stroke=stroke,
        mu_fast=mu_fast,
        mu_slow=mu_slow,
        rate=float(rng.uniform(20.0, 100.0)),
        radius=radius,
        stiffness=stiffness,
        wall=wall,
        gap=gap,
        step=float(rng.choice([0.005, 0.01, 0.02, 0.05])),
        noise=(noise[0], noise[1], noise[2]),
        control=float(np.exp(rng.uniform(np.log(3e-4), np.log(4e-3)))),
        zero=load * max(mu_fast, 0.02) * float(rng.uniform(-0.02, 0.02)),
    )


def _path(rng: np.random.Generator, stroke: float, period: float, step: float) -> tuple[Array, Array]:
    """Give time [s] and slip [m] of three to five cycles, sines or triangles with round corners, eased in and out."""
    whole = int(rng.integers(3, 6)) * period
    time = np.arange(0.0, whole, max(step, whole / _SAMPLES) / FINE)
    phase = 2.0 * np.pi * time / period
    wave = np.sin(phase) if rng.uniform() < 0.6 else np.arcsin(0.98 * np.sin(phase)) / np.arcsin(0.98)
    ends = np.minimum(time, time[-1] - time) / (0.5 * period)
    eased = np.where(ends < 1.0, 0.5 - 0.5 * np.cos(np.pi * np.clip(ends, 0.0, 1.0)), 1.0)
    return time, stroke * eased * wave


def _turned(slip: Array, length: float) -> Array:
    """Give friction over its bound [1], which turns round over a length of slip: dz/dx = (1 - z sign v) / u."""
    out = np.empty_like(slip)
    share, before = 0.0, slip[0]
    for i, now in enumerate(slip.tolist()):
        move = now - before
        if move:
            way = 1.0 if move > 0.0 else -1.0
            share = way + (share - way) * np.exp(-abs(move) / length)
        out[i], before = share, now
    return out


def drive_of(bearing: Bearing, rng: np.random.Generator, share: float, speed: float) -> Drive:
    """Draw what the machine does in a test, at `FINE` steps for a sample.

    Args:
        bearing: that is tested.
        rng: generator.
        share: of the stroke [1].
        speed: largest of a sine [m/s].
    """
    stroke = share * bearing.stroke
    time, slip = _path(rng, stroke, 2.0 * np.pi * stroke / speed, bearing.step)
    velocity = np.gradient(slip, time)
    wave = np.sin(2.0 * np.pi * time / time[-1] * rng.uniform(1.0, 12.0) + rng.uniform(0.0, 6.0))
    load = bearing.load * (1.0 + np.sqrt(2.0) * bearing.control * wave)
    if bearing.varying:
        swing = np.sin(2.0 * np.pi * time / time[-1] * rng.uniform(2.0, 9.0) + rng.uniform(0.0, 6.0))
        load = load * (1.0 + bearing.varying * swing)
    return Drive(time, slip, velocity, load)


def record(bearing: Bearing, rng: np.random.Generator, drive: Drive, force_of: Force = Bearing.force) -> Array:
    """Give time [s], slip [mm], load [kN], force [kN] as they are read, (n, 4).

    Args:
        bearing: that is tested.
        rng: of the noise.
        drive: what the machine does.
        force_of: what gives the force of a bearing [N]: the closed form, or the library.
    """
    time, slip, load, force = drive.time, drive.slip, drive.load, force_of(bearing, drive)
    taken = slice(None, None, FINE)
    true = np.stack([slip, load, force + bearing.zero], axis=1)[taken]
    of_force, of_load, of_slip = bearing.noise
    sizes = np.array([of_slip * bearing.stroke, of_load * bearing.load, of_force * np.abs(force).max()])
    read = true + sizes * rng.standard_normal(true.shape)
    return np.column_stack([time[taken], read * (1e3, 1e-3, 1e-3)])


def make_bearing(folder: Path, kind: str, seed: int) -> dict[str, Any]:
    """Write campaign.toml and three CSV files, and give the answer as plain data.

    Args:
        folder: of the campaign; its name becomes the campaign's.
        kind: one of `KINDS`.
        seed: of everything random.
    """
    bearing = draw_bearing(kind, seed)
    rng = np.random.default_rng([seed, 6, KINDS.index(kind)])
    fast = float(np.exp(rng.uniform(np.log(0.05), np.log(0.6))))
    runs = {"slow": ("fit", 1.0, 0.25 * fast), "fast": ("fit", 0.9, fast), "other": ("holdout", 0.7, 0.5 * fast)}
    tables = {}
    for name, (_, share, speed) in runs.items():
        tables[name] = record(bearing, rng, drive_of(bearing, rng, share, speed))
    write_bearing(folder, bearing, {name: role for name, (role, *_) in runs.items()}, tables)
    return {"kind": kind, "seed": seed, "may_name": sorted(MAY_NAME[kind]), **_as_dict(bearing)}


def _as_dict(bearing: Bearing) -> dict[str, Any]:
    return {name: value for name, value in vars(bearing).items() if name not in ("turning", "varying", "hidden")}


def write_bearing(folder: Path, bearing: Bearing, roles: Mapping[str, str], tables: Mapping[str, Array]) -> None:
    """Write campaign.toml and a CSV file for each run.

    Args:
        folder: of the campaign; its name becomes the campaign's.
        bearing: that is tested.
        roles: run -> "fit" or "holdout".
        tables: run -> what `record` gives.
    """
    folder.mkdir(parents=True, exist_ok=True)
    radius = np.sqrt(bearing.load / (np.pi * PRESSURE))
    text = f'name = "{folder.name}"\nrig = "pad"\n\n[specimen]\npad_radius = "{1e3 * radius:.4g} mm"\n\n'
    text += '[logger]\nlowpass = "none"\n'
    for name, role in roles.items():
        rows = "\n".join(",".join(f"{value:.6g}" for value in row) for row in tables[name].tolist())
        header = "time [s],slip_x [mm],pad_A_N [kN],pad_A_Fx [kN]"
        (folder / f"{name}.csv").write_text(f"{header}\n{rows}\n", encoding="utf-8")
        text += f'\n[[run]]\nfile = "{name}.csv"\nrole = "{role}"\n'
    (folder / "campaign.toml").write_text(text, encoding="utf-8")


def is_right(truth: Mapping[str, Any], said: Mapping[str, Any]) -> bool:
    """Tell whether a verdict, as diagnosis.json holds it, is right: what is there is named, and nothing else.

    A spring without friction is nothing that a bearing should have: it may be unknown, but no friction may be named.
    """
    named, kind = set(said["effects"]), truth["kind"]
    if kind == "flat":
        return said["verdict"] == "complete"
    if kind == "spring":
        return said["verdict"] == "unknown" or (bool(named) and named <= MAY_NAME[kind])
    return said["verdict"] == "named" and named == MAY_NAME[kind]


def radius_error(truth: Mapping[str, Any], said: Mapping[str, Any]) -> float:
    """Give by which share the radius of a pendulum's sphere that a verdict gives is off; NaN where it gives none."""
    sizes = said["candidates"][0]["parameters"] if said.get("candidates") else {}
    found = sizes.get("slide_curvature.curvature")
    return (
        float("nan") if found is None or truth["kind"] != "pendulum" else 1.0 / found["value"] / truth["radius"] - 1.0
    )


def bearing_plan(count: int, seed: int) -> dict[str, tuple[str, int]]:
    """Give name -> kind and seed: so many pendulums, and three of every other kind for ten of them."""
    of_kind = {kind: count if kind == "pendulum" else max(1, round(0.3 * count)) for kind in KINDS}
    return {f"{kind}{s:05d}": (kind, s) for kind, n in of_kind.items() for s in range(seed, seed + n)}
