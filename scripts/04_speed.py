"""How long a step takes: bare MuJoCo, with the compiled law, with the law in Python, and many at once.

    python scripts/04_speed.py [--quick] [--out out/speed]

Runs of each kind take turns, so that a busy machine slows all of them alike; medians are shown. If OpenSeesPy happens
to be installed, one of its sliders on the same motion stands beside them.
"""

import argparse
import importlib
import statistics
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from mujoco.batch import Batch

from slipwise.model import Model, base_model, use
from slipwise.record import write_json
from slipwise.rig import build
from slipwise.simulation.kernel import installed, kernel
from slipwise.simulation.steps import model_for_kernel, numbers_for, start_state
from slipwise.simulation.substeps import run

DT = 5e-4
FIVE = ("breakaway", "run_in", "heating", "buffer_damping", "key_clearance")


def motions(count: int, steps: int) -> np.ndarray:
    """Different earthquakes-like table motions, (count, steps, 4) [m/s^2]."""
    rng = np.random.default_rng(1)
    t = np.arange(steps) * DT
    out = np.zeros((count, steps, 4))
    for i in range(count):
        for axis, size in ((0, 2.0), (2, 0.8)):
            phases, frequencies = rng.uniform(0, 2 * np.pi, 12), rng.uniform(0.8, 8.0, 12)
            out[i, :, axis] = size * np.sin(2 * np.pi * frequencies * t[:, None] + phases).sum(axis=1) / 2.0
    return out


class Rigged:
    """A model ready to be stepped in several ways."""

    def __init__(self, model: Model, engine: str) -> None:
        self.law = kernel(engine)
        self.rig = build(model.built_specimen(), DT, self.law.layout.size(model.built_specimen()))
        self.numbers = numbers_for(self.law, self.rig, model, DT)

    def batch(self, count: int, threads: int, control: np.ndarray, *, law: bool = True) -> float:
        """Step `count` simulations at once; with the law or bare. Gives microseconds per simulation step."""
        batch = Batch(model_for_kernel(self.rig, DT) if law else self.rig.model, count, threads)
        batch.bind("qpos")[:] = start_state(self.rig)
        batch.bind("userdata")[:] = self.numbers
        began = time.perf_counter()
        if law:
            with installed(self.law):
                batch.rollout(control.shape[1], control, record=("sensordata",))
        else:
            batch.rollout(control.shape[1], control, record=("sensordata",))
        return 1e6 * (time.perf_counter() - began) / control[:, :, 0].size

    def python(self, control: np.ndarray) -> float:
        """Step one simulation with the law in Python."""
        numbers = self.numbers.copy()
        began = time.perf_counter()
        run(self.law, self.rig, numbers, control[0], lambda data, command, step: True)
        return 1e6 * (time.perf_counter() - began) / control.shape[1]


def opensees(control: np.ndarray) -> float:
    """One flat slider in OpenSeesPy under the same motion, in microseconds per step; NaN where it is not installed."""
    try:
        ops: Any = importlib.import_module("openseespy.opensees")
    except (ImportError, RuntimeError):  # not there, or without the system library that it needs
        return float("nan")
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(1, 0.0, 0.0)
    ops.node(2, 0.0, 0.0)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 0, 0, 1)
    ops.mass(2, 1e4, 1e4, 1.0)
    ops.frictionModel("VelDependent", 1, 0.046, 0.113085, 19.7)
    ops.uniaxialMaterial("Elastic", 1, 1e10)
    ops.uniaxialMaterial("Elastic", 2, 1e10)
    ops.element("flatSliderBearing", 1, 1, 2, 1, 1e9, "-P", 1, "-Mz", 2, "-orient", 0, 1, 0, -1, 0, 0)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, -98066.5, 0.0)
    ops.timeSeries("Path", 2, "-dt", DT, "-values", *control[0, :, 0])
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
    for command in (("constraints", "Plain"), ("numberer", "RCM"), ("system", "BandGeneral"), ("algorithm", "Newton")):
        getattr(ops, command[0])(*command[1:])
    ops.test("NormDispIncr", 1e-10, 30)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    began = time.perf_counter()
    for _ in range(control.shape[1]):
        ops.analyze(1, DT)
    return 1e6 * (time.perf_counter() - began) / control.shape[1]


def main() -> None:
    """Measure, print, keep."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/speed"))
    parser.add_argument("--quick", action="store_true", help="short runs, three turns")
    chosen = parser.parse_args()
    steps, turns = (4000, 3) if chosen.quick else (20000, 9)
    one, eight = motions(1, steps), motions(8, steps)
    base = base_model("bridge1")
    paper, slow = Rigged(base, "compiled"), Rigged(base, "python")
    five = Rigged(base.adding(*(use(name) for name in FIVE)), "compiled")
    ways: dict[str, Callable[[], float]] = {
        "bare mj_step, no law": lambda: paper.batch(1, 1, one, law=False),
        "compiled law, paper": lambda: paper.batch(1, 1, one),
        "compiled law, paper and five effects": lambda: five.batch(1, 1, one),
        "Python law": lambda: slow.python(one[:, : steps // 4]),
        "eight motions, compiled, one thread": lambda: paper.batch(8, 1, eight),
        "eight motions, compiled, two threads": lambda: paper.batch(8, 2, eight),
        "OpenSeesPy flat slider, one motion": lambda: opensees(one),
    }
    for way in ways.values():
        way()
    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(turns):
        for name, way in ways.items():
            times[name].append(way())
    table = {name: statistics.median(values) for name, values in times.items()}
    bare, one_thread = times["bare mj_step, no law"], times["eight motions, compiled, one thread"]
    print(f"MuJoCo {mujoco.__version__}, step {DT * 1e3:g} ms, {steps} steps, medians of {turns} turns")
    for name, value in table.items():
        if np.isnan(value):
            print(f"{name:40s}  not installed")
            continue
        ratio = statistics.median(a / b for a, b in zip(times[name], bare, strict=True))
        print(f"{name:40s} {value:8.2f} us a step  {ratio:6.3f} of the bare step")
    gain = statistics.median(
        a / b for a, b in zip(one_thread, times["eight motions, compiled, two threads"], strict=True)
    )
    print(f"two threads step {gain:.2f} times as many as one")
    kept = {name: None if np.isnan(value) else value for name, value in table.items()}
    write_json(chosen.out / "speed.json", {"microseconds_per_step": kept, "two_threads_over_one": gain})


if __name__ == "__main__":
    main()
