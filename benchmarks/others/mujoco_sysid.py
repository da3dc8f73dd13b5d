"""mujoco.sysid: fit a MuJoCo model with one sliding joint to each campaign, and name the parameters that matter.

    pip install "mujoco[sysid]>=4" scipy && python mujoco_sysid.py FOLDER

A rig is one mass on a slide joint with friction loss and a spring, moved by the table's measured acceleration; its slip
is compared. A single slider is moved by a servo along its measured slip; the servo's force is compared. The base fit
has friction (and, of a rig, the spring). Then each candidate parameter of MJCF is added alone: it is named where its
95 % interval excludes zero and the residual falls by `MATERIAL` of the signal. What MJCF has no parameter for cannot be
named.
"""

import io
import os
import sys
from collections.abc import Sequence
from contextlib import redirect_stdout
from pathlib import Path

import mujoco
import numpy as np
from columns import MATERIAL, answer_folders, read_runs
from mujoco import sysid

#: Least step of a simulation, and the longest, of a slider that is moved slowly [s].
STEP, SLOW_STEP = 1.0e-3, 1.0e-2
#: Force of a slider whose friction is 1 [N]: large beside the inertia of the 1 kg that the servo moves.
FORCE = 1.0e3
#: Stiffness of that servo [N/m]; its damping of two steps keeps it stable whatever the step.
SERVO = 1.0e6
MODEL = """<mujoco><option timestep="{step}" integrator="implicitfast" gravity="0 0 0"/><worldbody>
<body name="mass"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><joint name="slide" type="slide" axis="1 0 0"/>
<geom size="0.05" contype="0" conaffinity="0"/></body></worldbody><actuator>{actuator}</actuator>
<sensor>{sensor}</sensor></mujoco>"""
#: Catalogue's name -> what of the joint is it, and its largest size for a mass of 1 kg.
OF_RIG = {"buffer_damping": ("damping", 20.0), "direction_asymmetry": ("force", 1.0)}
OF_SLIDER = {"slide_curvature": ("stiffness", 1e5), "channel_offset": ("force", 300.0)}


def parameter(name: str, kind: str, start: float, low: float, high: float) -> sysid.Parameter:
    """Give a parameter that changes the joint, or a constant force on the mass."""

    def change(spec: mujoco.MjSpec, value: sysid.Parameter) -> None:
        if kind == "force":
            spec.option.gravity = [value.value[0], 0.0, 0.0]
        elif kind == "frictionloss":
            spec.joint("slide").frictionloss = value.value[0]
        else:
            setattr(spec.joint("slide"), kind, np.array([value.value[0], 0.0, 0.0]))

    return sysid.Parameter(name, start, low, high, modifier=change)


def fit(runs: sysid.ModelSequences, chosen: Sequence[tuple[str, str, float, float, float]]) -> tuple[float, np.ndarray]:
    """Fit parameters; gives the rms of the residual, and size over half interval of each."""
    parameters = sysid.ParameterDict()
    for one in chosen:
        parameters.add(parameter(*one))
    residual = sysid.build_residual_fn(models_sequences=[runs], n_threads=1)
    with redirect_stdout(io.StringIO()):  # a line for each step otherwise
        found, result = sysid.optimize(parameters, residual, verbose=False, max_iters=25)
    left = residual(result.x, found)[0]
    half = np.maximum(sysid.calculate_intervals(left, np.asarray(result.jac))[1], 1e-300)
    return float(np.sqrt(np.mean(np.concatenate([r.ravel() for r in left]) ** 2))), np.abs(result.x) / half


def sequences(folder: Path) -> tuple[sysid.ModelSequences, bool]:
    """Give the fitted runs of a campaign as mujoco.sysid reads them, and whether it is a rig."""
    runs, mass = read_runs(folder)
    rig = mass > 0.0
    sampled = float(np.nanmedian(np.diff(runs[0]["time"])))
    step = STEP if rig else float(np.clip(0.5 * sampled, STEP, SLOW_STEP))
    text = MODEL.format(
        step=step,
        actuator='<motor name="drive" joint="slide"/>' if rig
        else f'<position name="drive" joint="slide" kp="{SERVO}" kv="{2.0 * SERVO * step}"/>',
        sensor='<jointpos name="out" joint="slide"/>' if rig else '<actuatorfrc name="out" actuator="drive"/>',
    )  # fmt: skip
    spec = mujoco.MjSpec.from_string(text)
    model = spec.compile()
    starts, controls, measured = [], [], []
    for run in runs:
        good = np.isfinite(run["time"]) & np.isfinite(run["slip_x"])
        time = run["time"][good] - run["time"][good][0]
        steps = np.arange(0.0, time[-1], step)
        drive = -run["table_ax"] if rig else run["slip_x"]
        out = run["slip_x"] if rig else FORCE * run["pad_A_Fx"] / np.nanmean(run["pad_A_N"])
        drive, out = (np.interp(steps, time, np.nan_to_num(values[good])) for values in (drive, out))
        starts.append(sysid.create_initial_state(model, np.array([run["slip_x"][good][0]])))
        controls.append(sysid.TimeSeries.from_control_names(steps, drive[:, None], model))
        measured.append(sysid.TimeSeries.from_names(steps, out[:, None], model))
    names = [f"run {i}" for i in range(len(runs))]
    return sysid.ModelSequences("campaign", spec, names, starts, controls, measured), rig


def choose(folder: Path) -> tuple[list[str], float | None]:
    """Fit the base, then each candidate beside it."""
    runs, rig = sequences(folder)
    base = [("friction", "frictionloss", 1.0, 0.0, 5.0), ("spring", "stiffness", 50.0, 0.0, 5e3)]
    base = base if rig else [("friction", "frictionloss", 0.1 * FORCE, 0.0, FORCE)]
    least, _ = fit(runs, base)
    found: dict[str, float] = {}
    for name, (kind, most) in (OF_RIG if rig else OF_SLIDER).items():
        low = -most if kind == "force" else 0.0
        error, sure = fit(runs, [*base, (name, kind, 1e-3 * most, low, most)])
        signal = np.concatenate([one.data.ravel() for one in runs.sensordata])
        gained = np.sqrt(max(least**2 - error**2, 0.0)) / np.sqrt(np.mean(signal**2))
        if sure[-1] > 1.0 and gained >= MATERIAL:
            found[name] = gained
    return sorted(found, key=lambda name: -found[name]), None


if __name__ == "__main__":
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    answer_folders(Path(sys.argv[1]), "mujoco_sysid", choose)
