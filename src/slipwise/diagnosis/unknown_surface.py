"""What is left: does a plain surface over measured states, made on some motions, predict the residual of another?

Noise cannot be predicted, structure can. A surface that explains the residual of motions that it was not made from,
after the best effects of the catalogue, is the shape of something that the catalogue does not have. Held-out runs take
no part.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.noise.independent_samples import SHORTEST_BLOCK
from slipwise.relations.run_data import FitRun
from slipwise.relations.table import Block

Array = NDArray[np.float64]
#: Bins of a curve and of each side of a surface.
_BINS_ONE, _BINS_TWO = 24, 10
#: Fewer samples in a bin say nothing.
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
_OWN_NOISE = frozenset({("vertical", "heave"), ("acceleration", "girder")})
WORDS: dict[str, str] = {
    "velocity": "slip velocity [m/s]",
    "slip": "slip [m]",
    "load": "load [N]",
    "distance": "distance slid in the run [m]",
    "time": "time [s]",
    "acceleration": "slip acceleration [m/s^2]",
    "load_rate": "rate of the load [N/s]",
    "vertical": "vertical acceleration of the girder [m/s^2]",
    "temperature": "temperature of the sliding face [K]",
}


@dataclass(frozen=True)
class ResidualSurface:
    """A missing force as a binned surface.

    Attributes:
        relation: whose residual it is.
        states: one or two names of `WORDS`.
        edges: per state, the edges of the bins.
        mean: mean residual in each bin, in units of `unit`; NaN where too few samples fell.
        band: half width of its 95 % interval.
        unit: of the mean.
        explained: share of the residual of left-out motions that it predicts [1].
        level: the same in variances of the noise.
        relative: rms of what it predicts over the rms, about its mean, of what the balance is made of [1].
    """

    relation: str
    states: tuple[str, ...]
    edges: tuple[Array, ...]
    mean: Array
    band: Array
    unit: str
    explained: float
    level: float
    relative: float

    @property
    def words(self) -> str:
        """What it depends on, in a sentence."""
        on = " and ".join(WORDS[s].split(" [")[0] for s in self.states)
        share = f"{100 * self.explained:.0f} %"
        return f"{self.relation}: depends on {on}; predicts {share} of the residual of motions left out"


def leftover(found: Hypothesis, relations: tuple[str, ...] | None = None) -> ResidualSurface | None:
    """Return the surface that predicts most of what a hypothesis leaves of left-out motions; None where none does.

    Args:
        found: a fitted hypothesis.
        relations: which to look at; pads, girder and heave when not given.
    """
    objective = found.objective
    best: ResidualSurface | None = None
    for name in relations or tuple(r for r in ("pads", "girder", "heave") if r in objective.relations):
        if found.summary.fitted_level(name) < 1.0 + LEVEL:
            continue
        for surface in _surfaces(found, name, _folds(found, name)):
            if best is None or surface.level > best.level:
                best = surface
    return best


def above_noise(found: Hypothesis) -> dict[str, float]:
    """Return what a hypothesis leaves above the noise of each balance, over the rms of what the balance is made of [1].

    The noise is what the residuals of a repeated motion do not have in common, and at least `_NOISE`. The worst tenth
    of the time is left out: a pad that lands leaves much for a moment, a law that is missing leaves it throughout.
    """
    out: dict[str, float] = {}
    objective = found.objective
    for relation in (r for r in objective.relations if r not in ("motion", "across")):
        over = max(_usual_level(found, relation) - max(_NOISE, pure_error(found, relation)), 0.0)
        level = float(np.median(np.concatenate([np.ravel(of.sigma) for of in _fitted(found, relation)])))
        out[relation] = float(np.sqrt(over) * level / max(_size(found, relation), 1e-30))
    return out


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


def _samples(found: Hypothesis, of: Block) -> dict[str, Array]:
    """Return residual, noise and states of one run's samples, each (m,)."""
    part, sigma, kept = of.value, of.noise, of.mask
    states = states_of(found.objective.run(of.run))
    if kept.ndim == 2:
        wide = {k: np.broadcast_to(v if v.ndim == 2 else v[:, None], part.shape)[kept] for k, v in states.items()}
        return {"left": part[kept], "sigma": sigma[kept], **wide}
    flat = {k: (v.mean(axis=1) if v.ndim == 2 else v)[kept] for k, v in states.items()}
    return {"left": part[kept], "sigma": sigma[kept], **flat}


def states_of(run: FitRun) -> Mapping[str, Array]:
    """Return the states over which residuals are looked at, (n,) or (n, p)."""
    smooth = np.gradient(run.velocity, run.dt)
    states: dict[str, Array] = {
        "velocity": run.velocity,
        "slip": run.slip,
        "distance": np.cumsum(np.abs(run.velocity)) * run.dt,
        "time": run.time - run.time[0],
        "acceleration": smooth,
    }
    if np.isfinite(run.load).all() and float(np.std(run.load)) > 1e-6 * float(np.mean(run.load)):
        states["load"] = run.load
        block = np.ones(9) / 9.0
        slow = np.stack([np.convolve(run.load[:, i], block, mode="same") for i in range(run.load.shape[1])], axis=1)
        states["load_rate"] = np.gradient(slow, run.dt, axis=0)
    if run.record.has_all(*(f"pad_{p}_T" for p in run.pads)):
        states["temperature"] = np.stack([run.record[f"pad_{p}_T"] for p in run.pads], axis=1)
    vertical = run.states.girder_acceleration[:, 2]
    if np.isfinite(vertical).all():
        states["vertical"] = vertical
    return states


def _surfaces(found: Hypothesis, relation: str, folds: list[dict[str, Array]]) -> list[ResidualSurface]:
    size = _size(found, relation)
    names = [k for k in folds[0] if k not in ("left", "sigma") and (k, relation) not in _OWN_NOISE]
    ones = [_surface(relation, (n,), folds, size) for n in names]
    ranked = sorted(ones, key=lambda s: -s.level)
    pairs = [c for c in combinations([s.states[0] for s in ranked[:4]], 2)]
    signed = [("velocity", n) for n in names if n != "velocity" and ("velocity", n) not in pairs]
    return [*ones, *(_surface(relation, p, folds, size) for p in [*pairs, *signed])]


def _size(found: Hypothesis, relation: str) -> float:
    """Return rms about its mean of what a balance is made of: friction, load, or acceleration of the girder [SI]."""
    parts = [_made_of(run, relation) for run in found.objective.fitted_runs]
    return float(np.sqrt(np.mean(np.concatenate([((p - p.mean(axis=0)) ** 2).ravel() for p in parts]))))


def _made_of(run: FitRun, relation: str) -> Array:
    if relation == "girder":
        return run.states.girder_acceleration[:, 0]
    return run.force if relation == "pads" else run.load.sum(axis=1)


def _folds(found: Hypothesis, relation: str) -> list[dict[str, Array]]:
    """Return the samples of each motion; those of every other eighth of the time where there is one motion only."""
    by_motion = found.solution.residuals.by_motion(relation).values()
    groups = [_joined([_samples(found, of) for of in group]) for group in by_motion]
    if len(groups) > 1:
        return groups
    time = groups[0]["time"]
    odd = np.floor(8.0 * time / max(float(time.max()), 1e-12)) % 2.0 >= 1.0
    return [{k: v[mask] for k, v in groups[0].items()} for mask in (~odd, odd)]


def _joined(parts: list[dict[str, Array]]) -> dict[str, Array]:
    """Join runs; a single reversal that came up early must not speak for a whole run, so outliers are cut."""
    joined = {k: np.concatenate([p[k] for p in parts]) for k in parts[0]}
    limit = _OUTLIER * float(np.median(np.abs(joined["left"])))
    return {**joined, "left": np.clip(joined["left"], -limit, limit)}


@dataclass(frozen=True)
class _Cells:
    """Mean residuals over one or two states."""

    states: tuple[str, ...]
    edges: tuple[Array, ...]
    count: NDArray[np.int64]
    mean: Array
    spread: Array

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(len(e) - 1 for e in self.edges)

    def predict(self, samples: dict[str, Array]) -> Array:
        # a surface of many cells predicts less noise when each mean is shrunk by its own uncertainty
        shrunk = self.mean * self.mean**2 / np.maximum(self.mean**2 + 3.0 * self.spread**2, 1e-30)
        return np.where(self.count >= _LEAST, shrunk, 0.0)[_place(samples, self.states, self.edges, self.shape)]


def _cells(states: tuple[str, ...], samples: dict[str, Array]) -> _Cells:
    bins = _BINS_ONE if len(states) == 1 else _BINS_TWO
    edges = tuple(_edges(samples[s], bins, signed=s in ("velocity", "slip")) for s in states)
    shape = tuple(len(e) - 1 for e in edges)
    place = _place(samples, states, edges, shape)
    count = np.bincount(place, minlength=int(np.prod(shape)))
    total = np.bincount(place, weights=samples["left"], minlength=len(count))
    squares = np.bincount(place, weights=samples["left"] ** 2, minlength=len(count))
    mean = total / np.maximum(count, 1)
    spread = np.sqrt(np.maximum(squares / np.maximum(count, 1) - mean**2, 0.0) / np.maximum(count, 1))
    return _Cells(states, edges, count, mean, spread)


def _surface(relation: str, states: tuple[str, ...], folds: list[dict[str, Array]], size: float) -> ResidualSurface:
    before = after = 0.0
    for i, held in enumerate(folds):
        left = held["left"] - _cells(states, _joined([f for j, f in enumerate(folds) if j != i])).predict(held)
        before += float(np.sum(held["left"] ** 2))
        after += float(np.sum(left**2))
    whole = _joined(folds)
    cells = _cells(states, whole)
    samples, level = len(whole["left"]), float(np.median(whole["sigma"]))
    predicted = max(before - after, 0.0) / max(samples, 1)
    shown = np.where(cells.count >= _LEAST, cells.mean, np.nan) * level
    return ResidualSurface(
        relation,
        states,
        cells.edges,
        shown.reshape(cells.shape),
        (2.0 * cells.spread * level).reshape(cells.shape),
        {"girder": "m/s^2"}.get(relation, "N"),
        1.0 - after / max(before, 1e-30),
        (before - after) / max(samples, 1),
        float(np.sqrt(predicted) * level / max(size, 1e-30)),
    )


def _edges(values: Array, bins: int, *, signed: bool) -> Array:
    """Return edges with equal counts between them; a signed state also has one at zero."""
    edges = np.quantile(values, np.linspace(0.0, 1.0, bins + 1))
    if signed and edges[0] < 0.0 < edges[-1]:
        edges = np.sort(np.append(edges, 0.0))
    edges = np.unique(edges)
    return edges if len(edges) > 1 else np.array([edges[0] - 1.0, edges[0] + 1.0])


def _place(
    of: dict[str, Array], states: tuple[str, ...], edges: tuple[Array, ...], shape: tuple[int, ...]
) -> NDArray[np.int64]:
    places = [
        np.clip(np.searchsorted(e, of[s], side="right") - 1, 0, len(e) - 2) for s, e in zip(states, edges, strict=True)
    ]
    return np.ravel_multi_index(tuple(places), shape)
