"""What is left: does a plain surface over measured states, made on some motions, predict the residual of another?

Noise cannot be predicted, structure can. A surface that explains the residual of motions that it was not made from,
after the best effects of the catalogue, is the shape of something that the catalogue does not have. Held-out runs take
no part.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from slipwise.arrays import Array
from slipwise.noise.independent_samples import SHORTEST_BLOCK
from slipwise.relations.base_shear import compute_base_shear
from slipwise.relations.run_data import FitRun
from slipwise.relations.table import Block
from slipwise.residual_map.field import ResidualField, take_field
from slipwise.residual_map.ports import girder_states
from slipwise.residual_map.splines import SplineBasis, choose_equal_bins
from slipwise.residual_map.states import WORDS, DrivingState, measured_states, pad_instants, pad_states
from slipwise.rig.frame import frame_push
from slipwise.selection.hypothesis import Hypothesis
from slipwise.short_repr import short_repr

#: Bins of a curve and of each side of a surface.
_BINS_ONE, _BINS_TWO = 24, 10
#: States that are tried in pairs.
_PAIRED = 4
#: The mean of fewer samples in a bin is not shown.
_LEAST = 12
#: Residuals beyond this many times their median size are cut [1]; noise has one in 20 000 there.
_OUTLIER = 6.0
#: Mean squared residual that may be noise all the same, where noise is coloured or gauges hum [noise variance].
_NOISE = 1.5
#: Share of the blocks of time that tell what is usually left [1].
_USUAL = 0.9
#: Structure counts when a surface predicts this share of the held-out residual, and this much of it.
SHARE, LEVEL = 0.10, 0.10
#: Most of a balance's noise is that of one accelerometer: a state made of it would predict itself.
_OWN_NOISE = frozenset({("vertical", "heave"), ("speed_rate", "girder")})


@short_repr
@dataclass(frozen=True)
class ResidualSurface:
    """A missing force as a binned surface.

    Attributes:
        relation: whose residual it is.
        states: one or two names of `WORDS`.
        edges: per state, the edges of the bins.
        mean: mean residual in each bin, in units of `unit`; NaN where too few samples fell.
        band: half width of its 95 % interval; NaN there.
        unit: of the mean.
        explained: share of the residual of left-out motions that it predicts [1].
        level: the same in variances of the noise.
    """

    relation: str
    states: tuple[str, ...]
    edges: tuple[Array, ...]
    mean: Array
    band: Array
    unit: str
    explained: float
    level: float

    @property
    def words(self) -> str:
        """What it depends on, in a sentence."""
        on = " and ".join(WORDS[s] for s in self.states)
        share = f"{100 * self.explained:.0f} %"
        return f"{self.relation}: depends on {on}; predicts {share} of the residual of motions left out"


def leftover(found: Hypothesis) -> ResidualSurface | None:
    """Return the surface that predicts most of what a hypothesis leaves of left-out motions in pads, girder and heave.

    None where none of them is above the noise.
    """
    objective = found.objective
    there = [r for r in ("pads", "girder", "heave") if r in objective.relations]
    over = [r for r in there if found.summary.fitted_level(r) >= 1.0 + LEVEL]
    if not over:
        return None
    every = pad_instants(objective, found.solution.values)
    states = [*measured_states(every), *pad_states(every)]
    surfaces: list[ResidualSurface] = []
    for name in over:
        field = _without_outliers(take_field(objective, found.solution.residuals, name, thinned=1))
        surfaces += _surfaces(field, states if name == "pads" else girder_states(states))
    return max(surfaces, key=lambda s: s.level, default=None)


def above_noise(found: Hypothesis, unexplained: Mapping[str, float]) -> dict[str, float]:
    """Return what a hypothesis leaves above the noise of each balance, over the rms of what the balance is made of [1].

    What small imperfections explain, which are in every laboratory, is not counted.

    The noise is what the residuals of a repeated motion do not have in common, and at least `_NOISE`. The worst tenth
    of the time is left out: a pad that lands leaves much for a moment, a law that is missing leaves it throughout.

    Args:
        found: the hypothesis.
        unexplained: relation -> share of what it leaves that small imperfections do not explain; all where not given.
    """
    out: dict[str, float] = {}
    objective = found.objective
    for relation in (r for r in objective.relations if r not in ("motion", "across", "girder_y")):
        left = unexplained.get(relation, 1.0) * _usual_level(found, relation)
        over = max(left - max(_NOISE, pure_error(found, relation)), 0.0)
        out[relation] = float(np.sqrt(over)) * compute_share_of_floor(found, relation)
    return out


def compute_share_of_floor(found: Hypothesis, relation: str) -> float:
    """Return the noise of a balance over the rms of what the balance is made of [1]."""
    level = float(np.median(np.concatenate([np.ravel(of.sigma) for of in _fitted(found, relation)])))
    return level / max(_size(found, relation), 1e-30)


def _usual_level(found: Hypothesis, relation: str) -> float:
    """Return the mean squared residual of the blocks of time without the worst tenth [noise variance]."""
    blocks: list[tuple[float, int]] = []
    for of in _fitted(found, relation):
        edges = np.arange(0, len(of.time), max(1, round(SHORTEST_BLOCK * found.objective.scales.time / of.dt)))
        squares = np.add.reduceat((of.columns**2).sum(axis=1), edges)
        counts = np.add.reduceat(of.mask.reshape(len(of.time), -1).sum(axis=1), edges)
        blocks += [(float(s), int(c)) for s, c in zip(squares, counts, strict=True) if c]
    blocks.sort(key=lambda b: b[0] / b[1])
    kept = blocks[: max(1, round(_USUAL * len(blocks)))]
    return sum(s for s, _ in kept) / max(sum(c for _, c in kept), 1)


def pure_error(found: Hypothesis, relation: str) -> float:
    """Return the mean square of what the residuals of a motion and its repeat do not share [noise variance]; 0 without.

    Source: Draper, Smith (1998), Applied Regression Analysis, section 2.1 (pure error).
    """
    total, count = 0.0, 0
    for group in found.solution.residuals.by_motion(relation).values():
        for one, other in zip(group[:-1], group[1:], strict=True):
            if one.value.shape != other.value.shape:
                continue
            judged = one.mask & other.mask
            total += 0.5 * float(np.sum((one.value - other.value)[judged] ** 2))
            count += int(np.count_nonzero(judged))
    return total / count if count else 0.0


def structured(surface: ResidualSurface | None) -> bool:
    """Return whether a surface is more than chance."""
    return surface is not None and surface.explained > SHARE and surface.level > LEVEL


def _fitted(found: Hypothesis, relation: str) -> list[Block]:
    """Return what is left of a relation in the fitted runs."""
    return found.solution.residuals.blocks(relation, found.objective.fitted)


def _size(found: Hypothesis, relation: str) -> float:
    """Return rms about its mean of what a balance is made of: friction, load, or acceleration of the girder [SI]."""
    parts = [_made_of(run, relation) for run in found.objective.fitted_runs]
    return float(np.sqrt(np.mean(np.concatenate([((p - p.mean(axis=0)) ** 2).ravel() for p in parts]))))


def _made_of(run: FitRun, relation: str) -> Array:
    if relation == "girder" and not run.forces_measured:
        return compute_base_shear(run) / run.states.specimen.mass
    if relation == "storeys" and not run.loads_measured:
        return frame_push(run.record, run.states.specimen)
    if relation == "girder":
        return run.states.girder_acceleration[:, 0]
    return run.force if relation == "pads" else run.load.sum(axis=1)


def _without_outliers(field: ResidualField) -> ResidualField:
    """Return a field without outliers: a single reversal that came up early must not speak for a whole run."""
    limit = _OUTLIER * float(np.median(np.abs(field.residual)))
    return replace(field, residual=np.clip(field.residual, -limit, limit))


def _surfaces(field: ResidualField, states: Sequence[DrivingState]) -> list[ResidualSurface]:
    """Return the surfaces over every state, over pairs of the best, and over the velocity with every other."""
    tried = [s for s in states if (s.name, field.relation) not in _OWN_NOISE]
    values = {s.label: field.at_samples(s.values) for s in tried}
    ones = sorted(((_surface(field, (s,), values), s) for s in tried), key=lambda one: -one[0].level)
    best: dict[str, DrivingState] = {}
    for _, state in ones:  # of lags of one state the best only
        best.setdefault(state.name, state)
    pairs = list(combinations(list(best.values())[:_PAIRED], 2))
    if "velocity" in best:  # in a pair with it a force may turn with the motion, whatever it explains alone
        pairs += [(best["velocity"], state) for state in tried if state.name != "velocity"]
    return [*(surface for surface, _ in ones), *(_surface(field, pair, values) for pair in pairs)]


def _surface(field: ResidualField, states: Sequence[DrivingState], values: Mapping[str, Array]) -> ResidualSurface:
    count = _BINS_ONE if len(states) == 1 else _BINS_TWO
    over = [values[s.label] for s in states]
    bins = [choose_equal_bins(v, count, split=s.signed) for s, v in zip(states, over, strict=True)]
    splines = SplineBasis(tuple(bins), degree=0)
    curve = field.fit(splines, over)
    shown = curve.count >= _LEAST
    mean, band = (np.where(shown, of, np.nan).reshape(splines.shape) for of in (curve.heights(), 2.0 * curve.errors()))
    predicted = curve.carried_over()
    return ResidualSurface(
        field.relation,
        tuple(s.name for s in states),
        splines.knots,
        mean,
        band,
        {"girder": "m/s^2"}.get(field.relation, "N"),
        predicted / max(float(curve.whole.sum()), 1e-30),
        predicted / max(len(field.residual), 1),
    )
