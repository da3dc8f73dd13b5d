"""Measured states: what laws are fed with. Slip, its velocity at the sliding plane, loads, forces, accelerations.

Velocity is fused from slip gauge and accelerometers. The accelerometer sits at the centre of gravity, h above the
sliding plane, and the girder pitches on its pads by t = sum x_i N_i / sum k x_i^2, so the motion that is fused
is slip + h t, and h dt/dt is taken off the velocity again. Without it the pads' pitch mode stays in the velocity: some
mm/s after each reversal.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from slipwise.arrays import Array, Mask
from slipwise.campaign.aligned import aligned_run
from slipwise.campaign.campaign import Campaign, Run
from slipwise.campaign.inertia_loads import estimate_load_errors, estimate_loads_by_inertia
from slipwise.campaign.motion_phases import is_at_rest, is_inside, is_lifted, is_slow, is_stuck
from slipwise.campaign.scales import Scales, scales_of
from slipwise.errors import InputError
from slipwise.noise.gauges import Gauge, measure_slip_noise
from slipwise.record import Record
from slipwise.rig import Specimen
from slipwise.rig.frame import storey_channels
from slipwise.rig.load_basis import basis_of
from slipwise.rig.load_modes import load_modes, vertical_acceleration
from slipwise.short_repr import short_repr
from slipwise.signals.derivative import derivative
from slipwise.signals.filters import LowPass
from slipwise.signals.fused import Fused, fuse, fuse_scaled


@short_repr
@dataclass(frozen=True)
class States:
    """Measured states of one run on a uniform time axis, lag of a causal logger taken out.

    p is the number of pads with a force or a load, in the order of the rig.

    Attributes:
        specimen: of the campaign.
        pads: names of the pads that were measured.
        time: (n,) [s].
        slip: (n, 2) girder minus table at the sliding plane, smoothed [m]; y is 0 where it was not measured.
        velocity: (n, 2) of the slip [m/s]; zero where it is stuck and no more than noise.
        yaw: (n,) girder minus table [rad]; 0 where it was not measured.
        yaw_rate: (n,) [rad/s].
        load: (n, p) compression [N].
        force: (n, p, 2) of the girder on the pads [N]; NaN where it was not measured.
        girder_acceleration: (n, 3) at the centre of gravity [m/s^2]; NaN where it was not measured.
        table_acceleration: (n, 3) [m/s^2]; NaN where it was not measured.
        stuck: (n,) slower than 3 mm/s for 6 samples: a filter leaves 2 mm/s unsure where the slider hardly turns.
        near_reversal: (n,) not stuck, but slower than 2 cm/s, or within half a period of the logger's filter of a
            change of direction.
        uplift: (n,) a pad is near zero load, or was within 0.2 s.
        valid: (n,) not at the ends of the run, and not in a gap of the samples.
        has_y: whether slip across was measured.
        has_yaw: whether yaw was measured.
        lowpass: channel -> filter that a prediction of it must go through to be comparable; None: not known, or none.
        velocity_error: (2,) expected standard deviation of the velocity [m/s].
        yaw_rate_error: the same of the yaw rate [rad/s]; 0 where yaw was not measured.
        record: all channels of the run on the same axis, lag taken out, not smoothed.
        missing: what could not be made for lack of a channel, in words.
        scales: of the campaign.
        velocity_errors: (n,) of the velocity along x where they differ from sample to sample [m/s]; else None.
        position_error: expected standard deviation of one sample of the slip, where no accelerometer smoothed it [m].
        load_errors: (p,) expected error of loads that no cell weighed, made of weight and inertia [N]; None where the
            loads were measured.
    """

    specimen: Specimen
    pads: tuple[str, ...]
    time: Array
    slip: Array
    velocity: Array
    yaw: Array
    yaw_rate: Array
    load: Array
    force: Array
    girder_acceleration: Array
    table_acceleration: Array
    stuck: Mask
    near_reversal: Mask
    uplift: Mask
    valid: Mask
    has_y: bool
    has_yaw: bool
    lowpass: Mapping[str, LowPass | None]
    velocity_error: tuple[float, float]
    yaw_rate_error: float
    record: Record
    missing: tuple[str, ...]
    scales: Scales = field(default_factory=Scales)
    velocity_errors: Array | None = None
    position_error: float = 0.0
    load_errors: Array | None = None

    @property
    def dt(self) -> float:
        """Sampling step [s]."""
        return self.record.dt

    @property
    def sliding(self) -> Mask:
        """Samples that are neither stuck nor near a reversal (n,)."""
        return ~self.stuck & ~self.near_reversal

    @property
    def usable(self) -> Mask:
        """Samples on which a residual means something: valid and no uplift (n,)."""
        return self.valid & ~self.uplift

    @property
    def at_rest(self) -> Mask:
        """Samples at which the girder does not move over the table (n,)."""
        return ~np.any(self.velocity, axis=1)

    @cached_property
    def pad_velocity(self) -> Array:
        """Velocity of the girder over each pad (n, p, 2) [m/s]: yaw moves pads apart from the middle."""
        return self.velocity[:, None, :] + self.yaw_rate[:, None, None] * self._across

    @cached_property
    def pad_velocity_error(self) -> Array:
        """Expected standard deviation of the velocity over each pad (p, 2) [m/s]: that of yaw comes on top."""
        return np.hypot(self.velocity_error, self.yaw_rate_error * self._across[0])

    @cached_property
    def pad_velocity_errors(self) -> Array:
        """The same along x at every sample, (n, p) or (1, p) [m/s]."""
        if self.velocity_errors is None:
            return self.pad_velocity_error[None, :, 0]
        return np.hypot(self.velocity_errors[:, None], self.yaw_rate_error * self._across[0, :, 0])

    @cached_property
    def pad_slip(self) -> Array:
        """Slip of the girder over each pad (n, p, 2) [m]."""
        return self.slip[:, None, :] + self.yaw[:, None, None] * self._across

    @property
    def _across(self) -> Array:
        """What a unit of yaw adds to each pad's slip (1, p, 2) [m]: -y, +x."""
        measured = [self.specimen.pad_places[self.specimen.pads.index(p)] for p in self.pads]
        places = np.array(measured, dtype=float)
        return np.stack([-places[:, 1], places[:, 0]], axis=1)[None]


def measured_states(run: Run, campaign: Campaign) -> States:
    """Turn a run into the states that laws are fed with.

    Args:
        run: of the campaign.
        campaign: gives specimen and logger; replace its logger by the audit's estimate where it is not known.

    Raises:
        InputError: slip_x was not measured, or neither load nor pressure of a pad nor what its load follows from.
    """
    if "slip_x" not in run.record:
        raise InputError(
            f"{run.file}: slip_x is needed to know how the girder moves; it has {', '.join(run.record.channels)}"
        )
    aligned = aligned_run(run, campaign.logger)
    record, lowpass = aligned.record, aligned.lowpass
    specimen = campaign.specimen
    missing: list[str] = []
    pads = [pad for pad in specimen.pads if any(f"pad_{pad}_{kind}" in record for kind in ("N", "P", "Fx"))]
    load_errors: Array | None = None
    if _is_weighed_by_inertia(record, specimen, run):
        pads, load = list(specimen.pads), estimate_loads_by_inertia(record, specimen)
        load_errors = estimate_load_errors(specimen, campaign.gauges)
        missing.append("pad_*_N: made of the weight and of what inertia turns the girder over with")
        pitch = _pitch(load, specimen)
    else:
        load, pitch = _loads(record, specimen, pads, run, missing), girder_pitch(record, specimen)
    scales = scales_of(campaign)
    unfiltered = lowpass.get("girder_ax") is None
    along = _along(record, pitch, specimen, campaign.gauges, missing, scales, aligned.measured, unfiltered)
    across = _across(record, campaign.gauges, missing)
    yaw = fuse(record.time, record["yaw"]) if "yaw" in record else None
    if yaw is None and specimen.free:
        missing.append("yaw: velocities of the pads are taken as equal")
    velocity = np.stack([along.velocity, across.velocity if across else np.zeros(len(record))], axis=1)
    speed = np.hypot(velocity[:, 0], velocity[:, 1])
    error = along.velocity_error if specimen.free else 0.0
    stuck = is_stuck(speed, error, scales.speed)
    velocity[stuck & is_at_rest(velocity[:, 0], speed, error)] = 0.0
    slowest = next((f for f in lowpass.values() if f is not None), None)
    nothing = np.zeros(len(record))
    return States(
        specimen=specimen,
        pads=tuple(pads),
        time=record.time,
        slip=np.stack([along.position, across.position if across else nothing], axis=1),
        velocity=velocity,
        yaw=yaw.position if yaw else nothing,
        yaw_rate=yaw.velocity if yaw else nothing,
        load=load,
        force=_forces(record, pads),
        girder_acceleration=_accelerations(record, "girder"),
        table_acceleration=_accelerations(record, "table"),
        stuck=stuck,
        near_reversal=~stuck & is_slow(speed, velocity[:, 0], record.dt, slowest, scales.speed),
        uplift=is_lifted(load, record.dt, len(specimen.pads)),
        valid=aligned.measured & is_inside(len(record)),
        has_y=across is not None,
        has_yaw=yaw is not None,
        lowpass=lowpass,
        velocity_errors=along.velocity_errors,
        position_error=along.position_error,
        load_errors=load_errors,
        velocity_error=(along.velocity_error, across.velocity_error if across else 0.0),
        yaw_rate_error=yaw.velocity_error if yaw else 0.0,
        record=record,
        missing=tuple(missing),
        scales=scales,
    )


def _is_weighed_by_inertia(record: Record, specimen: Specimen, run: Run) -> bool:
    """Return whether no pad's load was measured, and the accelerations tell what the girder and its storeys load.

    Raises:
        InputError: no load was measured, and an acceleration from which it would follow is missing.
    """
    if any(f"pad_{pad}_{kind}" in record for pad in specimen.pads for kind in "NP") or not specimen.free:
        return False
    needed = ("girder_ax", *storey_channels(specimen.storeys))
    if absent := [name for name in needed if name not in record]:
        raise InputError(
            f"{run.file}: no pad has a load or a pressure, and {', '.join(absent)} is missing, without which the force "
            "and the loads of the bearings do not follow from inertia; measure the acceleration of the girder and of "
            f"every storey of the specimen, or leave storeys out of it; the file has {', '.join(run.record.channels)}"
        )
    return True


def _loads(record: Record, specimen: Specimen, pads: list[str], run: Run, missing: list[str]) -> Array:
    columns = []
    for pad in pads:
        if f"pad_{pad}_N" in record:
            columns.append(record[f"pad_{pad}_N"])
        elif f"pad_{pad}_P" in record:
            columns.append(record[f"pad_{pad}_P"] * specimen.pad_areas[specimen.pads.index(pad)])
            missing.append(f"pad_{pad}_N: taken as pressure times the rig's pad area")
        else:
            missing.append(f"pad_{pad}_N: its load is not known")
            columns.append(np.full(len(record), np.nan))
    if not columns:
        raise InputError(
            f"{run.file}: no pad has a load, a pressure or a force; it has {', '.join(run.record.channels)}"
        )
    return np.stack(columns, axis=1)


def _forces(record: Record, pads: list[str]) -> Array:
    nothing = np.full(len(record), np.nan)
    return np.stack(
        [
            np.stack(
                [record[f"pad_{pad}_F{axis}"] if f"pad_{pad}_F{axis}" in record else nothing for axis in "xy"], axis=1
            )
            for pad in pads
        ],
        axis=1,
    )


def _accelerations(record: Record, body: str) -> Array:
    columns = [record[n] if (n := f"{body}_a{axis}") in record else np.full(len(record), np.nan) for axis in "xyz"]
    if body == "girder" and record.has_all("girder_az_1", "girder_az_2"):
        columns[2] = vertical_acceleration(record)
    return np.stack(columns, axis=1)


def girder_pitch(record: Record, specimen: Specimen) -> Array | None:
    """Return the girder's pitch on its pads (n,) [rad], from their loads; None where a load is missing.

    Positive with the +x pads shortened: then the centre of gravity stands h t further to +x than the sliding plane.
    """
    if not specimen.free or not record.has_all(*(f"pad_{pad}_N" for pad in specimen.pads)):
        return None
    return _pitch(record.stacked("pad_{}_N", specimen.pads), specimen)


def _pitch(load: Array, specimen: Specimen) -> Array:
    """Return the girder's pitch (n,) [rad] under the loads (n, n_pads) of all pads [N]."""
    basis = basis_of(specimen)
    pitch = load_modes(load, basis).pitch
    stiffness = basis.half[0] * float(np.array(specimen.springs) @ basis.sides[:, 0] ** 2)
    return (pitch - np.median(pitch)) / stiffness


def _along(
    record: Record,
    pitch: Array | None,
    specimen: Specimen,
    gauges: Mapping[str, Gauge],
    missing: list[str],
    scales: Scales,
    measured: Mask,
    unfiltered: bool,
) -> Fused:
    recorded = record["slip_vx"] if "slip_vx" in record else None
    if not record.has_all("girder_ax", "table_ax"):
        if specimen.free:
            missing.append("girder_ax and table_ax: velocity is made from the slip gauge alone")
            return fuse(record.time, record["slip_x"], velocity=recorded)
        slip = np.where(measured, record["slip_x"], np.nan)
        return fuse_scaled(record.time, slip, recorded, scales.time, scales.length)
    relative = record["girder_ax"] - record["table_ax"]
    levels = measure_slip_noise(gauges, "x")
    if pitch is None:
        return fuse(record.time, record["slip_x"], relative, recorded, levels, undersampled=unfiltered)
    lean = specimen.centre_height * pitch
    leaning = derivative(lean, record.dt)
    raised = None if recorded is None else recorded + leaning
    fused = fuse(record.time, record["slip_x"] + lean, relative, raised, levels, undersampled=unfiltered)
    return Fused(
        position=fused.position - lean,
        velocity=fused.velocity - leaning,
        acceleration=fused.acceleration,
        bias=fused.bias,
        velocity_error=fused.velocity_error,
        velocity_errors=fused.velocity_errors,
        position_error=fused.position_error,
    )


def _across(record: Record, gauges: Mapping[str, Gauge], missing: list[str]) -> Fused | None:
    if "slip_y" not in record:
        missing.append("slip_y: motion across is taken as zero")
        return None
    recorded = record["slip_vy"] if "slip_vy" in record else None
    relative = record["girder_ay"] - record["table_ay"] if record.has_all("girder_ay", "table_ay") else None
    return fuse(record.time, record["slip_y"], relative, recorded, measure_slip_noise(gauges, "y"))
