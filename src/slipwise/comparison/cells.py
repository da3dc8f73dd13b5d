"""Locate: where does error stand above the floor, cell by cell, corrected for the number of cells looked at.

A cell is a part of the samples of one relation: a state of motion, a range of speed, pressure, position, way since the
last reversal, slid path or time, a pad, a direction, a run, a band of frequency. Its error is tested against what noise
at the floor would make of it, with an honest number of samples: neighbours in time, and pads at one instant, are not
independent. Their memory is that of the residual, but no longer than noise can have: a missing force has a long one of
its own, which must not speak for its innocence.

Source: docs/theory.md, section 3.2; Benjamini and Hochberg (1995) for the number of cells.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import chi2, false_discovery_control

from slipwise.arrays import Array, Mask
from slipwise.comparison.motion_states import STATES, MotionStates
from slipwise.noise.independent_samples import sum_correlations
from slipwise.noise.level import AT_FLOOR
from slipwise.relations.run_data import FitRun
from slipwise.relations.table import Block
from slipwise.residual_map.splines import choose_equal_bins

#: Part of the cells named above the floor that may be so by chance (false discovery rate) [1].
_FALSE = 0.01
#: A cell with fewer independent samples than this is not tested.
_FEWEST = 8.0
#: Noise at the floor remembers no more samples than this: those of a logger's filter [1].
_LONGEST = 5.0
#: Edges of the bands over which an error is shared out [Hz].
_BANDS = (0.0, 1.0, 3.0, 10.0, 30.0, 100.0, np.inf)


@dataclass(frozen=True)
class Cell:
    """One part of the samples of one relation.

    Attributes:
        relation: "pads" ...
        kind: what the samples are sorted by: "state", "speed", "pressure", "position", "since reversal", "path",
            "time", "pad", "direction", "run" or "frequency".
        label: of the cell: "reversal", "A", "+x", a run's name; for a range, low and high say it.
        low: lower end of a range [SI]; NaN for a label.
        high: upper end.
        error: rms over the floor [1].
        samples: in the cell.
        effective: independent ones among them [1].
        chance: that error at the floor, as well as that is known, would look like this [1]; 1 where not tested.
        above: whether it stands above the floor, corrected for the number of cells.
        excess: mean squared error above the floor times samples, in squared floors.
    """

    relation: str
    kind: str
    label: str
    low: float
    high: float
    error: float
    samples: int
    effective: float
    chance: float
    above: bool
    excess: float


@dataclass(frozen=True)
class Samples:
    """Judged samples of one relation, one below the other.

    Attributes:
        relation: which.
        squared: (n,) residual squared, in squared floors.
        residual: (n,) in floors.
        values: kind -> (n,) value of each sample, or number of its label.
        labels: kind -> labels, for kinds that are no ranges.
        spread: samples of the residual for one independent one [1].
        noise_spread: the same of noise at the floor [1].
        spectrum: frequency (f,) [Hz] and squared error in floors (f,), the mean over pads.
    """

    relation: str
    squared: Array
    residual: Array
    values: Mapping[str, Array]
    labels: Mapping[str, tuple[str, ...]]
    spread: float
    noise_spread: float
    spectrum: tuple[Array, Array]


def gather(blocks: Sequence[Block], runs: Sequence[FitRun], motions: Sequence[MotionStates], area: float) -> Samples:
    """Collect the judged samples of a relation over all runs.

    Args:
        blocks: residual of the relation, one for each run.
        runs: of the campaign.
        motions: states of each run.
        area: of a pad [m^2].
    """
    relation = blocks[0].relation
    columns: dict[str, list[Array]] = {}
    residuals = []
    before = 0.0
    for number, (block, run, motion) in enumerate(zip(blocks, runs, motions, strict=True)):
        wide = block.columns
        width = wide.shape[1]
        judged = block.mask.reshape(wide.shape)
        single = {
            "state": motion.label,
            "speed": np.abs(run.velocity),
            "position": run.slip,
            "since reversal": motion.since_turn,
            "path": before + motion.path,
            "time": run.time - run.time[0],
            "direction": motion.direction,
        }
        rows = {name: np.broadcast_to(np.asarray(v, dtype=float)[:, None], wide.shape) for name, v in single.items()}
        if relation == "pads":
            # a balance of loads sorted by load would sort its own noise
            rows["pressure"] = np.broadcast_to(run.load / area, wide.shape)
        rows["run"] = np.full(wide.shape, float(number))
        if width > 1:
            rows["pad"] = np.broadcast_to(np.arange(width, dtype=float)[None], wide.shape)
        for name, values in rows.items():
            columns.setdefault(name, []).append(values[judged])
        residuals.append(wide[judged])
        before += float(motion.path[-1])
    residual = np.concatenate(residuals)
    labels = {
        "state": STATES,
        "direction": ("sliding to −x", "at rest", "sliding to +x"),
        "run": tuple(r.name for r in runs),
        "pad": tuple(runs[0].pads),
    }
    values = {name: np.concatenate(rows) for name, rows in columns.items()}
    values["direction"] = values["direction"] + 1.0
    spread, pads = _spread(blocks), blocks[0].columns.shape[1]
    spectrum = _spectrum(blocks)
    return Samples(relation, residual**2, residual, values, labels, spread, min(spread, _LONGEST * pads), spectrum)


def judge_cells(samples: Samples) -> list[Cell]:
    """Sort a relation's samples in every way and test each cell; `above` is left to `correct_for_many_tests`."""
    out = []
    for kind, values in samples.values.items():
        known = np.isfinite(values)
        if kind in samples.labels:
            for number, label in enumerate(samples.labels[kind]):
                out.append(_cell(samples, kind, label, np.nan, np.nan, known & (values == number)))
            continue
        edges = choose_edges(kind, values[known])
        for low, high in zip(edges[:-1], edges[1:], strict=True):
            last = high == edges[-1]
            inside = known & (values >= low) & ((values <= high) if last else (values < high))
            out.append(_cell(samples, kind, "", float(low), float(high), inside))
    out += _bands(samples)
    return [c for c in out if c.samples > 0]


def correct_for_many_tests(cells: Iterable[Cell]) -> tuple[Cell, ...]:
    """Mark the cells above the floor, at a false discovery rate over all of them (Benjamini and Hochberg)."""
    cells = list(cells)
    tested = [i for i, c in enumerate(cells) if c.effective >= _FEWEST]
    rates = false_discovery_control([cells[i].chance for i in tested]) if tested else ()
    above = {i for i, rate in zip(tested, rates, strict=True) if rate <= _FALSE}
    named = [replace(c, above=i in above) for i, c in enumerate(cells)]
    # noise of a logger may have a colour of its own: a band alone accuses nobody
    accused = {c.relation for c in named if c.above and c.kind != "frequency"}
    return tuple(replace(c, above=c.above and c.relation in accused) for c in named)


def _cell(samples: Samples, kind: str, label: str, low: float, high: float, inside: Mask) -> Cell:
    squares = samples.squared[inside]
    count = len(squares)
    effective = count / samples.noise_spread
    return _tested(samples.relation, kind, label, low, high, squares, count, effective)


def _tested(
    relation: str, kind: str, label: str, low: float, high: float, squares: Array, count: int, effective: float
) -> Cell:
    mean = float(squares.mean()) if count else 0.0
    chance = float(chi2.sf(effective * mean / AT_FLOOR**2, effective)) if effective >= _FEWEST else 1.0
    excess = count * max(mean - 1.0, 0.0)
    return Cell(relation, kind, label, low, high, float(np.sqrt(mean)), count, effective, chance, False, excess)


def choose_edges(kind: str, values: Array) -> Array:
    """Return the edges of a kind's ranges: round numbers for the way since a reversal, equal counts for the rest."""
    if len(values) == 0:
        return np.zeros(0)
    if kind == "since reversal":
        largest = float(np.quantile(values, 0.98))
        parts = [0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7]
        rounded = [_round(p * largest) for p in parts]
        return np.unique([*rounded, float(values.max())])
    if kind in ("time", "path", "position"):
        low, high = (values.min(), values.max()) if kind != "position" else np.quantile(values, [0.005, 0.995])
        inner = np.linspace(low, high, 7)
        return np.unique(np.concatenate([[values.min()], inner[1:-1], [values.max()]]))
    return choose_equal_bins(values, 6)


def _round(value: float) -> float:
    """Round to one digit of 1, 1.5, 2, 3, 4, 5, 6, 8."""
    if value <= 0.0:
        return 0.0
    size = 10.0 ** np.floor(np.log10(value))
    return float(size * min((1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0), key=lambda d: abs(d - value / size)))


def _spread(blocks: Sequence[Block]) -> float:
    """Return the number of samples for one independent one: memory of the squared residual, and likeness of pads."""
    centred, likeness = [], []
    for block in blocks:
        wide = block.columns
        judged = block.mask.reshape(wide.shape)
        if not judged.any():
            continue
        # extremes would make every memory look short
        squares = np.minimum(wide**2, np.quantile(wide[judged] ** 2, 0.99))
        centred.append(np.where(judged, squares - squares[judged].mean(), 0.0))
        if wide.shape[1] > 1:
            together = np.corrcoef(centred[-1].T)
            likeness.append(float(np.mean(together[np.triu_indices(wide.shape[1], 1)])))
    pads = blocks[0].columns.shape[1]
    across = 1.0 + (pads - 1) * max(float(np.mean(likeness)), 0.0) if likeness else 1.0
    return sum_correlations(centred) * across


def _spectrum(blocks: Sequence[Block]) -> tuple[Array, Array]:
    """Return the squared error over frequency: 1 where the residual is white noise at the floor."""
    frequencies, powers = [], []
    for block in blocks:
        wide = block.columns
        judged = block.mask.reshape(wide.shape).mean(axis=0)
        use = judged > 0.05
        if not use.any():
            continue
        power = np.abs(np.fft.rfft(wide[:, use], axis=0)) ** 2 / len(wide) / judged[use]
        frequencies.append(np.fft.rfftfreq(len(wide), block.dt))
        powers.append(power.mean(axis=1))
    frequency = np.concatenate(frequencies) if frequencies else np.zeros(0)
    order = np.argsort(frequency, kind="stable")
    power = np.concatenate(powers)[order] if powers else np.zeros(0)
    return frequency[order], power


def _bands(samples: Samples) -> list[Cell]:
    frequency, power = samples.spectrum
    out = []
    for low, high in zip(_BANDS[:-1], _BANDS[1:], strict=True):
        inside = (frequency >= low) & (frequency < high)
        count = int(np.count_nonzero(inside))
        if count == 0:
            continue
        top = min(high, float(frequency[-1]))
        found = _tested(samples.relation, "frequency", "", low, top, power[inside], count, float(count))
        out.append(found)
    return out
