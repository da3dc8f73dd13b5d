"""Where the parts of a rig's MJCF file stand: read where a specimen has the place, else held to what a replay has."""

import numpy as np

from slipwise.rig.mjcf.file import Mjcf
from slipwise.rig.mjcf.inertia import girder_body
from slipwise.rig.mjcf.parts import buffers_of, is_free, names_of, pads_of

Places = tuple[tuple[float, float], ...]
#: Lengths that differ by less are the same [m]: a thousandth of how far a pad sinks.
_SAME = 1e-7
#: What a plate of 20 m may be off its pad and still lie on it at any slip of a replay [m].
_OFF = 4.0


def pad_places(file: Mjcf) -> Places:
    """Return the places of the pads from the middle of the table (n_pads, 2) [m].

    Raises:
        InputError: a free girder's pads stand all on one side of its centre of gravity.
    """
    pads = pads_of(file)
    places = np.array([file.model.geom(f"pad_{pad}").pos[:2] for pad in pads])
    if is_free(file.model):
        centre = girder_body(file).centre
        for axis, word in enumerate("xy"):
            arms = places[:, axis] - centre[axis]
            if np.all(arms > 0.0) or np.all(arms < 0.0):
                raise file.refused(
                    f"the pads cannot carry: all stand on one side of the girder's centre of gravity ({word} = "
                    f"{centre[axis]:g} m); it must lie between them",
                    "geom",
                    f"pad_{pads[0]}",
                )
    return tuple((float(x), float(y)) for x, y in places)


def pad_radii(file: Mjcf) -> tuple[float, ...]:
    """Return the radius of each pad (n_pads,) [m]."""
    return tuple(float(file.model.geom(f"pad_{pad}").size[0]) for pad in pads_of(file))


def seating(file: Mjcf) -> tuple[float, ...]:
    """Return the height of each pad above the sliding plane (n_pads,) [m].

    Raises:
        InputError: a plate does not lie on its pad, or no pad reaches it, or the girder is inside its pads.
    """
    model, pads = file.model, pads_of(file)
    height = float(model.body("girder").pos[2])
    for pad in pads:
        plate = model.geom(f"plate_{pad}")
        low = height + float(plate.pos[2]) - float(plate.size[2])
        if not abs(low) <= _SAME:
            where = f"{-low * 1e3:g} mm inside the pads" if low < 0.0 else f"{low * 1e3:g} mm above the pads"
            raise file.refused(
                f"the lower face of plate_{pad} lies {where} (z = {low:g} m); it must be the sliding plane, z = 0: "
                f"with the girder at z = {height:g} m: pos z = {float(plate.size[2]) - height:g}",
                "geom",
                f"plate_{pad}",
            )
        off = np.array(model.body("girder").pos[:2]) + plate.pos[:2] - model.geom(f"pad_{pad}").pos[:2]
        if not np.all(np.abs(off) <= _OFF):
            raise file.refused(
                f"plate_{pad} lies {off[0]:g}, {off[1]:g} m off pad_{pad}; it must lie above its pad, however far the "
                f"girder slips: within {_OFF:g} m",
                "geom",
                f"plate_{pad}",
            )
    tops = np.array([model.geom(f"pad_{pad}").pos[2] + model.geom(f"pad_{pad}").size[0] for pad in pads])
    tops[np.abs(tops) <= _SAME] = 0.0
    if tops.min() > 0.0 or tops.max() < 0.0:
        nearest = float(tops[np.argmin(np.abs(tops))])
        what = "the girder begins inside its pads, by" if nearest > 0.0 else "the girder begins above its pads, by"
        raise file.refused(
            f"{what} {abs(nearest) * 1e3:g} mm or more; the tops of the pads (pos z + radius) lie about the sliding "
            "plane, z = 0",
            "geom",
            f"pad_{pads[0]}",
        )
    return tuple(float(top) for top in tops)


def edge_distance(file: Mjcf) -> float:
    """Return how far the two gauges at the girder's edges are from its centre of gravity, along x [m].

    Raises:
        InputError: a site of a gauge is missing or stands elsewhere.
    """
    model, sites = file.model, names_of(file.model, "site")
    offset = girder_body(file).centre - np.array(model.body("girder").pos)
    if "girder_centre" in sites:
        off = np.array(model.site("girder_centre").pos) - offset
        if not np.allclose(off, 0.0, atol=_SAME):
            raise file.refused(
                f"the site girder_centre stands off the centre of gravity by {off[0]:g}, {off[1]:g}, {off[2]:g} m; the "
                "girder's acceleration is recorded at its centre of gravity: leave the site out or move it there",
                "site",
                "girder_centre",
            )
    if not is_free(model):
        return 1.5
    for name in ("girder_edge_1", "girder_edge_2"):
        if name not in sites:
            raise file.refused(f"it lacks the site {name} of a gauge on the girder; copy it from bridge1.xml")
    edges = np.array([model.site(f"girder_edge_{i}").pos - offset for i in (1, 2)])
    if not np.allclose(edges[0, :2], -edges[1, :2], atol=_SAME) or abs(edges[0, 1]) > _SAME or edges[0, 0] <= 0.0:
        raise file.refused(
            f"the gauges girder_edge_1 and _2 stand at {edges[0, 0]:g}, {edges[0, 1]:g} and {edges[1, 0]:g}, "
            f"{edges[1, 1]:g} m from the centre of gravity; they must stand at +x and -x of it, as far on both sides",
            "site",
            "girder_edge_1",
        )
    return float(edges[0, 0])


def buffer_places(file: Mjcf) -> Places:
    """Return the places of the buffers from the middle of the table (n_buffers, 2) [m]."""
    places = (file.model.geom(f"buffer_{buffer}").pos for buffer in buffers_of(file))
    return tuple((float(place[0]), float(place[1])) for place in places)
