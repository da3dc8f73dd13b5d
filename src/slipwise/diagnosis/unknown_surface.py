"""What is left: does a plain surface over measured states, made on fitted runs, predict the held-out residual?

Noise cannot be predicted, structure can. A surface that explains held-out residual after the best effects of the
catalogue is the shape of something that the catalogue does not have.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from slipwise.diagnosis.hypothesis import Hypothesis
from slipwise.estimation.run_data import FitRun

Array = NDArray[np.float64]
#: Bins of a curve and of each side of a surface.
_BINS_ONE, _BINS_TWO = 24, 10
#: Fewer samples in a bin say nothing.
_LEAST = 12
#: Residuals beyond this many times their median size are cut [1]; noise has one in 20 000 there.
_OUTLIER = 6.0
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
class Surface:
    """A missing force as a binned surface.

    Attributes:
        relation: whose residual it is.
        states: one or two names of `WORDS`.
        edges: per state, the edges of the bins.
        mean: mean residual in each bin, in units of `unit`; NaN where too few samples fell.
        band: half width of its 95 % interval.
        unit: of the mean.
        explained: share of the held-out residual that it predicts [1].
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
        on = " and ".join(WORDS[s].split(" [")[0] for s in self.states)
        return f"{self.relation}: depends on {on}; predicts {100 * self.explained:.0f} % of the held-out residual"


def leftover(found: Hypothesis, relations: tuple[str, ...] | None = None) -> Surface | None:
    """Give the surface that predicts most of what a hypothesis leaves on held-out runs; None where none does.

    Args:
        found: a fitted hypothesis.
        relations: which to look at; pads, girder and heave when not given.
    """
    problem = found.problem
    if not problem.held_out and not problem.fitted:
        return None
    best: Surface | None = None
    for name in relations or tuple(r for r in ("pads", "girder", "heave") if r in problem.relations):
        if max(found.summary.level(name, held_out=h) for h in (True, False)) < 1.0 + LEVEL:
            continue
        samples = [_samples(found, name, i) for i in range(len(problem.runs))]
        for surface in _surfaces(found, name, samples):
            if best is None or surface.level > best.level:
                best = surface
    return best


def structured(surface: Surface | None) -> bool:
    """Tell whether a surface is more than chance."""
    return surface is not None and surface.explained > SHARE and surface.level > LEVEL


def _samples(found: Hypothesis, relation: str, place: int) -> dict[str, Array]:
    """Give residual, noise and states of one run's samples, each (m,)."""
    run = found.problem.runs[place]
    part = found.solution.residuals.parts[relation][place]
    sigma = np.broadcast_to(found.problem.sigmas[relation][place], part.shape)
    states = states_of(run)
    kept = run.judged[relation]
    if kept.ndim == 2:
        wide = {k: np.broadcast_to(v if v.ndim == 2 else v[:, None], part.shape)[kept] for k, v in states.items()}
        return {"left": part[kept], "sigma": sigma[kept], **wide}
    flat = {k: (v.mean(axis=1) if v.ndim == 2 else v)[kept] for k, v in states.items()}
    return {"left": part[kept], "sigma": sigma[kept], **flat}


def states_of(run: FitRun) -> Mapping[str, Array]:
    """Give the states over which residuals are looked at, (n,) or (n, p)."""
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


def _surfaces(found: Hypothesis, relation: str, samples: list[dict[str, Array]]) -> list[Surface]:
    fitted, held = _train_and_test(found, samples)
    names = [k for k in fitted if k not in ("left", "sigma") and (k, relation) not in _OWN_NOISE]
    ones = [_surface(relation, (n,), fitted, held) for n in names]
    ranked = sorted(ones, key=lambda s: -s.level)
    pairs = [c for c in combinations([s.states[0] for s in ranked[:4]], 2)]
    signed = [("velocity", n) for n in names if n != "velocity" and ("velocity", n) not in pairs]
    return [*ones, *(_surface(relation, p, fitted, held) for p in [*pairs, *signed])]


def _train_and_test(found: Hypothesis, samples: list[dict[str, Array]]) -> tuple[dict[str, Array], dict[str, Array]]:
    """Give the samples that make a surface, and those that it must predict.

    Where no run is held out, the surface is made on every other second and must predict the seconds between.
    """
    fitted = _joined([samples[i] for i in found.problem.fitted])
    if found.problem.held_out:
        return fitted, _joined([samples[i] for i in found.problem.held_out])
    odd = fitted["time"] % 2.0 >= 1.0
    return {k: v[~odd] for k, v in fitted.items()}, {k: v[odd] for k, v in fitted.items()}


def _joined(parts: list[dict[str, Array]]) -> dict[str, Array]:
    """Join runs; a single reversal that came up early must not speak for a whole run, so outliers are cut."""
    joined = {k: np.concatenate([p[k] for p in parts]) for k in parts[0]}
    limit = _OUTLIER * float(np.median(np.abs(joined["left"])))
    return {**joined, "left": np.clip(joined["left"], -limit, limit)}


def _surface(relation: str, states: tuple[str, ...], fitted: dict[str, Array], held: dict[str, Array]) -> Surface:
    bins = _BINS_ONE if len(states) == 1 else _BINS_TWO
    edges = tuple(_edges(fitted[s], bins, signed=s in ("velocity", "slip")) for s in states)
    shape = tuple(len(e) - 1 for e in edges)
    place = _place(fitted, states, edges, shape)
    count = np.bincount(place, minlength=int(np.prod(shape)))
    total = np.bincount(place, weights=fitted["left"], minlength=len(count))
    squares = np.bincount(place, weights=fitted["left"] ** 2, minlength=len(count))
    mean = total / np.maximum(count, 1)
    spread = np.sqrt(np.maximum(squares / np.maximum(count, 1) - mean**2, 0.0) / np.maximum(count, 1))
    # a surface of many cells predicts less noise when each mean is shrunk by its own uncertainty
    shrunk = mean * mean**2 / np.maximum(mean**2 + 3.0 * spread**2, 1e-30)
    prediction = np.where(count >= _LEAST, shrunk, 0.0)[_place(held, states, edges, shape)]
    before, after = float(np.mean(held["left"] ** 2)), float(np.mean((held["left"] - prediction) ** 2))
    level = float(np.median(fitted["sigma"]))
    unit = {"girder": "m/s^2"}.get(relation, "N")
    shown = np.where(count >= _LEAST, mean, np.nan) * level
    explained = 1.0 - after / max(before, 1e-30)
    return Surface(
        relation, states, edges, shown.reshape(shape), (2.0 * spread * level).reshape(shape), unit, explained,
        before - after,
    )  # fmt: skip


def _edges(values: Array, bins: int, *, signed: bool) -> Array:
    """Give edges with equal counts between them; a signed state also has one at zero."""
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
