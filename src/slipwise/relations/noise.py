"""What the noise of the gauges makes of every relation, and so what divides its residual.

The friction of the pads first: near a reversal a small error of velocity or timing makes a large one of force. Then the
balances of the girder, each by itself; what rings with noise in them, because girder or effects do; and how a residual
whose noise is not white is brought to white noise.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.ndimage import maximum_filter1d
from scipy.signal import fftconvolve

from slipwise.arrays import Array
from slipwise.model import Model
from slipwise.relations.evaluation_times import Instants
from slipwise.relations.girder import compute_buffer_forces, compute_effects, compute_heave_rate
from slipwise.relations.run_data import FAST, FitRun
from slipwise.relations.storeys import compute_noise_in_push
from slipwise.relations.unsampled_reversals import compute_jump_noise_in_pitch, compute_jump_noise_in_push
from slipwise.rig import Specimen
from slipwise.rig.frame import frame_noise
from slipwise.rig.load_basis import basis_of, warps
from slipwise.signals.ends import in_frequency
from slipwise.signals.pitch import pass_through_pitch
from slipwise.simulation.predict import PadForces, predictor

#: Uncertainty of the timing of a reversal: shear of pad and cell, cards of the logger [s].
TIMING = 1e-4
#: Periods of the logger's filter over which it spreads what it makes of a reversal, before and after [1].
_SPREAD = 0.5


def compute_reversal_noise(run: FitRun, plain: Array, slower: Array, faster: Array, *, gradual: bool = False) -> Array:
    """Return the uncertainty of friction where pads reverse (n, p) [N]: errors of velocity and timing.

    Velocities may be wrong either way, and a reversal that one error hides the other one shows: both count, as the mean
    of their squares, so that nothing depends on which way x points.

    Args:
        run: its step and filter.
        plain: (n, p) predicted by the law [N].
        slower: (n, p) predicted with velocities along x that are one expected error too small [N].
        faster: (n, p) the same with velocities that are one expected error too large [N].
        gradual: whether friction turns round over a length of slip, which an error of the slip shifts.
    """
    timing = np.hypot(TIMING * run.scales.time, run.unseen / np.sqrt(12.0))
    velocity = 0.5 * ((slower - plain) ** 2 + (faster - plain) ** 2)
    squared = velocity + (timing * np.gradient(plain, run.dt, axis=0)) ** 2
    if gradual:
        squared += _compute_place_noise(run, plain) ** 2
    if run.filtered is not None:
        reach = int(np.ceil(_SPREAD / (run.filtered.frequency * run.dt)))
        # a few newtons beside a reversal, the same at every reversal, are below one sample's noise but bend the fit
        squared = maximum_filter1d(squared, 2 * reach + 1, axis=0)
    return np.sqrt(squared)


def _compute_place_noise(run: FitRun, plain: Array) -> Array:
    """Return what an error of the slip itself makes of friction that turns round over a length of slip (n, p) [N].

    A pad that moves by less than the error within a sample may be anywhere within that sample.
    """
    error = run.states.position_error
    if not error:
        return np.zeros_like(plain)
    return error * np.gradient(plain, axis=0) / np.maximum(np.abs(np.gradient(run.slip)), error)[:, None]


def compute_pad_noise(run: FitRun, plain: Array, reversal: Array) -> Array:
    """Return the noise of measured less predicted friction (n, p) [N]: of gauges, loads and reversals.

    Args:
        run: its gauges.
        plain: (n, p) predicted by the law [N].
        reversal: (n, p) of `compute_reversal_noise` [N].
    """
    gauge, loads = run.gauge_noise
    friction = np.abs(plain) / np.maximum(run.load, 0.05 * run.load.mean())
    return np.sqrt(np.maximum(gauge**2 + (0.6 * friction * loads) ** 2 + reversal**2, 1e-24))


def compute_law_noise_in_girder(specimen: Specimen, run: FitRun, plain: Array, reversal: Array) -> Array:
    """Return the noise that predicted friction brings into the girder's balance (n,) [m/s^2], where none was measured.

    Errors of velocity and timing are those of the girder and so of all pads at once; errors of the loads of a girder
    that rocks cancel in the sum.

    Args:
        specimen: its mass.
        run: its loads.
        plain: (n, p) predicted by the law [N].
        reversal: (n, p) of `compute_reversal_noise` [N].
    """
    friction = np.abs(plain) / np.maximum(run.load, 0.05 * run.load.mean())
    by_load = 0.6 * np.linalg.norm(friction * run.gauge_noise[1], axis=1)
    return np.hypot(by_load, reversal.sum(axis=1)) / specimen.mass


def compute_noise_across(run: FitRun, state: Instants, law_forces: PadForces) -> Array:
    """Return the noise of measured less predicted force along y (n, p) [N]: gauges, loads, direction, timing."""
    gauge = np.array([run.noise[f"pad_{p}_Fy"] for p in run.pads])
    return np.hypot(gauge, compute_noise_of_law_across(run, state, law_forces))


def compute_noise_of_law_across(run: FitRun, state: Instants, law_forces: PadForces) -> Array:
    """Return the noise of the predicted force along y (n, p) [N]: loads, direction, timing."""
    loads = run.gauge_noise[1]
    force = law_forces.force[:: run.fine, :, 1]
    friction = np.abs(force) / np.maximum(run.load, 0.05 * run.load.mean())
    speed = np.maximum(np.hypot(*np.moveaxis(state.velocity[:: run.fine], 2, 0)), FAST * run.scales.speed)
    direction = law_forces.bound[:: run.fine] * run.states.pad_velocity_error.max() / speed
    timing = TIMING * run.scales.time * np.gradient(force, run.dt, axis=0)
    return np.sqrt((0.6 * friction * loads) ** 2 + direction**2 + timing**2)


def whiten_residual(left: Array, run: FitRun, level: float, ringing: Array, driven: Array | None = None) -> Array:
    """Bring the residual (n,) of a balance to white noise of its gauges' own level, at every frequency.

    Args:
        left: measured less predicted [N].
        run: its times.
        level: noise of the gauges themselves [N].
        ringing: (m,) spectrum of what rings with gauges' noise in it, fixed when the fit was weighed [N^2].
        driven: (m,) spectrum of noise that a hypothesis adds, which masks what was there before [N^2].
    """
    before = 1.0 / (1.0 + ringing / level**2)
    now = before if driven is None else 1.0 / (1.0 + (ringing + driven) / level**2)
    frequency = np.fft.rfftfreq(len(left), run.dt)
    white = in_frequency(left, run.dt, lambda f: np.sqrt(np.interp(f, frequency, now)), 256)
    return white if driven is None else with_masked_noise(white, float(1.0 - np.mean(now / before)))


def with_masked_noise(part: Array, masked: float) -> Array:
    """Count noise that an effect masks as if it were still there: the sum of squares grows by it, each sample alike.

    Noise that it adds is taken out in the same way, as far as there is any.

    Put on every sample by itself it would make residuals jump as they change sign, and slopes of that are noise.
    """
    total = float(part @ part)
    if total == 0.0:
        return part
    return part * np.sqrt(max(1.0 + masked * np.count_nonzero(part) / total, 0.0))


def compute_gauge_noise_in_balances(specimen: Specimen, run: FitRun) -> dict[str, float]:
    """Return what the noise of the gauges alone makes of every balance of a girder, each in its own unit."""
    gauge, loads = run.gauge_noise
    total, force = float(np.sqrt(np.sum(loads**2))), float(np.sqrt(np.sum(gauge**2)))
    stiffness = sum(specimen.buffer_stiffness)
    beside = np.hypot(force, stiffness * 0.1 * run.noise["slip_x"]) / specimen.mass
    pushed, _ = frame_noise(specimen, run.noise)
    basis = basis_of(specimen)
    rows = {"pitch": basis.rigid[1], "roll": basis.rigid[2], **dict(zip(warps(specimen), basis.warp, strict=True))}
    levels = {
        **{name: np.sqrt(np.sum((row * loads) ** 2)) for name, row in rows.items()},  # and see `whiten_residual`
        "girder": np.hypot(run.noise.get("girder_ax", 0.0), np.hypot(beside, pushed / specimen.mass)),
        "roll": np.linalg.norm([*(rows["roll"] * loads), *_across_in_roll(specimen, run)]),
        "heave": np.hypot(total, specimen.carried_mass * run.noise.get("girder_az", 0.0)),
        "storeys": pushed,  # and see `compute_noise_in_push`
        "motion": 1.0,
    }
    return {name: max(float(level), 1e-12) for name, level in levels.items()}


def _across_in_roll(specimen: Specimen, run: FitRun) -> Array:
    """Return what noise of the pads' friction across adds to the predicted roll load, (p,) or none [N]."""
    if not run.across.size:
        return np.zeros(0)
    return specimen.centre_height / specimen.half_spacing[1] * np.array([run.noise[f"pad_{p}_Fy"] for p in run.pads])


def compute_noise_shares(specimen: Specimen, run: FitRun) -> dict[str, dict[str, float]]:
    """Return share of single channels in the variance of the balances of loads: relation -> channel -> share [1]."""
    basis, cells = basis_of(specimen), [f"pad_{p}_N" for p in run.pads]
    names = ("heave", "pitch", "roll", *warps(specimen))
    powers: dict[str, dict[str, float]] = {
        name: dict(zip(cells, map(float, (row * run.gauge_noise[1]) ** 2), strict=True))
        for name, row in zip(names, (*basis.rigid, *basis.warp), strict=True)
    }
    powers["heave"]["girder_az"] = (specimen.carried_mass * run.noise.get("girder_az", 0.0)) ** 2
    return {
        name: {channel: power / max(sum(of.values()), 1e-24) for channel, power in of.items()}
        for name, of in powers.items()
    }


def compute_balance_noise(
    model: Model, runs: Sequence[FitRun], values: Mapping[str, float], reversal: Sequence[Array],
    changed: Sequence[Array],
) -> dict[str, list[Array]]:  # fmt: skip
    """Return the noise of every balance in its own unit, relation -> per run a number or (n,).

    Args:
        model: with the numbers of the fit.
        runs: their gauges.
        values: of the fit, for the girder's pitch.
        reversal: per run (n, p) of `compute_reversal_noise` [N].
        changed: per run (p,) of `compute_change_by_faults` [1]; empty without faults of the gauges of friction.
    """
    springs = predictor(model) if model.with_hook("balance") else None
    out: dict[str, list[Array]] = {}
    for i, run in enumerate(runs):
        levels = {name: np.array(level) for name, level in compute_gauge_noise_in_balances(model.specimen, run).items()}
        more: dict[str, Array] = {}
        if changed and run.forces_measured:
            more = compute_noise_of_correction(
                model.specimen, reversal[i], changed[i], compute_pitch_impulse_response(run, values)
            )
        if springs is not None:
            more |= compute_vertical_friction_noise(
                model, run, compute_buffer_forces(springs, run, *np.zeros((2, len(run.time))))
            )
        if run.filtered is None and "rig.logger" not in values and run.loads_measured and run.forces_measured:
            pitch = (values["rig.pitch_frequency"], values["rig.pitch_damping"])
            more["pitch"] = np.hypot(more.get("pitch", 0.0), compute_jump_noise_in_pitch(model.specimen, run, *pitch))
            if model.specimen.storeys:
                more["storeys"] = compute_jump_noise_in_push(model.specimen, run)
        for name, level in levels.items():
            out.setdefault(name, []).append(np.hypot(level, more[name]) if name in more else level)
    return out


def compute_heave_level(model: Model, run: FitRun, scale: Mapping[str, float]) -> float:
    """Return the noise of the heave balance as the model's mass and effects pass it on [N].

    Less mass multiplies the accelerometer's noise by less: without this the fit would trade mass for a smaller
    residual, and make up for the load with whatever else adds to it. What effects let ring is counted by
    `compute_bent_noise_in_heave`.

    Args:
        model: with the numbers of the fit.
        run: its gauges.
        scale: of `measurement.compute_noise_scale`, by which the balance is divided.
    """
    loads = float(np.linalg.norm(run.gauge_noise[1])) * scale.get("loads", 1.0)
    vertical = model.specimen.carried_mass * run.noise.get("girder_az", 0.0) * scale.get("girder_az", 1.0)
    return float(np.hypot(loads, compute_heave_noise(model, run) * vertical)) / scale.get("heave", 1.0)


def compute_heave_noise(model: Model, run: FitRun) -> float:
    """Tell by which factor, at most 1, effects change the accelerometer's noise in the heave balance, where none rings.

    A girder that bends hides part of a_z at high frequency, noise included: without this factor every such effect
    would seem to explain something.
    """
    passed = _compute_passed_noise(model, run)
    return 1.0 if passed is None else float(np.sqrt(np.mean(np.minimum(passed, 1.0))))


def compute_bent_noise_in_heave(model: Model, run: FitRun) -> Array:
    """Return what the accelerometer's noise adds to the predicted load beside what `compute_heave_level` counts.

    A girder that bends multiplies the noise at its own frequency by up to 1/(2 z), and passes on below it what it hides
    above.

    Returns:
        spectrum (m,) as `compute_force_noise_in_pitch` gives it, nowhere below zero, over the level that is left where
        a part is hidden, in units of the level of the gauges [N^2].
    """
    passed = _compute_passed_noise(model, run)
    if passed is None:
        return np.zeros(len(run.time) // 2 + 1)
    loads = float(np.sum(run.gauge_noise[1] ** 2))
    vertical = (model.specimen.carried_mass * run.noise.get("girder_az", 0.0)) ** 2
    counted = float(np.mean(np.minimum(passed, 1.0)))
    in_level = (loads + vertical) / max(loads + counted * vertical, 1e-24)
    return vertical * np.maximum(passed - counted, 0.0) * in_level


def _compute_passed_noise(model: Model, run: FitRun) -> Array | None:
    """Return the share of the accelerometer's noise power that effects pass on to heave (m,); None where all of it is.

    The frequencies are those of a real transform.
    """
    if not model.with_hook("balance") or not np.isfinite(run.states.girder_acceleration[:, 2]).all():
        return None
    impulse = np.zeros(len(run.time))
    impulse[len(impulse) // 2] = 1.0
    more = _more_heave(model, run, impulse)
    return None if more is None else np.abs(np.fft.rfft(impulse + more / model.specimen.carried_mass)) ** 2


def _more_heave(model: Model, run: FitRun, upward: Array) -> Array | None:
    """Return what effects add to the load for an acceleration (n,) upward alone, (n,) [N]; None where none adds any."""
    acceleration = np.zeros((2, len(run.time), 3))
    acceleration[1, :, 2] = upward
    added = (compute_effects(model, run, model.specimen, run.force, acceleration=a) for a in acceleration)
    without_acceleration, with_acceleration = (a.get("heave") for a in added)
    if without_acceleration is None or with_acceleration is None:
        return None
    return with_acceleration - without_acceleration


def compute_vertical_friction_noise(model: Model, run: FitRun, buffers: Array) -> dict[str, Array]:
    """Return the noise of vertical friction at the girder: it follows the heave rate, which is made from noisy loads.

    Args:
        model: with the numbers of the fit.
        run: its channels.
        buffers: (n, n_buffers) [N].

    Returns:
        "heave" and "roll" (n,) [N]; empty where no effect brings such friction.
    """
    impulse = np.zeros(len(run.time))
    impulse[len(impulse) // 2] = np.linalg.norm(run.gauge_noise[1])
    error = float(np.linalg.norm(compute_heave_rate(impulse, run.dt, model.specimen)))
    specimen = model.built_specimen()
    up, down = (compute_effects(model, run, specimen, run.force, buffers, rising=w) for w in (error, -error))
    return {name: 0.5 * np.abs(up[name] - down[name]) for name in ("heave", "roll") if name in up}


def compute_force_noise_in_pitch(run: FitRun, specimen: Specimen, values: Mapping[str, float]) -> Array:
    """Return what noise of friction and storeys adds to the predicted pitch load: the girder's pitch rings with it.

    Returns:
        spectrum (m,) at the frequencies of a real transform, as the variance of white noise of that height [N^2].
    """
    total = run.gauge_noise[0] if run.forces_measured else np.array([specimen.mass * run.noise.get("girder_ax", 0.0)])
    levers = specimen.centre_height * total
    squared = float(np.sum(levers**2)) + frame_noise(specimen, run.noise)[1] ** 2
    ringing = compute_pitch_impulse_response(run, values) / specimen.half_spacing[0]
    return squared * np.abs(np.fft.rfft(ringing)) ** 2


def compute_driven_noise_in_pitch(model: Model, runs: Sequence[FitRun], values: Mapping[str, float]) -> list[Array]:
    """Return what accelerometers' noise adds to the predicted pitch load through effects that are driven by it.

    A table that rocks is driven by a measured acceleration, and its pitch acceleration grows with frequency: its noise
    may be several times that of the load cells.

    Returns:
        per run spectrum (m,) as `compute_force_noise_in_pitch` gives it [N^2].
    """
    run = min(runs, key=lambda r: len(r.time))
    frequency, damping = values["rig.pitch_frequency"], values["rig.pitch_damping"]
    specimen, at = model.built_specimen(), np.fft.rfftfreq(len(run.time), run.dt)
    power = [np.zeros(len(r.time) // 2 + 1) for r in runs]
    for place, channel in enumerate(("girder_ax", "table_ax")):
        impulse = np.zeros((2, len(run.time), 3))
        impulse[place, len(run.time) // 2, 0] = 1.0
        response = compute_effects(model, run, specimen, run.force, acceleration=impulse[0], table=impulse[1])
        pitch = response.get("pitch")
        if pitch is not None and pitch.any():
            size = np.abs(np.fft.rfft(pass_through_pitch(pitch, run.dt, frequency, damping))) ** 2
            for of, r in zip(power, runs, strict=True):
                of += r.noise.get(channel, 0.0) ** 2 * np.interp(np.fft.rfftfreq(len(r.time), r.dt), at, size)
    return power


def compute_pitch_impulse_response(run: FitRun, values: Mapping[str, float]) -> Array:
    """Return what the girder's pitch makes of a pulse in the middle of a run, (n,) [1]."""
    impulse = np.zeros(len(run.time))
    impulse[len(impulse) // 2] = 1.0
    return pass_through_pitch(impulse, run.dt, values["rig.pitch_frequency"], values["rig.pitch_damping"])


def compute_noise_of_correction(
    specimen: Specimen, reversal: Array, changed: Array, ringing: Array
) -> dict[str, Array]:
    """Return the noise that balances get where the law must predict what a faulty gauge of friction did not show.

    Args:
        specimen: its mass, and the lever of friction in pitch.
        reversal: (n, p) of `compute_reversal_noise` [N].
        changed: (p,) share of such an error that the fault lets through [1].
        ringing: (n,) what the girder's pitch makes of a pulse in the middle [1].

    Returns:
        "girder" (n,) [m/s^2] and "pitch" (n,) [N].
    """
    squared = np.sum((reversal * changed) ** 2, axis=1)
    pitch = np.maximum(fftconvolve(squared, ringing**2, mode="same"), 0.0)
    lever = specimen.centre_height / specimen.half_spacing[0]
    return {"girder": np.sqrt(squared) / specimen.mass, "pitch": lever * np.sqrt(pitch)}


def compute_ringing_noise(model: Model, runs: Sequence[FitRun], values: Mapping[str, float]) -> dict[str, list[Array]]:
    """Return what rings with gauges' noise in pitch and heave: relation -> per run spectrum (m,) [N^2]."""
    ringing: dict[str, list[Array]] = {}
    if all(run.loads_measured for run in runs):
        ringing["pitch"] = [compute_force_noise_in_pitch(r, model.specimen, values) for r in runs]
    if model.specimen.storeys:
        ringing["storeys"] = [compute_noise_in_push(r, model.specimen) for r in runs]
    if model.with_hook("balance"):
        ringing["heave"] = [compute_bent_noise_in_heave(model, r) for r in runs]
    return ringing
