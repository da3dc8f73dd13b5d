"""What moves the load on a pad: inertia (Factor A), rocking (Factor B), and the rest."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from slipwise.arrays import Array
from slipwise.errors import InputError
from slipwise.record import Record
from slipwise.rig.frame import frame_moment, storey_channels
from slipwise.rig.load_basis import LoadBasis
from slipwise.rig.storeys import Storey

#: The table is taken to rest while it accelerates less than this [m/s^2].
_QUIET = 0.05
#: Fewer samples at rest than this say nothing about the shares.
_ENOUGH = 10


@dataclass(frozen=True)
class LoadModes:
    """The loads of n pads as n modes, each [N].

    Attributes:
        heave: sum of all pads (n_times,).
        pitch: sum of the loads times their places along x, 1 at the farthest pad: of a rectangle's pads those at +x
            minus those at -x (n_times,).
        roll: the same along y (n_times,).
        warp: what is left, which equilibrium does not determine: nothing of three pads, of four one diagonal minus the
            other, (n_times, n - 3).
    """

    heave: Array
    pitch: Array
    roll: Array
    warp: Array


@dataclass(frozen=True)
class LoadFactors:
    """The load of every pad split by its cause: inertia + rocking + rest = N.

    Attributes:
        shares: (p,) of the weight that each pad carries at rest [1].
        inertia: (n, p) Factor A, share m (g + a_z) [N].
        rocking: (n, p) Factor B, the pitch and roll modes of what inertia leaves [N].
        rest: (n, p) heave and warp modes of what inertia leaves: another path of the load, bending, seating [N].
        weight: m g [N].
    """

    shares: Array
    inertia: Array
    rocking: Array
    rest: Array
    weight: float

    @property
    def inertia_swing(self) -> Array:
        """Half of largest minus smallest Factor A over the pad's load at rest, (p,) [1]."""
        return np.ptp(self.inertia, axis=0) / (2.0 * self.shares * self.weight)

    @property
    def rocking_swing(self) -> Array:
        """Half of largest minus smallest Factor B over the pad's load at rest, (p,) [1]."""
        return np.ptp(self.rocking, axis=0) / (2.0 * self.shares * self.weight)


def load_modes(loads: Array, basis: LoadBasis) -> LoadModes:
    """Turn the loads of the pads into heave, pitch, roll and warp: their projections on 1, x and y, and what is left.

    Args:
        loads: (n_times, n_pads) compression [N].
        basis: of the pads, in the same order.

    Source: docs/theory.md, section 1.4; signs here are those of the pads' places, so pitch is positive with the +x
    side loaded.
    """
    heave, pitch, roll = basis.rigid @ loads.T
    return LoadModes(heave, pitch, roll, (basis.warp @ loads.T).T)


def pad_loads(modes: LoadModes, basis: LoadBasis) -> Array:
    """Turn heave, pitch, roll and warp back into the loads of the pads, (n_times, n_pads) [N]."""
    return np.column_stack([modes.heave, modes.pitch, modes.roll, modes.warp]) @ basis.inverse


def vertical_acceleration(record: Record) -> Array:
    """Return a_z of the girder's centre of gravity (n,) [m/s^2]: measured there, or as the mean of its two edges.

    Raises:
        InputError: neither was recorded.
    """
    if "girder_az" in record:
        return record["girder_az"]
    if record.has_all("girder_az_1", "girder_az_2"):
        return 0.5 * (record["girder_az_1"] + record["girder_az_2"])
    raise InputError("inertia needs girder_az, or girder_az_1 and girder_az_2; this record has neither")


def rest_shares(record: Record, pads: Sequence[str] | None = None) -> Array:
    """Return the share of the weight on each pad (p,), summing to 1; of the record's pads when none are named.

    Taken while the table rests at the start; from the whole record's mean where it begins in motion.
    """
    loads = record.stacked("pad_{}_N", pads)
    moving = np.zeros(len(record), dtype=bool)
    for name in ("table_ax", "table_ay", "table_az"):
        if name in record:
            moving |= np.abs(record[name]) > _QUIET
    quiet = int(np.argmax(moving)) if moving.any() else len(record)
    mean = loads[: quiet if quiet >= _ENOUGH else len(record)].mean(axis=0)
    return mean / mean.sum()


def load_factors(
    record: Record, mass: float, gravity: float, basis: LoadBasis, shares: Array | None = None,
    pads: Sequence[str] | None = None,
) -> LoadFactors:  # fmt: skip
    """Split every pad's load into inertia, rocking and the rest.

    Args:
        record: with the load of every pad and the girder's vertical acceleration.
        mass: of all that the pads carry [kg].
        gravity: [m/s^2].
        basis: of the pads.
        shares: (p,) of the weight on each pad; as the record shows at rest when not given.
        pads: their names in the order of the basis; those of the record when not given.

    Raises:
        InputError: the record lacks a channel.

    Source: paper, "Factor A" and "Factor B"; docs/theory.md, section 1.4.
    """
    loads = record.stacked("pad_{}_N", pads)
    shares = rest_shares(record, pads) if shares is None else np.asarray(shares, dtype=float)
    inertia = mass * (gravity + vertical_acceleration(record))[:, None] * shares
    left = load_modes(loads - inertia, basis)
    rocking = pad_loads(LoadModes(np.zeros(len(record)), left.pitch, left.roll, np.zeros_like(left.warp)), basis)
    return LoadFactors(shares, inertia, rocking, loads - inertia - rocking, mass * gravity)


def rigid_modes(
    record: Record,
    mass: float,
    gravity: float,
    centre_height: float,
    half_spacing: tuple[float, float],
    pads_on: str = "table",
    storeys: Sequence[Storey] = (),
) -> LoadModes:
    """Return the modes that equilibrium of a rigid girder asks for, from accelerations and slip alone.

    heave = m (g + a_z); pitch = (-m a_x h + x heave) / half_x; roll likewise; warp = 0. The term x heave (P-delta) is
    the weight that moves over pads which stand on the table. Buffers push at the sliding plane and turning is slow.
    Storeys add their mass to heave and their moment to pitch and roll.

    Args:
        record: with girder_ax and the girder's vertical acceleration; girder_ay, slip_x, slip_y count as 0 if absent.
        mass: of the girder [kg].
        gravity: [m/s^2].
        centre_height: of the centre of gravity above the sliding plane [m].
        half_spacing: half the distance of the pads along x and y [m].
        pads_on: the side that carries the pads, "table" or "girder".
        storeys: of a frame that stands on the girder; along y they count as still where they were not measured.

    Raises:
        InputError: the record lacks a channel.

    Source: docs/theory.md, sections 1.2 and 1.4, with z_b = 0.
    """
    nothing = np.zeros(len(record))
    felt = gravity + vertical_acceleration(record)
    heave = (mass + sum(storey.mass for storey in storeys)) * felt
    if storeys:
        record.stacked("{}", storey_channels(storeys))  # raises where one was not measured
    sides = []
    for axis, half, acceleration in (
        ("x", half_spacing[0], record["girder_ax"]),
        ("y", half_spacing[1], record["girder_ay"] if "girder_ay" in record else nothing),
    ):
        slip = record[f"slip_{axis}"] if f"slip_{axis}" in record and pads_on == "table" else nothing
        framed = frame_moment(record, storeys, felt, axis)
        sides.append((slip * heave - mass * acceleration * centre_height + framed) / half)
    return LoadModes(heave, sides[0], sides[1], np.zeros((len(record), 0)))
