"""Loads of pads that no cell weighed, from the weight and from what inertia turns the girder over with.

    sum N = (m + sum m_i) (g + a_z)
    M_x   = P(s) [x_c sum N + x sum N - m h a_x - sum m_i a_i z_i + sum m_i (g + a_z) u_i - K z_b x]      (y alike)

about the middle of the pads on the sliding plane; x is there where the pads stand on the table. A rigid girder on the
pads' springs gives each pad its share. At rest the loads are those of the rated seating. Where no vertical acceleration
was measured the weight is taken as constant.

Source: docs/theory.md, sections 1.2 and 1.4.
"""

from collections.abc import Mapping

import numpy as np

from slipwise.arrays import Array
from slipwise.noise.gauges import Gauge
from slipwise.record import Record
from slipwise.rig import Specimen, pad_frequencies
from slipwise.rig.frame import frame_moment, storey_channels
from slipwise.rig.load_modes import vertical_acceleration
from slipwise.rig.rocking import rocking_modes
from slipwise.rig.statics import at_rest
from slipwise.signals.pitch import pass_through_pitch


def estimate_loads_by_inertia(record: Record, specimen: Specimen) -> Array:
    """Return the loads of all pads (n, n_pads) [N], nowhere below zero.

    Args:
        record: with the girder's accelerations and those of its storeys, as far as they were measured.
        specimen: of a girder that is free.
    """
    upward = _upward(record)
    rest = at_rest(specimen).load
    total = specimen.carried_mass * (specimen.gravity + upward)
    moments = [_overturning(record, specimen, axis, upward, total) for axis in "xy"]
    rocked = _rocked(specimen, moments, record.dt)
    more = np.stack([total - specimen.weight, *rocked], axis=1)
    return np.maximum(rest + more @ _shares(specimen).T, 0.0)


def estimate_load_errors(specimen: Specimen, gauges: Mapping[str, Gauge]) -> Array:
    """Return what the noise of the accelerometers makes of the estimated load of each pad, (n_pads,) [N]."""

    def level(name: str) -> float:
        return gauges[name].level if name in gauges else 0.0

    heave = specimen.carried_mass * level("girder_az")
    tilting = []
    for axis in "xy":
        heights = [specimen.mass * specimen.centre_height * level(f"girder_a{axis}")]
        heights += [
            storey.mass * storey.z * level(name)
            for storey, name in zip(specimen.storeys, storey_channels(specimen.storeys, axis), strict=True)
        ]
        tilting.append(float(np.linalg.norm(heights)))
    return np.sqrt((_shares(specimen) ** 2) @ np.array([heave, *tilting]) ** 2)


def _upward(record: Record) -> Array:
    if "girder_az" in record or record.has_all("girder_az_1", "girder_az_2"):
        return vertical_acceleration(record)
    return record["table_az"] if "table_az" in record else np.zeros(len(record))


def _overturning(record: Record, specimen: Specimen, axis: str, upward: Array, total: Array) -> Array:
    """Return the moment of weight and inertia that loads the pads at the + end, less that of the weight at rest."""
    place = "xy".index(axis)
    off = (specimen.centre_x, specimen.centre_y)[place] - specimen.middle[place]
    moment = off * (total - specimen.weight)
    moment = moment + frame_moment(record, specimen.storeys, specimen.gravity + upward, axis)
    if f"girder_a{axis}" in record:
        moment = moment - specimen.mass * specimen.centre_height * record[f"girder_a{axis}"]
    if f"slip_{axis}" in record:
        held = sum(getattr(buffer, f"stiffness_{axis}") * buffer.z for buffer in specimen.buffers)
        moment = moment - held * record[f"slip_{axis}"]
        if specimen.pads_on == "table":
            moment = moment + record[f"slip_{axis}"] * total
    return moment


def _rocked(specimen: Specimen, moments: list[Array], dt: float) -> list[Array]:
    """Return the moments along x and y that the loads have when the girder rocks on its pads."""
    lag = specimen.pad_damping / specimen.pad_stiffness
    frequency = pad_frequencies(specimen)["pitch"]
    damping = 0.5 * lag * 2.0 * np.pi * frequency
    out = [np.zeros(len(moments[0])), np.zeros(len(moments[0]))]
    for mode in rocking_modes(specimen):
        driven = mode.drive[0] * moments[1] + mode.drive[1] * moments[0]
        if np.any(driven):
            passed = pass_through_pitch(driven, dt, mode.ratio * frequency, mode.ratio * damping)
            out = [out[0] + mode.shown[1] * passed, out[1] + mode.shown[0] * passed]
    return out


def _shares(specimen: Specimen) -> Array:
    """Return what a unit of load, and of moment along x and y, adds to each pad (n_pads, 3) [1, 1/m, 1/m]."""
    springs = np.array(specimen.springs)
    off = np.array(specimen.pad_places) - specimen.middle
    shape = np.column_stack([np.ones(len(springs)), off])
    return springs[:, None] * shape @ np.linalg.inv(shape.T @ (springs[:, None] * shape))
