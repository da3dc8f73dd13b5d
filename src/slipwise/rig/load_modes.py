"""What moves the load on a pad: inertia (Factor A), rocking (Factor B), and the rest."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.channels import PAD_SIGNS
from slipwise.errors import InputError
from slipwise.record import Record

Array = NDArray[np.float64]
_SIGNS = np.array(PAD_SIGNS, dtype=float)
#: Rows: heave, pitch, roll, warp; columns: pads A to D. Its inverse is a quarter of its transpose.
_MODES = np.stack([np.ones(4), _SIGNS[:, 0], _SIGNS[:, 1], _SIGNS[:, 0] * _SIGNS[:, 1]])
#: The table is taken to rest while it accelerates less than this [m/s^2].
_QUIET = 0.05
#: Fewer samples at rest than this say nothing about the shares.
_ENOUGH = 10


@dataclass(frozen=True)
class LoadModes:
    """The four pads' loads as four orthogonal modes, each (n,) [N].

    Attributes:
        heave: sum of all pads.
        pitch: pads at +x (A, C) minus pads at -x (B, D).
        roll: pads at +y (A, B) minus pads at -y (C, D).
        warp: one diagonal (A, D) minus the other (B, C); equilibrium does not determine it.
    """

    heave: Array
    pitch: Array
    roll: Array
    warp: Array


@dataclass(frozen=True)
class LoadFactors:
    """The load of every pad split by its cause: inertia + rocking + rest = N.

    Attributes:
        shares: (4,) of the weight that each pad carries at rest [1].
        inertia: (n, 4) Factor A, share m (g + a_z) [N].
        rocking: (n, 4) Factor B, the pitch and roll modes of what inertia leaves [N].
        rest: (n, 4) heave and warp modes of what inertia leaves: another path of the load, bending, seating [N].
        weight: m g [N].
    """

    shares: Array
    inertia: Array
    rocking: Array
    rest: Array
    weight: float

    @property
    def inertia_swing(self) -> Array:
        """Half of largest minus smallest Factor A over the pad's load at rest, (4,) [1]."""
        return np.ptp(self.inertia, axis=0) / (2.0 * self.shares * self.weight)

    @property
    def rocking_swing(self) -> Array:
        """Half of largest minus smallest Factor B over the pad's load at rest, (4,) [1]."""
        return np.ptp(self.rocking, axis=0) / (2.0 * self.shares * self.weight)


def load_modes(loads: Array) -> LoadModes:
    """Turn the loads of pads A to D into heave, pitch, roll and warp.

    Args:
        loads: (n, 4) compression [N].

    Source: docs/theory.md, section 1.4; signs here are those of the pads' places, so pitch is positive with the +x
    side loaded.
    """
    heave, pitch, roll, warp = _MODES @ loads.T
    return LoadModes(heave, pitch, roll, warp)


def pad_loads(modes: LoadModes) -> Array:
    """Turn heave, pitch, roll and warp back into the loads of pads A to D, (n, 4) [N]."""
    return np.stack([modes.heave, modes.pitch, modes.roll, modes.warp], axis=1) @ _MODES / 4.0


def vertical_acceleration(record: Record) -> Array:
    """Give a_z of the girder's centre of gravity (n,) [m/s^2]: measured there, or as the mean of its two edges.

    Raises:
        InputError: neither was recorded.
    """
    if "girder_az" in record:
        return record["girder_az"]
    if record.has_all("girder_az_1", "girder_az_2"):
        return 0.5 * (record["girder_az_1"] + record["girder_az_2"])
    raise InputError("inertia needs girder_az, or girder_az_1 and girder_az_2; this record has neither")


def rest_shares(record: Record) -> Array:
    """Give the share of the weight on each pad (4,), summing to 1.

    Taken while the table rests at the start; from the whole record's mean where it begins in motion.
    """
    loads = record.stacked("pad_{}_N")
    moving = np.zeros(len(record), dtype=bool)
    for name in ("table_ax", "table_ay", "table_az"):
        if name in record:
            moving |= np.abs(record[name]) > _QUIET
    quiet = int(np.argmax(moving)) if moving.any() else len(record)
    mean = loads[: quiet if quiet >= _ENOUGH else len(record)].mean(axis=0)
    return mean / mean.sum()


def load_factors(record: Record, mass: float, gravity: float, shares: Array | None = None) -> LoadFactors:
    """Split every pad's load into inertia, rocking and the rest.

    Args:
        record: with pad_A_N ... pad_D_N and the girder's vertical acceleration.
        mass: of the girder [kg].
        gravity: [m/s^2].
        shares: (4,) of the weight on each pad; as the record shows at rest when not given.

    Raises:
        InputError: the record lacks a channel.

    Source: paper, "Factor A" and "Factor B"; docs/theory.md, section 1.4.
    """
    loads = record.stacked("pad_{}_N")
    shares = rest_shares(record) if shares is None else np.asarray(shares, dtype=float)
    inertia = mass * (gravity + vertical_acceleration(record))[:, None] * shares
    left = load_modes(loads - inertia)
    nothing = np.zeros(len(record))
    rocking = pad_loads(LoadModes(nothing, left.pitch, left.roll, nothing))
    return LoadFactors(shares, inertia, rocking, loads - inertia - rocking, mass * gravity)


def rigid_modes(
    record: Record,
    mass: float,
    gravity: float,
    centre_height: float,
    half_spacing: tuple[float, float],
    pads_on: str = "table",
) -> LoadModes:
    """Give the modes that equilibrium of a rigid girder asks for, from accelerations and slip alone.

    heave = m (g + a_z); pitch = (-m a_x h + x heave) / half_x; roll likewise; warp = 0. The term x heave (P-delta) is
    the weight that moves over pads which stand on the table. Buffers push at the sliding plane and turning is slow.

    Args:
        record: with girder_ax and the girder's vertical acceleration; girder_ay, slip_x, slip_y count as 0 if absent.
        mass: of the girder [kg].
        gravity: [m/s^2].
        centre_height: of the centre of gravity above the sliding plane [m].
        half_spacing: half the distance of the pads along x and y [m].
        pads_on: the side that carries the pads, "table" or "girder".

    Raises:
        InputError: the record lacks a channel.

    Source: docs/theory.md, sections 1.2 and 1.4, with z_b = 0.
    """
    nothing = np.zeros(len(record))
    heave = mass * (gravity + vertical_acceleration(record))
    sides = []
    for axis, half, acceleration in (
        ("x", half_spacing[0], record["girder_ax"]),
        ("y", half_spacing[1], record["girder_ay"] if "girder_ay" in record else nothing),
    ):
        slip = record[f"slip_{axis}"] if f"slip_{axis}" in record and pads_on == "table" else nothing
        sides.append((slip * heave - mass * acceleration * centre_height) / half)
    return LoadModes(heave, sides[0], sides[1], nothing)
