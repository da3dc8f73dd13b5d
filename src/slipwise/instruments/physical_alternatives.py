"""Physics that could disturb the balances competes with the suspects, so that an uneven rig is not called a bad gauge.

No friction law: only forces that act on the girder beside the pads, ways of the load beside the pads, and differences
between pads. Each alternative has one or more free numbers, each with its columns in one or more relations.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from slipwise.channels import PADS
from slipwise.instruments.balances import Relation
from slipwise.instruments.rows import Block, Held
from slipwise.record import Record
from slipwise.signals import derivative

Array = NDArray[np.float64]
#: What one free number adds: relation -> a signal for each run.
Term = Mapping[str, Sequence[Array]]
_CLEARANCES = (1e-4, 2e-4, 4e-4, 7e-4, 1.2e-3, 2e-3, 3e-3)
_MEMORIES = (2e-4, 1e-3, 3e-3)
_SOFTENINGS = (3e-3, 1e-2, 3e-2)
_BENDING = tuple(np.geomspace(4.0, 36.0, 36))
_DAMPINGS = (0.01, 0.03)
#: Travel of the pads' load over which friction at a key turns, in mean loads [1].
_KEY_TURNS = (0.02, 0.1)


@dataclass(frozen=True)
class Alternative:
    """A physical explanation.

    Attributes:
        name: of the effect in the catalogue, or in words.
        columns: relation -> (n, q) over its rows.
        width: q, how many numbers it may choose freely.
    """

    name: str
    columns: Block
    width: int


def alternatives(runs: Sequence[Held], relations: Sequence[Relation]) -> list[Alternative]:
    """Give the physical explanations that these relations allow."""
    known = {relation.name: relation for relation in relations}
    found = []
    for name, terms in _all(runs, known):
        columns: dict[str, Array] = {}
        for k, term in enumerate(terms):
            for place, signals in term.items():
                if place in known:
                    kind = known[place].rows
                    rows = np.concatenate([run.rows(s, kind) for run, s in zip(runs, signals, strict=True)])
                    columns.setdefault(place, np.zeros((len(rows), len(terms))))[:, k] = rows
        if any(np.any(block) for block in columns.values()):
            found.append(Alternative(name, columns, len(terms)))
    return found


def _all(runs: Sequence[Held], known: Mapping[str, Relation]) -> Iterator[tuple[str, list[Term]]]:
    for axis in ("x", "y"):
        if f"girder_{axis}" in known:
            yield from _along(runs, axis)
    if "heave" in known:
        yield from _heaving(runs)
    if "roll" in known:
        yield from _uneven(runs)
    for axis in ("x", "y"):
        pairs = [name for name in known if name.startswith("pair_") and name.endswith(f"_{axis}")]
        if pairs:
            yield from _pads(runs, pairs, axis)


def _along(runs: Sequence[Held], axis: str) -> Iterator[tuple[str, list[Term]]]:
    """Forces beside the pads in the girder's own balance."""
    slips = [run.record[f"slip_{axis}"] for run in runs]
    rates = [derivative(x, run.record.dt) for x, run in zip(slips, runs, strict=True)]
    balance = f"girder_{axis}"
    yield "buffer_damping", [{balance: rates}, {balance: [v * np.abs(v) for v in rates]}]
    yield "buffer_hardening", [{balance: [x**p for x in slips]} for p in (3, 5)]
    for length in _MEMORIES:
        yield "buffer_hysteresis", [{balance: [turning(x, length) for x in slips]}]
    for gap in _CLEARANCES:
        yield "key_clearance", [{balance: [-np.clip(x, -gap, gap) for x in slips]}]
    for length in _SOFTENINGS:
        largest, softer = 0.0, []
        for x in slips:
            reached = np.maximum.accumulate(np.maximum(np.abs(x), largest))
            largest = float(reached[-1])
            softer.append(x * np.exp(-reached / length))
        yield "buffer_softening", [{balance: softer}]
    if axis == "x" and all("table_ax" in run.record for run in runs):
        pushes = [run.record["table_ax"] for run in runs]
        yield "table_pitch", [{balance: pushes}, {"pitch": pushes}]


def _heaving(runs: Sequence[Held]) -> Iterator[tuple[str, list[Term]]]:
    """Ways of the load beside the pads, and a girder that bends."""
    if all("slip_x" in run.record for run in runs):
        slips = [np.abs(run.record["slip_x"]) for run in runs]
        for length in _KEY_TURNS:
            # the girder's height over the pads is -sum N / (4 k): its direction is that of -d(sum N)/dt
            turns = [turning(-n / n.mean(), length) for n in totals(runs)]
            rubbing = [x * t for x, t in zip(slips, turns, strict=True)]
            yield "key_friction", [{"heave": rubbing}, {"pitch": rubbing}]
        yield "buffer carries weight", [{"heave": slips}, {"heave": [x**2 for x in slips]}]
    shakes = [_vertical(run.record) for run in runs]
    for frequency in _BENDING:
        for damping in _DAMPINGS:
            bent = [_oscillator(a, run.record.dt, frequency, damping) for a, run in zip(shakes, runs, strict=True)]
            yield "girder_bending", [{"heave": bent}, {"upright": bent}]


def _vertical(record: Record) -> Array:
    return record[next(n for n in ("table_az", "girder_az", "girder_az_1") if n in record)]


def totals(runs: Sequence[Held]) -> list[Array]:
    """Give the sum of the pads' loads of each run."""
    return [np.sum([run.record[f"pad_{pad}_N"] for pad in PADS], axis=0) for run in runs]


def _uneven(runs: Sequence[Held]) -> Iterator[tuple[str, list[Term]]]:
    """A centre of gravity off the middle, and pads that do not stand in one plane."""
    # off the middle, one side carries a share of everything that the pads carry
    carried = totals(runs)
    yield "mass_eccentricity", [{"pitch": carried}]
    yield "mass_eccentricity", [{"roll": carried}]
    yield "mass_eccentricity", [{"pitch": carried}, {"roll": carried}]
    yield "uneven_seating", [{"warp": [np.ones(len(run.record)) for run in runs]}]
    moving = [n for n in ("girder_ax", "girder_az") if all(n in run.record for run in runs)]
    yield "pads of unequal stiffness", [{"warp": [run.record[n] for run in runs]} for n in moving]


def _pads(runs: Sequence[Held], pairs: Sequence[str], axis: str) -> Iterator[tuple[str, list[Term]]]:
    """Pads that differ in friction, in tilt, or in speed because the girder turns."""
    spread: list[Term] = []
    tilt: list[Term] = []
    yaw: dict[str, Sequence[Array]] = {}
    for name in pairs:
        one, other = name[5], name[6]
        forces = [0.5 * (r.record[f"pad_{one}_F{axis}"] + r.record[f"pad_{other}_F{axis}"]) for r in runs]
        loads = [0.5 * (r.record[f"pad_{one}_N"] + r.record[f"pad_{other}_N"]) for r in runs]
        spread.append({name: forces})
        tilt += [{name: loads}, {name: [np.abs(f) for f in forces]}]
        yaw[name] = [derivative(f, r.record.dt) for f, r in zip(forces, runs, strict=True)]
    yield "pad_spread", spread
    # A, B lie at +y and C, D at -y: yaw makes both pairs differ by the same share of their rate
    yield "yaw of the girder", [*spread, yaw]
    yield "slide_tilt", tilt


def turning(values: Array, length: float) -> Array:
    """Give a force that turns with the direction of motion over a length (Dahl), between -1 and 1, (n,)."""
    force, last = np.zeros(len(values)), 0.0
    steps = np.diff(values)
    fades = np.exp(-np.abs(steps) / length)
    for i, (step, fade) in enumerate(zip(steps.tolist(), fades.tolist(), strict=True)):
        side = 1.0 if step > 0.0 else -1.0
        last = side - (side - last) * fade
        force[i + 1] = last
    return force


def _oscillator(base: Array, dt: float, frequency: float, damping: float) -> Array:
    """Give the acceleration of an oscillator relative to its shaken base (n,).

    q'' + 2 z w q' + w^2 q = -a; the displacement is the recursion of the sampled impulse response.
    """
    turn = 2.0 * np.pi * frequency
    free = turn * np.sqrt(1.0 - damping**2)
    fade = np.exp(-damping * turn * dt)
    ahead, behind = [0.0, dt * fade * np.sin(free * dt) / free], [1.0, -2.0 * fade * np.cos(free * dt), fade**2]
    displacement = np.asarray(lfilter(ahead, behind, -base))
    return derivative(derivative(displacement, dt), dt)
