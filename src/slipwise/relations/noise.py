"""What noise of gauges makes of the balances: of each by itself, and where the girder or an effect rings with it."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.signal import fftconvolve

from slipwise.model import Model
from slipwise.relations.girder import buffers_along, effects_in, heave_rate, through_pitch
from slipwise.relations.run_data import FitRun
from slipwise.relations.storeys import noise_in_push
from slipwise.relations.unsampled_reversals import jump_noise_in_pitch, jump_noise_in_push
from slipwise.rig import Specimen
from slipwise.rig.frame import frame_noise
from slipwise.rig.load_basis import basis_of, warps
from slipwise.simulation.predict import predictor

Array = NDArray[np.float64]


def balance_noise(specimen: Specimen, run: FitRun) -> dict[str, float]:
    """Return the noise of every balance of a girder, in its own unit."""
    gauge, loads = run.gauge_noise
    total, force = float(np.sqrt(np.sum(loads**2))), float(np.sqrt(np.sum(gauge**2)))
    stiffness = sum(specimen.buffer_stiffness)
    beside = np.hypot(force, stiffness * 0.1 * run.noise["slip_x"]) / specimen.mass
    pushed, _ = frame_noise(specimen, run.noise)
    basis = basis_of(specimen)
    rows = {"pitch": basis.rigid[1], "roll": basis.rigid[2], **dict(zip(warps(specimen), basis.warp, strict=True))}
    levels = {
        **{name: np.sqrt(np.sum((row * loads) ** 2)) for name, row in rows.items()},  # and see `whitened`
        "girder": np.hypot(run.noise.get("girder_ax", 0.0), np.hypot(beside, pushed / specimen.mass)),
        "roll": np.linalg.norm([*(rows["roll"] * loads), *_across_in_roll(specimen, run)]),
        "heave": np.hypot(total, specimen.carried_mass * run.noise.get("girder_az", 0.0)),
        "storeys": pushed,  # and see `noise_in_push`
        "motion": 1.0,
    }
    return {name: max(float(level), 1e-12) for name, level in levels.items()}


def _across_in_roll(specimen: Specimen, run: FitRun) -> Array:
    """Return what noise of the pads' friction across adds to the predicted roll load, (p,) or none [N]."""
    if not run.across.size:
        return np.zeros(0)
    return specimen.centre_height / specimen.half_spacing[1] * np.array([run.noise[f"pad_{p}_Fy"] for p in run.pads])


def shares_of_noise(specimen: Specimen, run: FitRun) -> dict[str, dict[str, float]]:
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


def weighed_balances(
    model: Model, runs: Sequence[FitRun], values: Mapping[str, float], reversal: Sequence[Array],
    changed: Sequence[Array],
) -> dict[str, list[Array]]:  # fmt: skip
    """Return the noise of every balance in its own unit, relation -> per run a number or (n,).

    Args:
        model: with the numbers of the fit.
        runs: their gauges.
        values: of the fit, for the girder's pitch.
        reversal: per run (n, p) of `reversal_noise` [N].
        changed: per run (p,) of `changed_by` [1]; empty without faults of the gauges of friction.
    """
    springs = predictor(model) if model.with_hook("balance") else None
    out: dict[str, list[Array]] = {}
    for i, run in enumerate(runs):
        levels = {name: np.array(level) for name, level in balance_noise(model.specimen, run).items()}
        more: dict[str, Array] = {}
        if changed:
            more = noise_of_fault_correction(
                model.specimen, reversal[i], changed[i], pitch_impulse_response(run, values)
            )
        if springs is not None:
            more |= vertical_friction_noise(model, run, buffers_along(springs, run, *np.zeros((2, len(run.time)))))
        if run.filtered is None and "rig.logger" not in values:
            pitch = (values["rig.pitch_frequency"], values["rig.pitch_damping"])
            more["pitch"] = np.hypot(more.get("pitch", 0.0), jump_noise_in_pitch(model.specimen, run, *pitch))
            if model.specimen.storeys:
                more["storeys"] = jump_noise_in_push(model.specimen, run)
        for name, level in levels.items():
            out.setdefault(name, []).append(np.hypot(level, more[name]) if name in more else level)
    return out


def heave_level(model: Model, run: FitRun, scale: Mapping[str, float]) -> float:
    """Return the noise of the heave balance as the model's mass and effects pass it on [N].

    Less mass multiplies the accelerometer's noise by less: without this the fit would trade mass for a smaller
    residual, and make up for the load with whatever else adds to it. What effects let ring is counted by
    `bent_noise_in_heave`.

    Args:
        model: with the numbers of the fit.
        run: its gauges.
        scale: of `measurement_model.noise_scale`, by which the balance is divided.
    """
    loads = float(np.linalg.norm(run.gauge_noise[1])) * scale.get("loads", 1.0)
    vertical = model.specimen.carried_mass * run.noise.get("girder_az", 0.0) * scale.get("girder_az", 1.0)
    return float(np.hypot(loads, min(1.0, heave_noise(model, run)) * vertical)) / scale.get("heave", 1.0)


def heave_noise(model: Model, run: FitRun) -> float:
    """Tell by which factor effects change the accelerometer's noise in the heave balance.

    A girder that bends hides part of a_z at high frequency, noise included: without this factor every such effect
    would seem to explain something.
    """
    uses = model.with_hook("balance")
    if not uses or not np.isfinite(run.states.girder_acceleration[:, 2]).all():
        return 1.0
    shaken = np.random.default_rng(0).normal(size=len(run.time))
    more = _more_heave(model, run, shaken)
    return 1.0 if more is None else float(np.std(shaken + more / model.specimen.carried_mass) / np.std(shaken))


def bent_noise_in_heave(model: Model, run: FitRun) -> Array:
    """Return what the accelerometer's noise adds to the predicted load where effects ring with it.

    A girder that bends multiplies the noise at its own frequency by up to 1/(2 z).

    Returns:
        spectrum (m,) as `force_noise_in_pitch` gives it, nowhere below zero [N^2].
    """
    impulse = np.zeros(len(run.time))
    impulse[len(impulse) // 2] = 1.0
    more = _more_heave(model, run, impulse)
    if more is None:
        return np.zeros(len(impulse) // 2 + 1)
    mass = model.specimen.carried_mass
    passed = np.abs(np.fft.rfft(mass * impulse + more)) ** 2
    return run.noise.get("girder_az", 0.0) ** 2 * np.maximum(passed - mass**2, 0.0)


def _more_heave(model: Model, run: FitRun, upward: Array) -> Array | None:
    """Return what effects add to the load for an acceleration (n,) upward alone, (n,) [N]; None where none adds any."""
    acceleration = np.zeros((2, len(run.time), 3))
    acceleration[1, :, 2] = upward
    added = (effects_in(model, run, model.specimen, run.force, acceleration=a) for a in acceleration)
    without_acceleration, with_acceleration = (a.get("heave") for a in added)
    if without_acceleration is None or with_acceleration is None:
        return None
    return with_acceleration - without_acceleration


def vertical_friction_noise(model: Model, run: FitRun, buffers: Array) -> dict[str, Array]:
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
    error = float(np.linalg.norm(heave_rate(impulse, run.dt, model.specimen)))
    specimen = model.built_specimen()
    up, down = (effects_in(model, run, specimen, run.force, buffers, rising=w) for w in (error, -error))
    return {name: 0.5 * np.abs(up[name] - down[name]) for name in ("heave", "roll") if name in up}


def force_noise_in_pitch(run: FitRun, specimen: Specimen, values: Mapping[str, float]) -> Array:
    """Return what noise of friction and storeys adds to the predicted pitch load: the girder's pitch rings with it.

    Returns:
        spectrum (m,) at the frequencies of a real transform, as the variance of white noise of that height [N^2].
    """
    levers = specimen.centre_height * run.gauge_noise[0]
    squared = float(np.sum(levers**2)) + frame_noise(specimen, run.noise)[1] ** 2
    ringing = pitch_impulse_response(run, values) / specimen.half_spacing[0]
    return squared * np.abs(np.fft.rfft(ringing)) ** 2


def driven_noise_in_pitch(model: Model, runs: Sequence[FitRun], values: Mapping[str, float]) -> list[Array]:
    """Return what accelerometers' noise adds to the predicted pitch load through effects that are driven by it.

    A table that rocks is driven by a measured acceleration, and its pitch acceleration grows with frequency: its noise
    may be several times that of the load cells.

    Returns:
        per run spectrum (m,) as `force_noise_in_pitch` gives it [N^2].
    """
    run = min(runs, key=lambda r: len(r.time))
    frequency, damping = values["rig.pitch_frequency"], values["rig.pitch_damping"]
    specimen, at = model.built_specimen(), np.fft.rfftfreq(len(run.time), run.dt)
    power = [np.zeros(len(r.time) // 2 + 1) for r in runs]
    for place, channel in enumerate(("girder_ax", "table_ax")):
        impulse = np.zeros((2, len(run.time), 3))
        impulse[place, len(run.time) // 2, 0] = 1.0
        response = effects_in(model, run, specimen, run.force, acceleration=impulse[0], table=impulse[1])
        pitch = response.get("pitch")
        if pitch is not None and pitch.any():
            size = np.abs(np.fft.rfft(through_pitch(pitch, run.dt, frequency, damping))) ** 2
            for of, r in zip(power, runs, strict=True):
                of += r.noise.get(channel, 0.0) ** 2 * np.interp(np.fft.rfftfreq(len(r.time), r.dt), at, size)
    return power


def pitch_impulse_response(run: FitRun, values: Mapping[str, float]) -> Array:
    """Return what the girder's pitch makes of a pulse in the middle of a run, (n,) [1]."""
    impulse = np.zeros(len(run.time))
    impulse[len(impulse) // 2] = 1.0
    return through_pitch(impulse, run.dt, values["rig.pitch_frequency"], values["rig.pitch_damping"])


def noise_of_fault_correction(specimen: Specimen, reversal: Array, changed: Array, ringing: Array) -> dict[str, Array]:
    """Return the noise that balances get where the law must predict what a faulty gauge of friction did not show.

    Args:
        specimen: its mass, and the lever of friction in pitch.
        reversal: (n, p) of `reversal_noise` [N].
        changed: (p,) share of such an error that the fault lets through [1].
        ringing: (n,) what the girder's pitch makes of a pulse in the middle [1].

    Returns:
        "girder" (n,) [m/s^2] and "pitch" (n,) [N].
    """
    squared = np.sum((reversal * changed) ** 2, axis=1)
    pitch = np.maximum(fftconvolve(squared, ringing**2, mode="same"), 0.0)
    lever = specimen.centre_height / specimen.half_spacing[0]
    return {"girder": np.sqrt(squared) / specimen.mass, "pitch": lever * np.sqrt(pitch)}


def ringing_noise(model: Model, runs: Sequence[FitRun], values: Mapping[str, float]) -> dict[str, list[Array]]:
    """Return what rings with gauges' noise in pitch and heave: relation -> per run spectrum (m,) [N^2]."""
    ringing = {"pitch": [force_noise_in_pitch(r, model.specimen, values) for r in runs]}
    if model.specimen.storeys:
        ringing["storeys"] = [noise_in_push(r, model.specimen) for r in runs]
    if model.with_hook("balance"):
        ringing["heave"] = [bent_noise_in_heave(model, r) for r in runs]
    return ringing
