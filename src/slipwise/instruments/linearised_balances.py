"""Balances of a campaign as straight lines: what each constant of the rig, fault and disturbance changes in them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.evidence.statistics import Statistics, scale_columns
from slipwise.instruments.balances_case import Case, Point, mended
from slipwise.instruments.disturbances import Alternative
from slipwise.instruments.fault_columns import (
    BalancesAt,
    FaultColumn,
    columns_of_faults,
    columns_of_physics,
    evaluate,
    in_question,
)
from slipwise.regression.normal_equations import build_equations, invert_regularised
from slipwise.relations.balance_rows import Stack, adding, stack_rows

#: Part of a column's power below which what a fit of the constants leaves of it is rounding [1].
_NOTHING = 1e-6


@dataclass(frozen=True)
class LinearBalances:
    """Balances at a point.

    Attributes:
        point: where.
        relations: names of those that have rows.
        floor: relation -> what noise alone leaves, in the relation's unit.
        faults: columns of faults as they were taken.
        columns: of all candidates; a fault's in units of its least size, a disturbance's in floors.
        statistics: products of what is left without any fault taken out, slopes of the constants, and columns.
        tolerances: place of the mass among the constants -> how far the rated one is from it, and its deviation.
    """

    point: Point
    relations: tuple[str, ...]
    floor: dict[str, float]
    faults: tuple[FaultColumn, ...]
    columns: tuple[FaultColumn, ...]
    statistics: Statistics
    tolerances: dict[int, tuple[float, float]]

    def list_places(self, label: str, form: int) -> list[int]:
        """Return the places of the columns of a candidate at one form."""
        return [i for i, c in enumerate(self.columns) if (c.label, c.form) == (label, form)]


def linearise(
    case: Case, point: Point, physics: Sequence[Alternative],
    before: LinearBalances | None = None, anew: Mapping[str, Sequence[float]] | None = None,
) -> LinearBalances:  # fmt: skip
    """Linearise the balances.

    Args:
        case: what is judged.
        point: where.
        physics: disturbances that compete with faults.
        before: a linearisation nearby, whose columns stay but for those in `anew` and of faults that are taken out.
        anew: labels of faults -> sizes at which their columns are taken [least sizes].
    """
    at = evaluate(case, point)
    faults = columns_of_faults(at, before.faults if before else (), anew or {})
    linear = _linearised(at, faults, physics)
    return _in_floors(linear)


def linearise_base(case: Case, point: Point) -> LinearBalances:
    """Linearise the balances for the constants of the rig alone."""
    return _linearised(evaluate(case, point), [], [])


def _linearised(at: BalancesAt, faults: Sequence[FaultColumn], physics: Sequence[Alternative]) -> LinearBalances:
    case, point, here = at.case, at.point, at.stack
    noisy = mended(adding(case.runs, case.noise, case.runs[0].record.channels), point.sizes)
    beside = stack_rows(noisy, case.relations, case.specimen, point.constants)
    noise = {n: beside.residual[n] - r for n, r in here.residual.items()}
    floor = {n: max(_rms(rows), 1e-12) for n, rows in noise.items()}
    itself = [
        {n: float((beside.base[name][n] - slope)[:, 0] @ noise[n]) for n, slope in slopes.items()}
        for name, slopes in here.base.items()
    ]
    left = {n: r.copy() for n, r in here.residual.items()}
    for suspect, size in point.sizes:
        own = [c for c in faults if c.suspect is not None and c.suspect.key == suspect.key]
        for n, column in own[0].block.items() if own else ():  # it may change nothing that is judged
            left[n] -= column[:, 0] * (size / suspect.least)
    columns = [*faults, *columns_of_physics(in_question(physics, here, left, floor), left)]
    tolerances = {}
    if "mass" in here.base:
        rated = case.specimen.mass
        tolerances[list(here.base).index("mass")] = (rated - point.constants["mass"], case.mass_error * rated)
    statistics = _statistics(columns, left, here, floor, itself)
    return LinearBalances(point, tuple(left), floor, tuple(faults), tuple(columns), statistics, tolerances)


def _statistics(
    columns: Sequence[FaultColumn],
    left: Mapping[str, Array],
    here: Stack,
    floor: Mapping[str, float],
    itself: Sequence[Mapping[str, float]],
) -> Statistics:
    """Return the products, in units of the relations' floors.

    A mass is multiplied with the noise of an accelerometer, which is in the residual too: what the noise in a slope and
    that in the residual make of each other is taken out, or every constant would be too small.
    """
    parts, first = build_equations([*here.base.values(), *(c.block for c in columns)], left)
    count, width, base = len(parts), int(first[-1]), len(here.base)
    products, pulls = np.zeros((count, width, width)), np.zeros((count, width))
    squares, fitted, rows = np.zeros(count), np.zeros(count), np.zeros(count)
    for k, (name, part) in enumerate(parts.items()):
        per = floor[name] ** -2.0
        products[k][np.ix_(part.index, part.index)] = per * part.squares
        pulls[k, part.index] = per * part.along
        pulls[k, :base] -= [per * of.get(name, 0.0) for of in itself]
        pulls[k, base:] += [per * c.noise.get(name, 0.0) for c in columns]
        squares[k] = per * part.power
        fitted[k] = per * float(here.residual[name] @ here.residual[name])
        rows[k] = part.count
    return Statistics(products, pulls, squares, fitted, rows, rows, base, np.ones(base, bool))


def _in_floors(linear: LinearBalances) -> LinearBalances:
    """Bring disturbances to units of which a fit of the constants leaves one floor in the balance that shows it best.

    What such a fit leaves nothing of is no candidate.
    """
    s = linear.statistics
    base = s.base
    whole = s.products.sum(axis=0)
    q = invert_regularised(whole[:base, :base]) @ whole[:base, base:]
    own = np.diagonal(s.products, axis1=1, axis2=2)[:, base:]
    rest = own - 2.0 * np.einsum("kbi,bi->ki", s.products[:, :base, base:], q)
    rest = (rest + np.einsum("bi,kbc,ci->ki", q, s.products[:, :base, :base], q)) / s.rows[:, None]
    best = rest.max(axis=0)
    kept = np.flatnonzero(best > _NOTHING * (own / s.rows[:, None]).max(axis=0))
    gauge = np.array([c.gauge for c in linear.columns])
    s = scale_columns(s, np.where(gauge, 1.0, 1.0 / np.sqrt(np.maximum(best, 1e-300))))
    at = np.concatenate([np.arange(base), base + kept])
    s = replace(s, products=s.products[:, at][:, :, at], pulls=s.pulls[:, at])
    return replace(linear, columns=tuple(linear.columns[i] for i in kept), statistics=s)


def _rms(values: Array) -> float:
    """Return the root of the mean square; a constant that is left counts too."""
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else 0.0
