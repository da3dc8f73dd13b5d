"""Why the pads' friction is not MuJoCo's contact friction.

The girder of Bridge 1 is shaken by two horizontal sines and a vertical one. Three ways to make friction are held
against a reference: the same rig at a twentieth of the step. MuJoCo's contact model couples slip to lift: it lets the
pads chatter, whatever cone or step is chosen. A dry-friction constraint whose bound follows the pad's law does not.

    python scripts/02_why_not_contact_friction.py --out out/why [--quick]
"""

import argparse
from pathlib import Path

import mujoco
import numpy as np

from slipwise.model import base_model
from slipwise.record import write_json
from slipwise.rig import build
from slipwise.simulation.predict import predictor
from slipwise.simulation.simulator import simulate
from slipwise.view.figures.canvas import new_figure, save_figure

G = 9.80665


def motion(dt: float, seconds: float) -> np.ndarray:
    """Two horizontal sines and a 6 Hz vertical one, ramped in over a second; (n, 3) [m/s^2]."""
    t = np.arange(round(seconds / dt)) * dt
    ramp = np.clip(t, 0.0, 1.0)
    x = ramp * G * (0.2 * np.sin(2 * np.pi * 1.3 * t) + 0.2 * np.sin(2 * np.pi * 2.1 * t + 1.0))
    z = ramp * G * 0.2 * np.sin(2 * np.pi * 6.0 * t)
    return np.stack([x, np.zeros_like(t), z], axis=1)


def contact_friction(cone: str, dt: float, seconds: float, impratio: float) -> dict[str, np.ndarray]:
    """The same rig with MuJoCo's contact friction, its coefficient rewritten before every step."""
    model_of = base_model("bridge1")
    rig = build(model_of.specimen, dt, 1)
    model = rig.model
    model.opt.cone = getattr(mujoco.mjtCone, f"mjCONE_{cone.upper()}")
    model.opt.impratio = impratio
    for tendon in rig.tendons[:8]:
        model.tendon_frictionloss[tendon] = 1e-9
    pads = list(rig.pad_geoms)
    plates = [model.geom(f"plate_{p}").id for p in "ABCD"]
    model.geom_condim[pads + plates] = 3
    model.geom_solimp[pads + plates] = [0.9, 0.95, 0.001, 0.5, 2.0]  # MuJoCo's own defaults
    model.geom_solref[pads + plates] = [0.02, 1.0]
    law = predictor(model_of)
    data = mujoco.MjData(model)
    data.joint("girder_z").qpos[0] = -rig.sag
    command = motion(dt, seconds)
    load = np.full((1, 4), model_of.specimen.weight / 4)
    slip, loads, force = np.empty(len(command)), np.empty((len(command), 4)), np.empty(len(command))
    wrench = np.zeros(6)
    for i, acceleration in enumerate(command):
        velocity = np.zeros((1, 4, 2))
        velocity[0, :, 0] = data.ten_velocity[list(rig.tendons[:8:2])]
        # A pad in the air keeps the coefficient of a tenth of its rated load, or it would land without friction.
        pressed = np.maximum(np.repeat(load, 2, 0), 0.1 * model_of.specimen.weight / 4)
        bound = law.pads(np.array([0.0, dt]), pressed, np.repeat(velocity, 2, 0), np.zeros((2, 4, 2))).bound[0]
        mu = bound / pressed[0]
        for geoms in (pads, plates):
            model.geom_friction[geoms, 0] = np.clip(mu, 1e-3, 1.0)
        data.ctrl[:3] = acceleration
        mujoco.mj_step(model, data)
        load = np.zeros((1, 4))
        total = 0.0
        for c, contact in enumerate(data.contact):
            mujoco.mj_contactForce(model, data, c, wrench)
            pad = pads.index(contact.geom1) if contact.geom1 in pads else pads.index(contact.geom2)
            load[0, pad] += wrench[0]
            tangent = contact.frame.reshape(3, 3).T @ [0.0, wrench[1], wrench[2]]
            total += abs(tangent[0])
        slip[i] = data.joint("girder_x").qpos[0] - 0.366 * data.joint("girder_pitch").qpos[0]
        loads[i], force[i] = load[0], total
    return {"slip": slip, "load": loads[:, 0], "friction": force}


def constraint(dt: float, seconds: float) -> dict[str, np.ndarray]:
    """Slipwise's way."""
    record = simulate(base_model("bridge1"), motion(dt, seconds), dt=dt, output_dt=dt).record
    return {
        "slip": record["slip_x"],
        "load": record["pad_A_N"],
        "friction": np.abs(record.stacked("pad_{}_Fx")).sum(axis=1),
    }


def percent(found: dict[str, np.ndarray], truth: dict[str, np.ndarray], every: int) -> dict[str, float]:
    """Give the rms error over the rms of the signal's swing [%]."""
    out = {}
    for name, values in found.items():
        true = truth[name][::every][: len(values)]
        swing = true - (true.mean() if name == "load" else 0.0)
        out[name] = 100.0 * float(np.sqrt(np.mean((values[: len(true)] - true) ** 2) / np.mean(swing**2)))
    return out


def main() -> None:
    """Compare, print, draw."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("out/why"))
    parser.add_argument("--quick", action="store_true", help="two seconds instead of eight")
    chosen = parser.parse_args()
    seconds, dt = (2.0 if chosen.quick else 8.0), 5e-4
    fine = 20
    truth = constraint(dt / fine, seconds)
    ways = {
        "contact friction, pyramidal cone": contact_friction("pyramidal", dt, seconds, 1.0),
        "contact friction, elliptic cone, impratio 10": contact_friction("elliptic", dt, seconds, 10.0),
        "dry-friction constraint with the law's bound": constraint(dt, seconds),
    }
    errors = {name: percent(found, truth, fine) for name, found in ways.items()}
    for name, error in errors.items():
        print(f"{name:48s}" + "  ".join(f"{what} {value:7.2f} %" for what, value in error.items()))
    figure = new_figure(11.0, 8.0, "Load on pad A: MuJoCo's contact friction and the dry-friction constraint")
    axes = figure.subplots(len(ways), 1, sharex=True)
    t = np.arange(len(truth["load"])) * dt / fine
    for panel, (name, found) in zip(axes, ways.items(), strict=True):
        reference = f"reference, step {dt * 1e3 / fine:g} ms"
        panel.plot(t, truth["load"] / 1e3, lw=2.5, color="0.75", label=reference)
        own = np.arange(len(found["load"])) * dt
        panel.plot(own, found["load"] / 1e3, lw=0.7, color="#b03a2e", label=f"step {dt * 1e3:g} ms")
        wrong = errors[name]
        words = f"slip {wrong['slip']:.2f} %, load {wrong['load']:.1f} %, friction {wrong['friction']:.1f} %"
        panel.set_title(f"{name}: {words}", loc="left", fontsize=10)
        panel.set_ylabel("N of pad A [kN]")
        panel.legend(loc="upper right", fontsize=8)
    axes[-1].set_xlabel("time [s]")
    print("picture:", save_figure(figure, chosen.out / "why_not_contact_friction.png"))
    write_json(chosen.out / "why_not_contact_friction.json", errors)


if __name__ == "__main__":
    main()
