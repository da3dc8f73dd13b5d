"""What a fit needs of a run: states on the samples and between them, masks, and the noise of every channel."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from slipwise.arrays import Array, Mask
from slipwise.campaign import Campaign, Run
from slipwise.campaign.invalid_samples import InvalidSamples, add_wild_samples
from slipwise.campaign.scales import Scales
from slipwise.campaign.states import States, measured_states
from slipwise.errors import InputError
from slipwise.jobs.machine_code import kept
from slipwise.record import Record
from slipwise.relations.sample_masks import (
    mask_balances_of_inertia,
    mask_judged_and_ringing,
    without_estimated_loads,
)
from slipwise.rig import Specimen
from slipwise.rig.frame import storey_channels
from slipwise.short_repr import short_repr
from slipwise.signals.ends import in_frequency
from slipwise.signals.filters import LowPass, lowpass
from slipwise.signals.shift import shift

#: Masked before and after a stuck stretch [s].
_STUCK_MARGIN = 0.016
#: Slower pads point nowhere [m/s].
FAST = 0.01
#: Instants per sample at which the laws are evaluated: a reversal between two samples must not wait for the second.
#: With two, a law that changes over 5 mm/s loses a fifth to a third of its size; four are for what is reported.
FINE, FINER = 2, 4


@short_repr
@dataclass(frozen=True)
class FitRun:
    """One run, ready for the relations of a fit.

    Attributes:
        name: of the run.
        role: "fit", "repeat" or "holdout".
        rest_before: pause before it [s].
        states: measured states.
        filtered: what the logger did to the friction channels; None where nothing is known.
        pads: names of the pads whose friction and load were measured, in the order of the rig.
        load: (n, p) [N].
        force: (n, p) along x [N]; zero where it was not measured, see `forces_measured`.
        across: (n, p) along y [N]; empty (n, 0) where it was not measured.
        sliding: (n,) samples at which the law gives the force of a pad.
        judged: relation -> samples by which it is judged, see `sample_masks`.
        invalid: channel -> samples (n,) at which it is no measurement.
        unseen: time within which friction may have jumped at any instant before samples were thinned out [s].
        ringing: (n,) a pad lifts, or the girder's pitch rings from it.
        noise: channel -> standard deviation of one sample.
        rigid_rotation_acceleration: part of the girder's acceleration over the table that is no slip, because both
            rotate as one body, (n,) or 0 [m/s^2].
        fine: instants per sample at which the laws are evaluated.
        forces_measured: whether the pads' friction was measured; else only what all bearings carry together is known,
            from the inertia of girder and storeys.
    """

    name: str
    role: str
    rest_before: float
    states: States
    filtered: LowPass | None
    pads: tuple[str, ...]
    load: Array
    force: Array
    across: Array
    sliding: Mask
    judged: Mapping[str, Mask]
    invalid: Mapping[str, Mask] = field(default_factory=dict[str, Mask])
    unseen: float = 0.0
    ringing: Mask = field(default_factory=lambda: np.zeros(1, dtype=bool))
    noise: dict[str, float] = field(default_factory=dict[str, float])
    rigid_rotation_acceleration: Array | float = 0.0
    fine: int = FINE
    forces_measured: bool = True

    @property
    def loads_measured(self) -> bool:
        """Whether the pads' loads were measured; else they are made of weight and inertia."""
        return self.states.load_errors is None

    @property
    def record(self) -> Record:
        """All channels, lag of a causal logger taken out."""
        return self.states.record

    @property
    def time(self) -> Array:
        """Time of the samples (n,) [s]."""
        return self.states.time

    @cached_property
    def dt(self) -> float:
        """Sampling step [s]."""
        return self.states.dt

    @property
    def scales(self) -> Scales:
        """Scales of the campaign."""
        return self.states.scales

    @property
    def slip(self) -> Array:
        """Slip along x (n,) [m]."""
        return self.states.slip[:, 0]

    @property
    def velocity(self) -> Array:
        """Slip rate along x (n,) [m/s]."""
        return self.states.velocity[:, 0]

    @cached_property
    def gauge_noise(self) -> tuple[Array, Array]:
        """Noise of the pads' gauges of friction and load, (p,) each [N]."""
        friction = np.array([self.noise[f"pad_{p}_Fx"] if self.forces_measured else 0.0 for p in self.pads])
        return friction, np.array([self.noise.get(f"pad_{p}_N", 0.0) for p in self.pads])

    @cached_property
    def fine_load(self) -> Array:
        """Load at the instants at which the laws are evaluated, (f, p) [N]."""
        return np.maximum(interpolate_finely(self.load, self.fine), 0.0)

    @property
    def all_loads(self) -> Array | None:
        """Load of all pads of the rig (n, n_pads) [N], whether or not their friction was measured; None without."""
        pads = self.states.specimen.pads
        if self.pads == pads and self.loads_measured:
            return self.load
        names = [f"pad_{p}_N" for p in pads]
        return np.stack([self.record[n] for n in names], axis=1) if self.record.has_all(*names) else None

    def channel(self, name: str) -> Array:
        """Return a channel (n,), zero where it was not measured."""
        return self.record[name] if name in self.record else np.zeros(len(self.record))

    def with_record(self, record: Record, *, moved: bool) -> "FitRun":
        """Return the run with other channels.

        Args:
            record: all channels.
            moved: whether slip and velocity must be made anew.
        """
        states = replace(
            self.states,
            record=record,
            load=_stacked(record, self.pads, "N", self.load),
            girder_acceleration=_accelerations(record, self.states.girder_acceleration),
        )
        if moved:
            slip, velocity = self._moved(record)
            states = replace(states, slip=slip, velocity=velocity)
        force = _stacked(record, self.pads, "Fx", self.force) if self.forces_measured else self.force
        across = _stacked(record, self.pads, "Fy", self.across)
        return replace(self, states=states, load=states.load, force=force, across=across)

    def without_table_pitch(self, acceleration: Array) -> "FitRun":
        """Return the run with what the table's pitch adds taken out of slip and velocity.

        Args:
            acceleration: (n,) of the girder over the table along x that is no slip [m/s^2].
        """
        slip, velocity = self._moved(self.record.replaced(girder_ax=self.record["girder_ax"] - acceleration))
        states = replace(self.states, slip=slip, velocity=velocity)
        return replace(self, states=states, rigid_rotation_acceleration=acceleration)

    def slip_delay_corrected(self, delay: float) -> "FitRun":
        """Return the run with slip and velocity as from a gauge that does not lag behind the accelerometers.

        A tenth of a millisecond is half a millimetre a second, more than all noise.

        Args:
            delay: of the slip gauge behind the accelerometers [s].
        """
        synchronised = shift(self.record["slip_x"], self.dt, -delay)
        slip, velocity = self._moved(self.record.replaced(slip_x=synchronised))
        return replace(self, states=replace(self.states, slip=slip, velocity=velocity))

    def _moved(self, record: Record) -> tuple[Array, Array]:
        """Return slip and velocity of changed gauges, by what the smoother makes of the change far from its ends.

        X = (x/s_x^2 - w^2 a/s_a^2) / (1/s_x^2 + w^4/s_a^2): least squares of both gauges at every frequency.
        """
        slip, velocity = self.states.slip.copy(), self.states.velocity.copy()
        gauge = self.noise["slip_x"]
        accelerometers = np.hypot(self.noise.get("girder_ax", 0.0), self.noise.get("table_ax", 0.0)) or np.inf

        def weights(f: Array) -> tuple[Array, Array]:
            turn = (2.0 * np.pi * f) ** 2
            total = 1.0 / gauge**2 + (turn / accelerometers) ** 2
            return 1.0 / gauge**2 / total, -turn / accelerometers**2 / total

        for place, change in enumerate(self._changes(record)):
            if np.any(change):
                slip[:, 0] += in_frequency(change, self.dt, lambda f, i=place: weights(f)[i], 128)
                rate = in_frequency(change, self.dt, lambda f, i=place: 2j * np.pi * f * weights(f)[i], 128)
                velocity[:, 0] += rate
        velocity[self.states.at_rest] = 0.0  # what is at rest stays so
        return slip, velocity

    def _changes(self, record: Record) -> tuple[Array, Array]:
        def change(name: str) -> Array:
            return record[name] - self.record[name] if name in record else np.zeros(len(record))

        return change("slip_x"), change("girder_ax") - change("table_ax")


def fit_runs(campaign: Campaign, invalid: InvalidSamples | None = None) -> list[FitRun]:
    """Prepare every run of a campaign.

    Args:
        campaign: the runs.
        invalid: run -> channel -> samples (n,) at which it is no measurement, besides the wild ones of the runs.

    Raises:
        InputError: a run lacks slip, or both a pad's friction and the inertia from which that of all follows.
    """
    runs = [_fit_run(run, campaign, add_wild_samples(run, (invalid or {}).get(run.name, {}))) for run in campaign.runs]
    levels = {channel: gauge.level for channel, gauge in campaign.gauges.items()}
    estimated = (
        {channel: float(np.hypot(levels.get(channel, 0.0), error)) for channel, error in run.estimated.items()}
        for run in campaign.runs
    )
    return [
        replace(r, noise={**levels, **wider, **_noise_of_estimated_loads(r)})
        for r, wider in zip(runs, estimated, strict=True)
    ]


def _noise_of_estimated_loads(run: FitRun) -> dict[str, float]:
    errors = run.states.load_errors
    return {} if errors is None else {f"pad_{p}_N": float(e) for p, e in zip(run.pads, errors, strict=True)}


def _fit_run(run: Run, campaign: Campaign, invalid: Mapping[str, Mask]) -> FitRun:
    states = measured_states(run, campaign)
    loaded = [p for p, load in zip(states.pads, states.load.T, strict=True) if np.isfinite(load).any()]
    forces_measured = campaign.specimen.slides and any(f"pad_{p}_Fx" in states.record for p in campaign.specimen.pads)
    inertia = () if forces_measured else _inertia_channels(campaign.specimen)
    pads = tuple(p for p in loaded if not forces_measured or f"pad_{p}_Fx" in states.record)
    together = bool(inertia) and pads == campaign.specimen.pads and states.record.has_all(*inertia)
    if not forces_measured and not together:
        pads = ()
    if not pads:
        forces = [name for p in campaign.specimen.pads if (name := f"pad_{p}_Fx") in states.record]
        reason = f"{', '.join(forces)} without pad_*_N (or pad_*_P) of the same pad" if forces else "no pad_*_Fx"
        other = f", or of all pads together from {' and '.join(inertia)} if all loads are known" if inertia else ""
        raise InputError(
            f"{run.file}: {reason} was measured; a law of friction is fitted where a pad has both its friction and its "
            f"load{other}; the run has {', '.join(states.record.channels)}"
        )
    here = [states.pads.index(p) for p in pads]
    load = states.load[:, here]
    errors = states.load_errors
    states = replace(
        states, pads=pads, load=load, force=states.force[:, here],
        load_errors=None if errors is None else errors[here],
    )  # fmt: skip
    margin = max(2, round(_STUCK_MARGIN * states.scales.time / states.dt))
    grounded = states.usable & np.isfinite(load).all(axis=1)
    sliding = grounded & ~_widened(states.stuck, margin)
    unmeasured = np.zeros_like(states.load)
    force = _stacked(states.record, pads, "Fx", unmeasured) if forces_measured else unmeasured
    shows_force = f"pad_{pads[0]}_Fx" if forces_measured else "girder_ax"
    filtered = states.lowpass.get(shows_force)
    rest = 0.0 if run.rest_before is None else run.rest_before
    nothing = np.empty((len(force), 0))
    across = _stacked(states.record, pads, "Fy", nothing) if states.has_y and forces_measured else nothing
    fast = np.hypot(*states.velocity.T) > FAST * states.scales.speed
    # samples were looked at as recorded; a gap of theirs is filled on the axis of the states
    bad = {c: np.interp(states.time, run.record.time, m.astype(float)) > 0.0 for c, m in invalid.items()}
    kept, ringing = mask_judged_and_ringing(states, grounded, sliding, fast, pads, bad)
    if not forces_measured:
        _refuse_dead(run.file, inertia, bad)
        kept |= mask_balances_of_inertia(states, grounded, sliding, fast, bad)
    kept = without_estimated_loads(kept) if run.estimated else kept
    unseen = campaign.logger.unseen(shows_force)
    more = {"unseen": unseen, "ringing": ringing, "forces_measured": forces_measured}
    return FitRun(run.name, run.role, rest, states, filtered, pads, load, force, across, sliding, kept, bad, **more)


def _refuse_dead(file: str, inertia: tuple[str, ...], bad: Mapping[str, Mask]) -> None:
    """Refuse a run in which an acceleration shows nothing without which nobody knows what the bearings carry.

    Raises:
        InputError: the message names it.
    """
    if dead := [name for name in inertia if name in bad and bad[name].all()]:
        raise InputError(
            f"{file}: {', '.join(dead)} shows nothing, and without it the force of all bearings does not follow from "
            "inertia where no pad's friction was measured; leave this run out, or map a gauge that works to it"
        )


def _inertia_channels(specimen: Specimen) -> tuple[str, ...]:
    """Return the accelerations from which the force of all bearings follows; none where the slip is prescribed."""
    return ("girder_ax", *storey_channels(specimen.storeys)) if specimen.free else ()


def _stacked(record: Record, pads: tuple[str, ...], kind: str, otherwise: Array) -> Array:
    names = [f"pad_{p}_{kind}" for p in pads]
    if not record.has_all(*names):
        return otherwise
    return np.stack([record[n] for n in names], axis=1)


def _accelerations(record: Record, before: Array) -> Array:
    columns = [record[n] if (n := f"girder_a{a}") in record else before[:, i] for i, a in enumerate("xyz")]
    return np.stack(columns, axis=1)


def _widened(flags: Mask, reach: int) -> Mask:
    """Spread flags to the samples before and after them."""
    count = np.concatenate([[0], np.cumsum(flags)])
    place = np.arange(len(flags))
    low, high = np.maximum(place - reach, 0), np.minimum(place + reach + 1, len(flags))
    return count[high] > count[low]


def interpolate_finely(values: Array, fine: int) -> Array:
    """Return the values (n, ...) at the instants, (fine (n - 1) + 1, ...), by cubics through four neighbours."""
    out = np.empty((fine * (len(values) - 1) + 1, *values.shape[1:]))
    flat = np.ascontiguousarray(values).reshape(len(values), -1)
    _cubics(flat, fine, out.reshape(len(out), -1))
    return out


@kept()
def _cubics(values, fine, out):  # pragma: no cover - compiled
    """Fill the instants between samples; at the ends the last sample stands for the one that is not there."""
    count, width = values.shape
    for i in range(count - 1):
        before, after = max(i - 1, 0), min(i + 2, count - 1)
        for k in range(width):
            out[i * fine, k] = values[i, k]
        for j in range(1, fine):
            t = j / fine
            w0, w1 = -t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2
            w2, w3 = -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6
            for k in range(width):
                out[i * fine + j, k] = (
                    w0 * values[before, k] + w1 * values[i, k] + w2 * values[i + 1, k] + w3 * values[after, k]
                )
    for k in range(width):
        out[(count - 1) * fine, k] = values[count - 1, k]


def smooth_record(values: Array, run: FitRun) -> Array:
    """Return a channel without what lies above the logger's band."""
    return lowpass(values, run.dt, run.filtered or LowPass(0.2 / run.dt))
