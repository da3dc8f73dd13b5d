"""System level: the replay from the measured table motion after the base fit, and its own floor.

The floor of a replay is more than the noise of the gauge it is compared with: noise in the measured table motion and in
the states at which windows restart goes through the rig too, and so does the error of the step. All three are measured:
by a replay with as much noise again in what it is fed with, and by one with the step halved.

Numbers of the rig that only a replay needs are taken here from the runs that may be fitted: stiffness and damping of
the pads, from the girder's answer to vertical motion, and its pitch inertia, from the fitted pitch frequency. A pad
sticks on the few micrometres that the base fit found.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from slipwise.arrays import Array
from slipwise.campaign import States
from slipwise.channels import channels_like
from slipwise.comparison.measured_replay import SystemRun, choose_simulation_step, replay_runs
from slipwise.effects import base_effects
from slipwise.errors import InputError
from slipwise.estimation.base_fit import BaseFit
from slipwise.model import Model, use
from slipwise.relations.run_data import FitRun
from slipwise.short_repr import short_repr
from slipwise.signals.ends import in_frequency
from slipwise.simulation.simulator import DT

#: Seed of the noise that a replay is fed with: the same always, so that two comparisons can be compared.
SEED = 1
#: Vertical motion below this many times its own noise tells nothing of the springs.
_SHAKEN = 8.0
#: Largest lag between the accelerometers of table and girder [s].
_LAG = 2e-3
#: Shortest elastic stick over g dt^2: mu g / length is the square of its frequency [1].
_STIFFEST = 0.3


@dataclass(frozen=True)
class SystemError:
    """Error of one channel in one run at system level.

    Attributes:
        run: name.
        role: "fit", "repeat" or "holdout".
        channel: name.
        rms: of simulated minus measured [SI].
        gauge: noise of the gauge [SI].
        fed: what noise of table motion and restarts makes of the simulation [SI].
        step: change when the step is halved [SI].
        floor: the three together [SI].
        error: rms over floor [1].
        share: rms over the rms of the measured channel [1].
    """

    run: str
    role: str
    channel: str
    rms: float
    gauge: float
    fed: float
    step: float
    floor: float
    error: float
    share: float


@short_repr
@dataclass(frozen=True)
class SystemLevel:
    """All runs at system level.

    Attributes:
        model: that was replayed.
        runs: measured and simulated channels.
        errors: of every run and channel.
        dt: step [s].
        notes: what was fitted or assumed for it, in words.
    """

    model: Model
    runs: tuple[SystemRun, ...]
    errors: tuple[SystemError, ...]
    dt: float
    notes: tuple[str, ...]


def build_replayed_model(base: BaseFit) -> tuple[Model, tuple[str, ...]]:
    """Return the fitted model as a replay needs it, and in words what was added to it."""
    values = base.solution.values
    model = base.objective.model(values)
    notes = []
    springs = list_pad_springs(base, model)
    if springs is not None:
        model = replace(model, specimen=model.specimen.changed(pad_stiffness=springs[0], pad_damping=springs[1]))
        notes.append(
            f"pads' stiffness {springs[0] / 1e6:.0f} kN/mm and damping {springs[1] / 1e3:.0f} kN s/m each, "
            "from the girder's answer to vertical motion in the fitted runs"
        )
    if "rig.pitch_frequency" in values and "rig.pitch_frequency" not in base.solution.at_bounds:
        inertia = _pitch_inertia(model, values["rig.pitch_frequency"])
        model = replace(model, specimen=replace(model.specimen, inertia=_of_a_body(model.specimen.inertia, inertia)))
        notes.append(
            f"the girder's pitch inertia {inertia / 1e3:.2f} t m2, from its fitted pitch frequency on the pads"
        )
    length = values.get("rig.stick_length", 0.0)
    # a bristle of this length swings the girder once in some steps: a shorter one is too stiff for them
    stiff = _STIFFEST * DT**2 * model.specimen.gravity
    if not model.reverses and length > stiff:
        model = model.adding(*(use(e, length=length) for e in base_effects("stick")))
        notes.append(f"pads stick elastically over {length * 1e6:.1f} um, as the base fit found")
    return model, tuple(notes)


def _of_a_body(rated: tuple[float, float, float], pitch: float) -> tuple[float, float, float]:
    """Return roll, pitch and yaw inertia with this pitch: no one of a body's three exceeds the sum of the others."""
    roll, _, yaw = rated
    yaw = min(max(yaw, pitch - roll), pitch + roll)
    return roll, pitch, max(yaw, roll - pitch)


def _pitch_inertia(model: Model, frequency: float) -> float:
    """Return the inertia [kg m^2] of a girder that pitches on its pads at a frequency: (2 pi f)^2 J = p k b^2."""
    specimen = model.built_specimen()
    spring = specimen.pitch_stiffness
    return spring / (2.0 * np.pi * frequency) ** 2


def list_pad_springs(base: BaseFit, model: Model) -> tuple[float, float] | None:
    """Fit stiffness [N/m] and damping [N s/m] of a pad to the girder's vertical answer to the table.

    H = K / (m s^2 + K) exp(-lag s) with K(s) = p (k + c s); the lag between both accelerometers is fitted too, for it
    would pass for damping. None where vertical motion was not measured or too weak, or the model sets the springs.
    """
    if any(u.effect.base == "springs" for u in model.uses) or "rig.pitch_frequency" not in base.solution.values:
        return None
    runs = [
        run
        for i in base.objective.fitted
        if (run := base.objective.run(i)).record.has_all("table_az", "girder_az")
        and run.noise["table_az"] > 0.0
        and float(np.std(run.record["table_az"])) > _SHAKEN * run.noise["table_az"]
    ]
    if not runs:
        return None
    rated = model.specimen.pad_stiffness
    values = base.solution.values
    # pitch and heave ring on the same springs: c/k is known from the pitch, which rings freely after each reversal
    ratio = 2.0 * values["rig.pitch_damping"] / (2.0 * np.pi * values["rig.pitch_frequency"])
    pads, mass = len(model.specimen.pads), model.specimen.carried_mass

    def left(scaled: Array) -> Array:
        stiffness = scaled[0] * rated
        damping = ratio * stiffness
        out = []
        for run in runs:

            def answer(frequency: Array) -> NDArray[np.complex128]:
                turn = 2j * np.pi * frequency
                spring = pads * (stiffness + damping * turn)
                return spring / (mass * turn**2 + spring) * np.exp(-_LAG * scaled[1] * turn)

            predicted = in_frequency(run.record["table_az"], run.dt, answer, 256)
            out.append((run.record["girder_az"] - predicted)[run.judged["heave"]] / run.noise["girder_az"])
        return np.concatenate(out)

    found = least_squares(left, np.array([1.0, 0.0]), bounds=([0.2, -1.0], [5.0, 1.0]), loss="soft_l1")
    stiffness = float(found.x[0] * rated)
    return stiffness, ratio * stiffness


def compare_system_level(
    base: BaseFit, rng: np.random.Generator, progress: Callable[[float], None] | None = None
) -> SystemLevel:
    """Replay all runs in windows and hold every channel against its floor.

    Args:
        base: the fit; held-out runs are replayed with its numbers.
        rng: for the noise of what the replay is fed with.
        progress: called with the fraction done.

    Raises:
        InputError: table_ax was not recorded, or no channel was measured where a replay can be judged.
    """
    tell = progress or (lambda _: None)
    model, notes = build_replayed_model(base)
    runs = base.objective.runs
    dt = choose_simulation_step(DT, model.built_specimen())
    main = replay_runs(model, [(r.name, r.states, r.rest_before) for r in runs], dt=dt)
    tell(0.3)
    finer = replay_runs(model, [(r.name, r.states, r.rest_before) for r in runs], dt=0.5 * dt)
    tell(0.7)
    noisier = replay_runs(model, [(r.name, _noisier(r, rng), r.rest_before) for r in runs], dt=dt)
    tell(1.0)
    errors = []
    for run, one, fine, noisy in zip(runs, main, finer, noisier, strict=True):
        judged = run.states.usable
        for name in _shown(one):
            here = judged & np.isfinite(one.simulated[name])
            if not here.any():
                continue
            step = _rms((one.simulated[name] - fine.simulated[name])[here])
            fed = _rms((one.simulated[name] - noisy.simulated[name])[here])
            gauge = run.noise[name]
            floor = float(np.sqrt(gauge**2 + fed**2 + step**2))
            size = _rms(one.measured[name][here] - np.median(one.measured[name][here]))
            rms = one.error[name]
            errors.append(
                SystemError(
                    run.name, run.role, name, rms, gauge, fed, step, floor, rms / max(floor, 1e-300),
                    rms / max(size, 1e-300),
                )
            )  # fmt: skip
    if not errors:
        raise InputError("the runs are too short: no sample of a replay can be held against what was measured")
    return SystemLevel(model, tuple(main), tuple(errors), dt, notes)


def pool_system_errors(errors: tuple[SystemError, ...], channel: str, *, held_out: bool) -> float | None:
    """Return the error of a channel over all fitted, or all held-out, runs; `channel` may end in a wildcard's part.

    Args:
        errors: of all runs.
        channel: a name, or "pad_*_Fx" for all pads.
        held_out: which runs.
    """
    names = channels_like(channel, dict.fromkeys(e.channel for e in errors))
    chosen = [e.error**2 for e in errors if e.channel in names and (e.role == "holdout") == held_out]
    return float(np.sqrt(np.mean(chosen))) if chosen else None


def _shown(run: SystemRun) -> list[str]:
    order = ("slip_", "girder_a", "yaw", "pad_")
    return sorted(run.simulated, key=lambda n: next((i for i, p in enumerate(order) if n.startswith(p)), 9))


def _rms(values: Array) -> float:
    return float(np.sqrt(np.nanmean(values**2)))


def _noisier(run: FitRun, rng: np.random.Generator) -> States:
    """Add to table motion and restarts as much noise as they have already."""
    states = run.states
    table = np.array([run.noise.get(f"table_a{axis}", 0.0) for axis in "xyz"])
    speed = np.array(states.velocity_error)
    relative = np.hypot(run.noise.get("girder_ax", 0.0), run.noise.get("table_ax", 0.0))
    # the smoother's errors of position and of velocity differ by the frequency at which both gauges are as good
    corner = np.sqrt(relative / run.noise["slip_x"]) if relative > 0.0 else np.inf
    return replace(
        states,
        slip=states.slip + rng.standard_normal(states.slip.shape) * speed / corner,
        velocity=states.velocity + rng.standard_normal(states.velocity.shape) * speed,
        table_acceleration=states.table_acceleration + rng.standard_normal(states.table_acceleration.shape) * table,
    )


def list_held_out_channels(level: SystemLevel) -> Mapping[str, float]:
    """Return channel -> error over all held-out runs [floors]; fitted runs where none is held out."""
    names = list(dict.fromkeys(e.channel for e in level.errors))
    held = any(e.role == "holdout" for e in level.errors)
    found = {n: pool_system_errors(level.errors, n, held_out=held) for n in names}
    return {n: v for n, v in found.items() if v is not None}
