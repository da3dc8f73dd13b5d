"""What ties the instruments together without any friction law: balances of a rigid girder, and kinematics.

Every relation is a residual that is zero for true channels, linear in a few constants of the rig:

    heave      sum N - m (g + a_z)
    girder     sum F + m a_x + K x + sum m_i a_i       (y alike; with the storeys of a frame)
    pitch      half_x Q1 - x sum N + (m h) a_x + (K z_b) x + J Q1'',    Q1 = sum N_i x_i / half_x
    roll       half_y Q2 - y sum N + (m h) a_y + (K z_b) y + J Q2'',    Q2 = sum N_i y_i / half_y
               and of each a share of the other's second derivative where the pads stand unevenly
    warp       what is left of the loads: nothing of three pads, N_A - N_B - N_C + N_D of four; warp_2 ... of more
    along      x - double integral of (a_x - table a_x), both without what is slower than 0.8 Hz      (across alike)
    storey_1_along   the same of a floor's displacement and acceleration, and so on                   (across alike)
    upright    a_z - table a_z + c1 (sum N)'' + c2 (sum N)', and on curved sliders - (rise of their faces)''
    rest_*     an acceleration, or the slip's wandering, while nothing moves
    pair_*     F_A - F_C ..., pads that stand beside each other and carry like loads at like speed

Pairs only tell which of two cells; they accuse nobody, for pads differ. Warp does not accuse either: equilibrium does
not determine it.

Source: docs/theory.md, section 1.5; parity relations: Gertler, Fault Detection and Diagnosis in Engineering Systems,
1998.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.record import Record
from slipwise.rig import Specimen, storey_names
from slipwise.rig.curved_faces import risen
from slipwise.rig.frame import frame_moment, frame_push
from slipwise.rig.load_basis import basis_of, by_warp, end_pairs, warps
from slipwise.rig.load_modes import LoadModes, load_modes, vertical_acceleration
from slipwise.rig.rocking import coupled
from slipwise.signals.ends import in_frequency

Term = Callable[[Record, Specimen], Array]
#: Slower motion is left out where accelerations are integrated twice: their noise grows as 1/f^2 [Hz].
SLOWEST = 0.8


@dataclass(frozen=True)
class Relation:
    """One residual: known(record) + sum of constant * term(record).

    Attributes:
        name: "heave", "girder_x" ...
        needs: channels without which it does not exist.
        known: the part without constants, (n,).
        terms: constant's name -> its factor, (n,). Constants of one name are one number in all relations.
        accuses: whether a fault may be named for its sake.
        rows: "moving" (whole run), "inner" (ends left out, where integration starts), "quiet" (while nothing moves)
            or "wander" (quiet, each stretch without its mean).
    """

    name: str
    needs: tuple[str, ...]
    known: Term
    terms: Mapping[str, Term]
    accuses: bool = True
    rows: str = "moving"

    def looks_at(self, record: Record) -> frozenset[str]:
        """Return the channels that the relation looks at: what it needs, and what it takes where it is there."""
        extra = {"roll": ("girder_ay", "slip_y"), "pitch": ("slip_x",)}.get(self.name, ())
        return frozenset((*self.needs, *(name for name in extra if name in record)))


def list_rigid_balances(record: Record, specimen: Specimen) -> tuple[list[Relation], list[str]]:
    """Return the relations that these channels allow, and in words those that they do not.

    Args:
        record: of a run, with the channels that all runs have.
        specimen: with its pads; a rig whose slip is prescribed has no balances.
    """
    possible = [*_rest(record)]
    if specimen.free:
        loads = list_loads(specimen)
        possible += [
            _heave(record, loads),
            *(_warp(name, loads) for name in warps(specimen)),
            _upright(record, specimen),
        ]
        for axis in ("x", "y"):
            possible += [_girder(axis, specimen), _tilting(axis, record, specimen), _kinematic(axis, record, loads)]
            possible += [_floor(axis, storey) for storey in storey_names(specimen.storeys)]
            possible += _pairs(axis, specimen)
    kept = [relation for relation in possible if record.has_all(*relation.needs)]
    missing = {r.name: [n for n in r.needs if n not in record] for r in possible if r not in kept}
    forceless = not any(name.startswith("pad_") for name in record.channels)
    of_pads = [name for name, needed in missing.items() if forceless and any(n.startswith("pad_") for n in needed)]
    cannot = [
        f"{name}: channel missing, cannot test ({', '.join(needed)})"
        for name, needed in missing.items()
        if name not in of_pads and not name.endswith(("_y", "_along", "_across"))
    ]
    if of_pads and specimen.free:
        cannot.append(
            f"{', '.join(n for n in of_pads if n[-2:] != '_y')}: no load and no friction of a pad was measured"
        )
    if not specimen.free:
        cannot.append("balances: the slip is prescribed, no girder ties forces to accelerations")
    return kept, cannot


def list_loads(specimen: Specimen) -> tuple[str, ...]:
    """Return the channels of the loads of all pads."""
    return tuple(f"pad_{pad}_N" for pad in specimen.pads)


def _sum(record: Record, specimen: Specimen, kind: str) -> Array:
    return np.sum([record[f"pad_{pad}_{kind}"] for pad in specimen.pads], axis=0)


def _modes(record: Record, specimen: Specimen) -> LoadModes:
    return load_modes(record.stacked("pad_{}_N", specimen.pads), basis_of(specimen))


def _twice(values: Array, dt: float) -> Array:
    """Return the second derivative (n,) by five points; at the ends, which nobody looks at, by fewer."""
    return np.convolve(values, np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / (12.0 * dt * dt), mode="same")


def _heave(record: Record, loads: tuple[str, ...]) -> Relation:
    needs = ("girder_az",) if "girder_az" in record else ("girder_az_1", "girder_az_2")
    return Relation(
        "heave",
        (*loads, *needs),
        lambda r, s: _sum(r, s, "N") - (s.carried_mass - s.mass) * (s.gravity + vertical_acceleration(r)),
        {"mass": lambda r, s: -(s.gravity + vertical_acceleration(r))},
    )


def _girder(axis: str, specimen: Specimen) -> Relation:
    return Relation(
        f"girder_{axis}",
        (
            *(f"pad_{pad}_F{axis}" for pad in specimen.pads),
            *(f"{storey}_a{axis}" for storey in storey_names(specimen.storeys)),
            *(f"girder_a{axis}", f"slip_{axis}"),
        ),
        lambda r, s: _sum(r, s, f"F{axis}") - frame_push(r, s, axis),
        {"mass": lambda r, s: r[f"girder_a{axis}"], f"stiffness_{axis}": lambda r, s: r[f"slip_{axis}"]},
    )


def _tilting(axis: str, record: Record, specimen: Specimen) -> Relation:
    """Pitch (about y, from motion along x) or roll."""
    name, place = ("pitch", 0) if axis == "x" else ("roll", 1)

    def mode(r: Record, s: Specimen) -> Array:
        modes = _modes(r, s)
        return modes.pitch if axis == "x" else modes.roll

    def known(r: Record, s: Specimen) -> Array:
        moment = s.half_spacing[place] * mode(r, s)
        off = (s.centre_x, s.centre_y)[place] - s.middle[place]
        if off:
            moment = moment - off * _sum(r, s, "N")
        if s.pads_on == "table" and f"slip_{axis}" in r:
            moment = moment - r[f"slip_{axis}"] * _sum(r, s, "N")
        return moment - frame_moment(r, s.storeys, s.gravity + _upward(r), axis)

    terms: dict[str, Term] = {
        f"{name}_inertia": lambda r, s: _twice(mode(r, s), r.dt),
    }
    if coupled(specimen):  # uneven pads turn pitch into roll
        terms[f"{name}_coupling"] = lambda r, s: _twice(_modes(r, s).roll if axis == "x" else _modes(r, s).pitch, r.dt)
    if f"girder_a{axis}" in record:
        terms["lever"] = lambda r, s: r[f"girder_a{axis}"]
    if f"slip_{axis}" in record:
        terms[f"buffer_lever_{axis}"] = lambda r, s: r[f"slip_{axis}"]
    loads, storeys = list_loads(specimen), tuple(f"{storey}_a{axis}" for storey in storey_names(specimen.storeys))
    # friction across holds a girder that rolls with its pitch
    across = ("girder_ay",) if axis == "y" and coupled(specimen) else ()
    needs = (*loads, *storeys, "girder_ax", "slip_x") if axis == "x" else (*loads, *storeys, *across)
    return Relation(name, needs, known, terms)


def _upward(record: Record) -> Array:
    """Return the girder's vertical acceleration (n,) [m/s^2]; nothing where it was not measured."""
    known = "girder_az" in record or record.has_all("girder_az_1", "girder_az_2")
    return vertical_acceleration(record) if known else np.zeros(len(record))


def _warp(name: str, loads: tuple[str, ...]) -> Relation:
    return Relation(name, loads, lambda r, s: by_warp(s, r.stacked("pad_{}_N", s.pads))[name], {}, accuses=False)


def without_slow(values: Array, dt: float, integrations: int) -> Array:
    """Integrate a number of times and leave out what is slower than 0.8 Hz, (n,)."""

    def gain(frequency: Array) -> NDArray[np.complex128]:
        ratio = (frequency / SLOWEST) ** 4
        turn = 2j * np.pi * np.maximum(frequency, 1e-9)
        return ratio / (1.0 + ratio) / turn**integrations

    return in_frequency(values, dt, gain, int(2.0 / (SLOWEST * dt)))


def _kinematic(axis: str, record: Record, loads: tuple[str, ...]) -> Relation:
    """Slip against accelerations; where the girder leans the loads say so, or without any load its own inertia."""

    def known(r: Record, s: Specimen) -> Array:
        relative = r[f"girder_a{axis}"] - r[f"table_a{axis}"]
        return without_slow(r[f"slip_{axis}"], r.dt, 0) - without_slow(relative, r.dt, 2)

    terms: dict[str, Term] = {}
    weighed = any(name in record for name in loads)
    if axis == "x" and weighed:
        terms["lean"] = lambda r, s: without_slow(_modes(r, s).pitch, r.dt, 0)
    elif axis == "x":
        terms["lean"] = lambda r, s: without_slow(r[f"girder_a{axis}"], r.dt, 0)
    needs = (f"girder_a{axis}", f"table_a{axis}", f"slip_{axis}", *(loads if axis == "x" and weighed else ()))
    return Relation("along" if axis == "x" else "across", needs, known, terms, rows="inner")


def _floor(axis: str, storey: str) -> Relation:
    """A floor's displacement against its acceleration, both from the table."""

    def known(r: Record, s: Specimen) -> Array:
        relative = r[f"{storey}_a{axis}"] - r[f"table_a{axis}"]
        return without_slow(r[f"{storey}_d{axis}"], r.dt, 0) - without_slow(relative, r.dt, 2)

    needs = (f"{storey}_a{axis}", f"table_a{axis}", f"{storey}_d{axis}")
    return Relation(f"{storey}_{'along' if axis == 'x' else 'across'}", needs, known, {}, rows="inner")


def _upright(record: Record, specimen: Specimen) -> Relation:
    needs = ("girder_az",) if "girder_az" in record else ("girder_az_1", "girder_az_2")
    curved = any(place.curvature for place in specimen.places)
    slips = ("slip_x", *(("slip_y",) if "slip_y" in record else ())) if curved else ()

    def known(r: Record, s: Specimen) -> Array:
        upward = vertical_acceleration(r) - r["table_az"]
        if not curved:
            return upward
        across = r["slip_y"] if "slip_y" in slips else np.zeros(len(r))
        return upward - _twice(risen(np.stack([r["slip_x"], across], axis=1), s), r.dt)

    return Relation(
        "upright",
        (*list_loads(specimen), "table_az", *needs, *slips),
        known,
        {
            "sag": lambda r, s: _twice(_sum(r, s, "N"), r.dt),
            "sag_rate": lambda r, s: np.gradient(_sum(r, s, "N"), r.dt),
        },
    )


def _rest(record: Record) -> list[Relation]:
    found = [
        Relation(f"rest_{name}", (name,), lambda r, s, name=name: r[name], {}, rows="quiet")
        for name in record.channels
        if name.startswith(("girder_a", "table_a"))
    ]
    for name in ("slip_x", "slip_y", "yaw"):
        if name in record:
            found.append(Relation(f"rest_{name}", (name,), lambda r, s, name=name: r[name], {}, rows="wander"))
    return found


def _pairs(axis: str, specimen: Specimen) -> list[Relation]:
    found = []
    for one, other in end_pairs(specimen):
        forces = (f"pad_{one}_F{axis}", f"pad_{other}_F{axis}")
        loads = (f"pad_{one}_N", f"pad_{other}_N")

        def known(r: Record, s: Specimen, forces: tuple[str, str] = forces) -> Array:
            return r[forces[0]] - r[forces[1]]

        def share(r: Record, s: Specimen, f: tuple[str, str] = forces, n: tuple[str, str] = loads) -> Array:
            total = np.maximum(np.abs(r[n[0]] + r[n[1]]), 1.0)
            return -(r[f[0]] + r[f[1]]) * (r[n[0]] - r[n[1]]) / total

        name = f"pair_{one}{other}_{axis}"
        found.append(Relation(name, (*forces, *loads), known, {f"share_{one}{other}": share}, accuses=False))
    return found
