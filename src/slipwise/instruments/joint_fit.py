"""Fit the rig's constants, the sizes of suspected faults and physical alternatives jointly to what the relations leave.

A suspect's size is refined by mending the records and taking its signature again (Gauss-Newton), so that large delays
and gains come out right. Relations weigh by what is left in them, not less than their noise: a relation that physics of
an unknown kind disturbs loses its voice.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slipwise.arrays import Array
from slipwise.effects import Effect
from slipwise.instruments.disturbances import Alternative
from slipwise.instruments.suspects import Suspect
from slipwise.regression.least_squares import Move, step_by_gauss_newton
from slipwise.regression.normal_equations import (
    Block,
    Part,
    build_equations,
    get_left_over,
    invert_regularised,
    weigh_equations,
)
from slipwise.relations.balance_rows import (
    PreparedRun,
    Stack,
    adding,
    list_changed_rows,
    list_constants,
    stack_rows,
    with_records,
)
from slipwise.relations.rigid_balances import Relation
from slipwise.rig import Specimen

#: A rated mass is taken to be right within this, a mass that the campaign gives within that [1].
RATED_MASS, KNOWN_MASS = 0.01, 0.003
#: Rows are three in each period of the band's edge, whatever the sampling rate: of noise in that band 1.5 of them stand
#: for one independent one.
ROWS_FOR_ONE = 1.5
#: Evidence counts this part of each row [1]: 0.3 of an independent one, for misfit remembers longer than noise
#: (assumed).
EVIDENCE = 0.3 / ROWS_FOR_ONE
#: What an explanation pays for each number it may choose freely, in units of the score (half of log n).
PER_NUMBER = 4.0
#: A floor is known well enough that no explanation is paid for going below this part of it [1].
LEAST_FLOOR = 0.7
#: Steps of Gauss-Newton at most; sizes that change by less than this part of what matters have come to rest.
_STEPS, _RESTED = 4, 0.02


@dataclass(frozen=True)
class JointModel:
    """What the relations are explained by.

    Attributes:
        sizes: suspect and its size.
        physics: alternatives that are fitted with free columns.
    """

    sizes: tuple[tuple[Suspect, float], ...] = ()
    physics: tuple[Alternative, ...] = ()


@dataclass(frozen=True)
class Case:
    """All that an audit is made from.

    Attributes:
        runs: as recorded, smoothed.
        relations: that the channels allow.
        specimen: rated.
        noise: a sample of the noise of each run's channels.
        mass_error: how far the mass may be from the specimen's [1].
        passed: highest frequency that reached the records [Hz].
        effects: that may be suspects or physical explanations.
    """

    runs: list[PreparedRun]
    relations: list[Relation]
    specimen: Specimen
    noise: Sequence[Mapping[str, Array]]
    mass_error: float
    passed: float
    effects: tuple[Effect, ...]

    def corrected(self, model: JointModel, *, noisier: bool = False) -> list[PreparedRun]:
        """Return the runs without the faults of a model; with more noise, where noise is to be followed."""
        runs = adding(self.runs, self.noise, self.runs[0].record.channels) if noisier else self.runs
        for suspect, size in reversed(model.sizes):
            runs = with_records(runs, lambda r, s=suspect, z=size: s.correct(r, z))
        return runs

    def stacked(self, runs: Sequence[PreparedRun], constants: Mapping[str, float]) -> Stack:
        """Evaluate the relations."""
        return stack_rows(runs, self.relations, self.specimen, constants)


@dataclass(frozen=True)
class JointFit:
    """A joint fit.

    Attributes:
        model: with fitted sizes.
        constants: of the rig.
        corrected: runs without the faults of the model.
        stack: relations of the corrected runs at these constants, physics not taken off.
        columns: what is fitted: one block for each constant, each size, each alternative.
        left: relation -> (n,) what the model leaves.
        scale: relation -> root of the mean square of what is left, not far below its floor.
        floor: relation -> what noise alone leaves; a gain that is corrected scales its noise too.
        support: relation -> log likelihood.
        errors: standard errors of the sizes.
    """

    model: JointModel
    constants: dict[str, float]
    corrected: list[PreparedRun]
    stack: Stack
    columns: list[Block]
    left: dict[str, Array]
    scale: dict[str, float]
    floor: dict[str, float]
    support: dict[str, float]
    errors: tuple[float, ...]

    @property
    def score(self) -> float:
        """Log likelihood over all relations, less what free numbers cost."""
        numbers = len(self.model.sizes) + sum(a.width for a in self.model.physics)
        return sum(self.support.values()) - PER_NUMBER * numbers


def start(case: Case) -> JointFit:
    """Fit the rig's constants alone."""
    constants = dict.fromkeys(list_constants(case.relations), 0.0)
    constants["mass"] = case.specimen.mass
    return fit(case, JointModel(), constants)


def fit(case: Case, model: JointModel, constants: Mapping[str, float]) -> JointFit:
    """Fit constants, sizes and physics jointly."""
    start = _Point(model, dict(constants), {})
    point, found = step_by_gauss_newton(
        start, lambda here: _linearised(case, here), _moved, most=_STEPS, linearised_end=True
    )  # fmt: skip
    # constants and sizes stay as they were when the records were corrected: what is left must belong to them
    left = {n: r - predicted(found.columns, n, found.solution, found.first) for n, r in found.here.residual.items()}
    scale, floor = found.scale, found.floor
    support = {n: -EVIDENCE * part.count * float(np.log(scale[n] / floor[n])) for n, part in found.parts.items()}
    support["rated mass"] = -0.5 * off_rated(case, point.constants) ** 2
    known = len(found.here.base)
    errors = np.sqrt(np.maximum(np.diag(found.spread)[known : known + len(model.sizes)], 0.0) / EVIDENCE)
    return JointFit(
        point.model, point.constants, found.corrected, found.here, found.columns, left, scale, floor, support,
        tuple(errors.tolist()),
    )  # fmt: skip


@dataclass(frozen=True)
class _Point:
    """Where a fit stands: model, constants, and the scale of what the step before left in each relation."""

    model: JointModel
    constants: dict[str, float]
    scale: Mapping[str, float]


@dataclass(frozen=True)
class _Linear:
    """The normal equations at a point, solved."""

    corrected: list[PreparedRun]
    here: Stack
    floor: dict[str, float]
    columns: list[Block]
    parts: dict[str, Part]
    first: NDArray[np.int64]
    spread: Array
    solution: Array
    scale: dict[str, float]


def _linearised(case: Case, point: _Point) -> _Linear:
    model, constants = point.model, point.constants
    corrected = case.corrected(model)
    here = case.stacked(corrected, constants)
    floor = _floor(case, model, here, constants)
    signatures = [signature(case, suspect, corrected, here, constants) for suspect, _ in model.sizes]
    columns: list[Block] = [*here.base.values(), *signatures, *(a.columns for a in model.physics)]
    parts, first = build_equations(columns, here.residual)
    weight = {n: 1.0 / max(point.scale.get(n, 0.0), floor[n]) for n in floor}
    squares, along = weigh_equations(parts, weight, int(first[-1]))
    for k, (suspect, _) in enumerate(model.sizes, start=len(here.base)):
        itself = noise_with_itself(case, suspect, corrected, here, constants)
        along[k] -= sum(weight[n] ** 2 * power for n, power in itself.items())
    if "mass" in here.base:
        number = list(here.base).index("mass")
        squares[number, number] += 1.0 / (case.mass_error * case.specimen.mass) ** 2 / EVIDENCE
        along[number] += off_rated(case, constants) / (case.mass_error * case.specimen.mass) / EVIDENCE
    spread = invert_regularised(squares)
    solution = spread @ along
    scale = {n: max(LEAST_FLOOR * floor[n], float(np.sqrt(get_left_over(part, solution)))) for n, part in parts.items()}
    return _Linear(corrected, here, floor, columns, parts, first, spread, solution, scale)


def _moved(point: _Point, found: _Linear) -> Move[_Point]:
    """Take the full step: weights change with what is left, so that costs of two steps do not compare."""
    known = len(found.here.base)
    steps = found.solution[known : known + len(point.model.sizes)]
    rested = all(abs(s) < _RESTED * suspect.least for (suspect, _), s in zip(point.model.sizes, steps, strict=True))
    if point.scale and rested:
        return Move(None)
    moved = {name: float(found.solution[i]) for i, name in enumerate(found.here.base)}
    constants = {name: value - moved.get(name, 0.0) for name, value in point.constants.items()}
    sizes = tuple((s, z + float(more)) for (s, z), more in zip(point.model.sizes, steps, strict=True))
    return Move(_Point(JointModel(sizes, point.model.physics), constants, found.scale))


def off_rated(case: Case, constants: Mapping[str, float]) -> float:
    """Say how far the mass is from the rated one, in its standard deviations."""
    if "mass" not in constants:
        return 0.0
    return (constants["mass"] - case.specimen.mass) / (case.mass_error * case.specimen.mass)


def predicted(columns: Sequence[Block], name: str, solution: Array, first: NDArray[np.int64]) -> Array | float:
    """Return what a solution predicts for the rows of one relation."""
    total: Array | float = 0.0
    for i, block in enumerate(columns):
        if name in block:
            total = total + block[name] @ solution[first[i] : first[i + 1]]
    return total


def _floor(case: Case, model: JointModel, here: Stack, constants: Mapping[str, float]) -> dict[str, float]:
    """Return what noise alone leaves in each relation, corrected as the records are."""
    noisy = case.stacked(case.corrected(model, noisier=True), constants)
    return {n: max(rms(noisy.residual[n] - r), 1e-12) for n, r in here.residual.items()}


def rms(values: Array) -> float:
    """Return the root of the mean square; a constant that is left counts too."""
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else 0.0


def signature(
    case: Case, suspect: Suspect, runs: Sequence[PreparedRun], here: Stack, constants: Mapping[str, float]
) -> dict[str, Array]:
    """Return the change of the residuals for a unit of a suspect's size, relation -> (n, 1)."""
    distorted = with_records(runs, lambda record: suspect.distort(record, suspect.step))
    found = list_changed_rows(distorted, case.relations, case.specimen, constants, here, frozenset(suspect.channels))
    return {name: rows[:, None] / suspect.step for name, rows in found.items()}


def noise_with_itself(
    case: Case, suspect: Suspect, runs: Sequence[PreparedRun], here: Stack, constants: Mapping[str, float]
) -> dict[str, float]:
    """Return the product of a gain's signature with the residual that comes from the channel's own noise alone.

    The signature of a gain is the channel with its noise, so a gain would "explain" noise by shrinking it. What a
    delay or an offset makes of noise has nothing to do with the noise itself.
    """
    if not suspect.fault.scales:
        return {}
    noisy = adding(runs, case.noise, suspect.channels)
    found = list_changed_rows(noisy, case.relations, case.specimen, constants, here, frozenset(suspect.channels))
    return {name: float(rows @ rows) for name, rows in found.items()}
