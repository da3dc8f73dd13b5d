"""Which samples each relation is judged by: sliding pads, pads on the ground, gauges that are valid."""

from collections.abc import Mapping
from fnmatch import fnmatchcase

import numpy as np

from slipwise.arrays import Mask
from slipwise.campaign.aligned import spread
from slipwise.campaign.states import States
from slipwise.channels import VELOCITY_CHANNELS
from slipwise.noise.gauges import find_rest_before_motion
from slipwise.record import Record
from slipwise.rig import Specimen, pad_frequencies
from slipwise.rig.frame import storey_channels
from slipwise.rig.load_basis import WARPS
from slipwise.rig.rocking import coupled

#: Channels that the balances are made of, slip by all that it is fused from; pads and friction across take their own
#: pad's besides the velocity's.
_USES: dict[str, tuple[str, ...]] = {
    "girder": ("pad_*_Fx", *VELOCITY_CHANNELS),
    "heave": ("pad_*_N", "girder_az"),
    "pitch": ("pad_*_N", "pad_*_Fx", *VELOCITY_CHANNELS),
    "roll": ("pad_*_N",),
    "warp": ("pad_*_N",),
    "storeys": ("storey_*_ax", "girder_ax", "pad_*_N"),
    "motion": VELOCITY_CHANNELS,
}
#: Fewer samples of a run tell nothing.
LEAST_SAMPLES = 8
#: Relations that ring on with what was before.
_FROM_BEFORE = ("motion", "pitch")
#: How far a cut is felt in slip against accelerometers: 20 noise variances after 50 ms, none after 100 [s].
_CUT = 0.12
#: Pitch of a girder that lifts is 700 times the floor of its balance: it has rung down after so many of its decay
#: times [1], and never counts as ringing for longer than this [s].
_DECAYS, _LONGEST = 6.5, 3.0


def mask_judged_and_ringing(
    states: States, grounded: Mask, sliding: Mask, fast: Mask, pads: tuple[str, ...], invalid: Mapping[str, Mask]
) -> tuple[dict[str, Mask], Mask]:
    """Return the samples by which each relation of a run is judged, and those at which a pad lifts or pitch rings on.

    Args:
        states: of the run.
        grounded: as of `make_sample_masks`, like what follows.
        sliding: (n,).
        fast: (n,).
        pads: those measured.
        invalid: channel -> (n,).
    """
    kept = make_sample_masks(grounded, sliding, fast, mask_away_from_cuts(states.at_rest, states.dt), pads, invalid)
    ringing = mask_ringing_after_uplift(states.uplift, states.dt, states.specimen)
    kept = without_uplift(kept, ringing, states.uplift, states.dt)
    kept["roll"] = kept["roll"] & is_roll_known(states.record, states.has_y, states.specimen)
    return kept, ringing


def mask_balances_of_inertia(
    states: States, grounded: Mask, sliding: Mask, fast: Mask, invalid: Mapping[str, Mask]
) -> dict[str, Mask]:
    """Return the samples by which the balances along x and y are judged where no pad's friction was measured.

    While pads stick the law does not say what they carry together. Along y there is one where all that it is made of
    was measured.

    Args:
        states: of the run.
        grounded: as of `make_sample_masks`, like what follows.
        sliding: (n,).
        fast: (n,).
        invalid: channel -> (n,).
    """
    slides, storeys = states.specimen.slides, states.specimen.storeys
    along = (*storey_channels(storeys), *VELOCITY_CHANNELS)
    across = ("girder_ay", *storey_channels(storeys, "y"))

    def valid(*names: str) -> Mask:
        bad = [invalid[name] for name in names if name in invalid]
        return ~np.any(bad, axis=0) if bad else np.ones(len(grounded), dtype=bool)

    out = {"girder": grounded & (sliding | (not slides)) & valid(*along)}
    if states.has_y and states.record.has_all(*across):
        told = (sliding & fast) | (not slides)
        out["girder_y"] = grounded & told & valid(*across, "slip_y", *VELOCITY_CHANNELS)
    return out


def make_sample_masks(
    grounded: Mask, sliding: Mask, fast: Mask, whole: Mask, pads: tuple[str, ...], invalid: Mapping[str, Mask]
) -> dict[str, Mask]:
    """Return the samples by which each relation is judged: (n,), or (n, p) for pads and friction across.

    Args:
        grounded: (n,) every pad carries load.
        sliding: (n,) the law gives the force of a pad.
        fast: (n,) the direction of sliding is known.
        whole: (n,) what was before is known, see `mask_away_from_cuts`.
        pads: those measured.
        invalid: channel -> samples (n,) at which it is no measurement.
    """

    def valid(*names: str) -> Mask:
        bad = [mask for channel, mask in invalid.items() if any(fnmatchcase(channel, n) for n in names)]
        return ~np.any(bad, axis=0) if bad else np.ones(len(grounded), dtype=bool)

    out = {name: grounded & valid(*names) for name, names in _USES.items()}
    out |= dict.fromkeys(WARPS, out["warp"])
    for name in _FROM_BEFORE:
        out[name] &= whole
    moving = sliding & valid(*VELOCITY_CHANNELS)
    for name, axis, kept in (("pads", "x", moving), ("across", "y", moving & fast)):
        out[name] = np.stack([kept & valid(f"pad_{p}_N", f"pad_{p}_F{axis}") for p in pads], axis=1)
    return out


def mask_ringing_after_uplift(lifted: Mask, dt: float, specimen: Specimen) -> Mask:
    """Return samples at which the girder's pitch is not what its balance predicts: a pad lifts, or it rings from it.

    Args:
        lifted: (n,) a pad lifts.
        dt: sampling step [s].
        specimen: as rated.
    """
    if not specimen.free or not lifted.any():
        return lifted
    turn, lag = 2.0 * np.pi * pad_frequencies(specimen)["pitch"], specimen.pad_damping / specimen.pad_stiffness
    decay = 2.0 / (lag * turn**2) if lag else np.inf  # time in which pitch falls to 1/e
    return spread(lifted, 0, int(min(_DECAYS * decay, _LONGEST) / dt))


def is_rolling_only_at_rest(has_y: bool, specimen: Specimen) -> bool:
    """Return whether roll is judged before the motion only: with motion across, or with a pitch that turns into roll.

    Friction across, which a girder that rolls with its pitch calls up, is in no channel.
    """
    return specimen.free and (has_y or coupled(specimen))


def is_roll_known(record: Record, has_y: bool, specimen: Specimen) -> Mask:
    """Return the samples (n,) at which what rolls the girder was measured."""
    if not is_rolling_only_at_rest(has_y, specimen):
        return np.ones(len(record), dtype=bool)
    resting = find_rest_before_motion(record)
    return np.zeros(len(record), dtype=bool) if resting is None else resting


def without_uplift(
    kept: Mapping[str, Mask], ringing: Mask, lifted: Mask, dt: float
) -> dict[str, Mask]:  # fmt: skip
    """Return the samples by which each relation is judged, less those that a pad's lifting spoils.

    Args:
        kept: relation -> samples.
        ringing: (n,) of `mask_ringing_after_uplift`.
        lifted: (n,) a pad lifts: its load no longer says how the girder pitches.
        dt: sampling step [s].
    """
    # a frame sways on with what came before
    spoilt = {"pitch": ringing, "motion": mask_before_uplift(lifted, dt), "storeys": np.logical_or.accumulate(lifted)}
    return {name: mask & ~spoilt[name] if name in spoilt else mask for name, mask in kept.items()}


def without_estimated_loads(kept: Mapping[str, Mask]) -> dict[str, Mask]:
    """Return the samples by which each relation is judged where a load was made of the others by a rigid girder."""
    balances = {*WARPS, *(name for name, channels in _USES.items() if "pad_*_N" in channels)}
    return {name: np.zeros_like(mask) if name in balances else mask for name, mask in kept.items()}


def mask_before_uplift(lifted: Mask, dt: float) -> Mask:
    """Return the samples from which a pad's lifting is felt in slip against accelerometers, which look ahead, (n,)."""
    return spread(lifted, round(_CUT / dt), 0) if lifted.any() else lifted


def mask_away_from_cuts(at_rest: Mask, dt: float) -> Mask:
    """Return the samples whose past and future are known: not those where a record begins or ends in motion.

    What whitens the difference of slip and accelerometers reaches over the end of the record, and beyond it nobody
    knows how the slip bends; nor how the girder was pitching.

    Args:
        at_rest: (n,) the girder does not move over the table.
        dt: sampling step [s].
    """
    whole = np.ones(len(at_rest), dtype=bool)
    reach = round(_CUT / dt)
    if not at_rest[0]:
        whole[:reach] = False
    if not at_rest[-1]:
        whole[-reach:] = False
    return whole
