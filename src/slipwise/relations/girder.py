"""What a rigid girder on its pads' springs asks of the measured channels, without any law of friction.

    girder  m a_x = -(sum F + F_buffers + drag + F_frame)
    heave   sum N = (m + sum m_i) (g + a_z) - lift
    pitch   Q_pitch = P(s) [h sum F + (h - z_b) F_buffers] / half_x + (x + x_c) sum N / half_x + ...
    roll    Q_roll = R(s) y_c sum N / half_y,    warp, warp_2 ... = what the rated seating makes of them
    storeys -sum m_i a_i = what the frame makes of a_x and of the girder's pitch (`storeys.py`)
    motion  a_x - a_x,table = d2(slip)/dt2

P(s) = (2 z w s + w^2) / (s^2 + 2 z w s + w^2) is the girder's pitch on its pads: taken as quasi-static, the balance
leaves 2.5 times the noise. R(s) is its roll; where pads stand unevenly, each shakes the other (`rig/rocking.py`).
What the storeys of a frame push is known from their accelerations. Effects add to each by
their `balance`, `spring`, `drag` and `lift` hooks.

Source: docs/theory.md, sections 1.2 and 1.4; Harris' Shock and Vibration Handbook, base-excited oscillator.
"""

from collections.abc import Mapping

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.rig_motion import shortening_rate
from slipwise.effects import BalanceStates
from slipwise.model import Model
from slipwise.noise.gauges import ENOUGH
from slipwise.relations.inverse_filter import Spectrum
from slipwise.relations.pad_law import log_force
from slipwise.relations.parameters import SEAT_STIFFNESS
from slipwise.relations.run_data import FitRun, interpolate_finely
from slipwise.relations.sample_masks import is_rolling_only_at_rest
from slipwise.relations.storeys import predict_push
from slipwise.rig import Specimen
from slipwise.rig.curved_faces import rise_rate, risen
from slipwise.rig.frame import frame_moment, frame_push, storey_channels
from slipwise.rig.load_basis import WARPS, basis_of, by_warp, warps
from slipwise.rig.load_modes import load_modes
from slipwise.rig.rocking import rocking_modes
from slipwise.signals.ends import in_frequency
from slipwise.signals.pitch import pass_through_pitch
from slipwise.signals.shift import shift
from slipwise.simulation.predict import Predictor

BALANCES: tuple[str, ...] = ("girder", "heave", "pitch", "roll", *WARPS, "storeys", "motion")
#: Where a gauge of friction is invalid, the girder's accelerometer takes its place if the two differ by more than this
#: many times the accelerometer's noise [1].
_SIGNIFICANT = 4.0


def list_balances(specimen: Specimen) -> tuple[str, ...]:
    """Return the balances that a girder on these pads has, whatever was recorded."""
    left_out = {*WARPS, *(() if specimen.storeys else ("storeys",))} - {*warps(specimen)}
    return tuple(name for name in BALANCES if name not in left_out)


def list_available_balances(run: FitRun, specimen: Specimen) -> tuple[str, ...]:
    """Tell which balances a run's channels allow."""
    out = []
    if not specimen.free or run.pads != specimen.pads or not np.isfinite(run.load).all():
        return ()
    framed = run.record.has_all(*storey_channels(specimen.storeys))
    if "girder_ax" in run.record and framed:
        out.append("girder")
    loads = run.loads_measured
    if loads and np.isfinite(run.states.girder_acceleration[:, 2]).all():
        out.append("heave")
    rests = not is_rolling_only_at_rest(run.states.has_y, specimen) or np.count_nonzero(run.judged["roll"]) >= ENOUGH
    out += (["pitch"] if framed else []) + (["roll"] if rests else []) + [*warps(specimen)] if loads else []
    if specimen.storeys and "girder" in out:
        out.append("storeys")
    if run.record.has_all("girder_ax", "table_ax"):
        out.append("motion")
    return tuple(out)


def _rocked(
    driven: tuple[Array | None, Array | None], specimen: Specimen, run: FitRun, values: Mapping[str, float]
) -> tuple[Array, Array]:
    """Return roll and pitch of the loads, (n,) each [N], that a moment over half a spacing makes of each; or none."""
    half = specimen.half_spacing[::-1]
    out = [np.zeros(len(run.time)), np.zeros(len(run.time))]
    for mode in rocking_modes(specimen):
        shares = [h * d for h, d in zip(half, mode.drive, strict=True)]
        parts = [share * one for share, one in zip(shares, driven, strict=True) if one is not None and share != 0.0]
        if not parts:
            continue
        frequency, damping = (mode.ratio * values[f"rig.pitch_{what}"] for what in ("frequency", "damping"))
        passed = pass_through_pitch(np.sum(parts, axis=0), run.dt, frequency, damping)
        for i, shown in enumerate(mode.shown):
            if shown != 0.0:
                out[i] = out[i] + shown / half[i] * passed
    return out[0], out[1]


def compute_buffer_forces(law: Predictor, run: FitRun, yaw: Array, yaw_rate: Array) -> Array:
    """Return the force of the girder on each buffer along x, (n, n_buffers) [N]; yaw moves the buffers apart.

    Args:
        law: the model's laws with their memory.
        run: its slip.
        yaw: of the girder over the table (n,) [rad].
        yaw_rate: (n,) [rad/s].
    """
    specimen = law.model.specimen
    if not specimen.buffer_stiffness:
        return np.zeros((len(run.time), 0))
    sides = np.array(specimen.buffer_places)[:, 1]
    slip = run.slip[:, None] - sides * yaw[:, None]
    if not any(u.effect.port == "buffer" for u in law.model.uses) and not any(b.gap for b in specimen.buffers):
        return slip * np.array(specimen.buffer_stiffness)
    slip = interpolate_finely(slip, run.fine)
    velocity = interpolate_finely(run.velocity[:, None] - sides * yaw_rate[:, None], run.fine)
    time = np.linspace(run.time[0], run.time[-1], len(slip))
    deflection = np.stack([slip, np.zeros_like(slip)], axis=2)
    rate = np.stack([velocity, np.zeros_like(velocity)], axis=2)
    return log_force(law.buffers(time, deflection, rate)[:, :, 0], run, None, averaged=False)


def compute_heave_rate(total: Array, dt: float, specimen: Specimen) -> Array:
    """Return the girder's vertical rate over its pads (n,) [m/s]: their shortening under their measured load [N]."""
    return -shortening_rate(total, dt, sum(specimen.springs), specimen.pad_damping / specimen.pad_stiffness)


def predict_balances(
    model: Model,
    run: FitRun,
    force: Array,
    buffers: Array,
    values: Mapping[str, float],
) -> tuple[dict[str, Array], dict[str, Array]]:
    """Return what the balances predict and what was measured, each relation (n,).

    Args:
        model: with the numbers of the fit.
        run: its channels, instrument faults of the hypothesis taken out.
        force: (n, n_pads) measured pad forces, faults taken out [N].
        buffers: (n, n_buffers) [N].
        values: of the fit, for the pitch of the girder on its pads.
    """
    specimen, rated = model.built_specimen(), model.specimen
    fb, mass = buffers.sum(axis=1), specimen.mass
    frame = frame_push(run.record, specimen)
    total = _total(run, force, mass, fb - frame)
    predicted = {"girder": _delayed((frame - total - fb) / mass, run.dt, values["rig.late_girder"])}
    measured = {"girder": run.channel("girder_ax")}
    if run.loads_measured:
        if not run.forces_measured:  # what the pads carry together while they stick is in no law
            total = frame - mass * run.channel("girder_ax") - fb
        predicted_loads, measured_loads = _predict_loads(specimen, rated, run, total, buffers, values)
        predicted, measured = predicted | predicted_loads, measured | measured_loads
    if rated.storeys and "storeys" in list_available_balances(run, rated):
        predicted["storeys"], measured["storeys"] = predict_push(run, specimen), frame
    added = compute_effects(model, run, specimen, force, buffers)
    rocking = [added.pop(name, None) for name in ("roll", "pitch")]
    if run.loads_measured and any(one is not None for one in rocking):
        added |= dict(zip(("roll", "pitch"), _rocked((rocking[0], rocking[1]), specimen, run, values), strict=True))
    for name, more in added.items():
        if name == "motion" or name not in predicted:
            continue  # taken out of the states already, or of loads that were not measured
        predicted[name] = predicted[name] + (-more / mass if name == "girder" else more)
    return predicted, measured


def _predict_loads(
    specimen: Specimen, rated: Specimen, run: FitRun, total: Array, buffers: Array, values: Mapping[str, float]
) -> tuple[dict[str, Array], dict[str, Array]]:
    """Return what the balances of the loads predict and what was measured, each relation (n,) [N].

    Args:
        specimen: as built.
        rated: as rated.
        run: its channels.
        total: (n,) force of all pads along x [N].
        buffers: (n, n_buffers) [N].
        values: of the fit.
    """
    half, half_y = specimen.half_spacing
    height = specimen.centre_height
    higher = risen(run.states.slip, specimen) if specimen.pads_on == "table" else 0.0
    moment = (height + higher) * total + buffers @ (height - np.array(specimen.buffer_heights))
    upward = np.nan_to_num(run.states.girder_acceleration[:, 2])
    moment += frame_moment(run.record, specimen.storeys, specimen.gravity + upward, about=height)
    heave = run.load.sum(axis=1)
    # what effects add to the rated place of the centre of gravity and to the seating is theirs to say
    off_x, off_y = (c - m for c, m in zip((rated.centre_x, rated.centre_y), specimen.middle, strict=True))
    swing = (off_x + (run.slip if specimen.pads_on == "table" else 0.0)) * heave
    turning = off_y * heave if off_y else None
    if run.across.size:  # what pads across hold while the girder rests
        turning = height * run.across.sum(axis=1) + (0.0 if turning is None else turning)
    by_roll = _rocked((None if turning is None else turning / half_y, None), specimen, run, values)
    by_pitch = _rocked((None, (moment + swing) / half), specimen, run, values)
    modes = load_modes(run.load, basis_of(specimen))
    seated = by_warp(specimen, values.get(SEAT_STIFFNESS, 1.0) * np.array(specimen.springs) * rated.seating)
    lifted = specimen.carried_mass * (specimen.gravity + run.states.girder_acceleration[:, 2])
    predicted = {
        "heave": _delayed(lifted, run.dt, values["rig.late_load"]),
        "pitch": _delayed(by_pitch[1], run.dt, values["rig.late_pitch"]) + by_roll[1],
        "roll": _delayed(by_pitch[0], run.dt, values["rig.late_pitch"]) + by_roll[0],
        **{name: np.full(len(heave), load) for name, load in seated.items()},
    }
    measured = {"heave": heave, "pitch": modes.pitch, "roll": modes.roll, **by_warp(specimen, run.load)}
    return predicted, measured


def _total(run: FitRun, force: Array, mass: float, buffers: Array) -> Array:
    """Return the pads' force along x (n,) [N]; where a gauge is invalid, what the girder's own motion gives.

    Residuals leave such samples out, but pitch rings on with them.
    """
    total = force.sum(axis=1)
    invalid = [bad for name, bad in run.invalid.items() if name.startswith("pad_") and name.endswith("_Fx")]
    if not invalid or "girder_ax" not in run.record or "girder_ax" in run.invalid:
        return total
    from_motion = -mass * run.record["girder_ax"] - buffers
    off = np.abs(total - from_motion) > _SIGNIFICANT * mass * run.noise["girder_ax"]
    return np.where(np.any(invalid, axis=0) & off, from_motion, total)


def _delayed(values: Array, dt: float, lag: float) -> Array:
    """Shift a smooth signal by a lag far below the sampling step."""
    return values - lag * np.gradient(values, dt)


def compute_effects(
    model: Model, run: FitRun, specimen: Specimen, force: Array, buffers: Array | None = None,
    acceleration: Array | None = None, table: Array | None = None, rising: float = 0.0,
) -> dict[str, Array]:  # fmt: skip
    """Return what effects add to the balances by their `balance` hooks, relation -> (n,) [N]; "motion" in m/s^2.

    Args:
        model: whose effects.
        run: its channels.
        specimen: as built.
        force: (n, p) of the pads along x [N].
        buffers: (n, n_buffers) along x [N]; none of them pushes, if not given.
        acceleration: (n, 3) of the girder in place of the measured one [m/s^2].
        table: (n, 3) of the table in place of the measured one [m/s^2].
        rising: added to the heave rate [m/s].
    """
    uses = model.with_hook("balance")
    if not uses:
        return {}
    zero = np.zeros(len(run.time))
    if buffers is None:
        buffers = np.zeros((len(zero), len(specimen.buffer_stiffness)))
    across = np.zeros_like(force)
    states = BalanceStates(
        time=run.time,
        specimen=specimen,
        slip=run.states.slip,
        velocity=run.states.velocity,
        load=run.load,
        pad_force=np.stack([force, across], axis=2),
        girder_acceleration=np.nan_to_num(run.states.girder_acceleration) if acceleration is None else acceleration,
        table_acceleration=np.nan_to_num(run.states.table_acceleration) if table is None else table,
        buffer_force=np.stack([buffers.sum(axis=1), zero], axis=1),
        buffer_size=np.abs(buffers),
        heave_rate=compute_heave_rate(run.load.sum(axis=1), run.dt, specimen)
        + rise_rate(run.states.slip, run.states.velocity, specimen)
        + rising,
    )
    out: dict[str, Array] = {}
    for entry in uses:
        for name, more in entry.effect.hooks["balance"](states, target=entry.target, **entry.values).items():
            out[name] = out.get(name, zero) + more
    return out


def compute_rigid_rotation(model: Model, run: FitRun) -> Array:
    """Return girder's acceleration over the table that is no slip (n,) [m/s^2]: girder and table rotate together."""
    return compute_effects(model, run, model.built_specimen(), run.force).get("motion", np.zeros(len(run.time)))


def compute_motion_residual(
    run: FitRun, slip_delay: float, scale: Mapping[str, float], raised: Mapping[str, Spectrum]
) -> Array:
    """Return a_x - a_x,table - d2(slip)/dt2, whitened by the noise of the three gauges: (n,) of unit variance.

    Args:
        run: its channels.
        slip_delay: of the slip gauge behind the accelerometers [s].
        scale: channel -> by how much undoing faults has scaled its noise: else a gain would shrink it and look good.
        raised: channel -> by how much taking a filter out has raised the power of its noise.
    """

    def power(name: str, f: Array) -> Array:
        factor = np.interp(f, *raised[name]) if name in raised else 1.0
        return np.asarray((run.noise[name] * scale.get(name, 1.0)) ** 2 * factor)

    def white(f: Array) -> Array:
        slip = (2.0 * np.pi * f) ** 4 * power("slip_x", f)
        return 1.0 / np.sqrt(power("girder_ax", f) + power("table_ax", f) + slip)

    relative = run.record["girder_ax"] - run.record["table_ax"] - run.rigid_rotation_acceleration
    slip = shift(run.record["slip_x"], run.dt, -slip_delay)
    bend = in_frequency(slip - slip[0], run.dt, lambda f: (2.0 * np.pi * f) ** 2 * white(f), 256)
    return in_frequency(relative, run.dt, white, 256) + bend
