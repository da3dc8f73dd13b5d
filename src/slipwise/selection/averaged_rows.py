"""Rows on which candidates compete: residuals averaged over a short time, without the hum of the mains.

Columns of candidates are made of measured channels and hold their noise. Where there is more noise than signal they
would explain nothing but that noise: an accelerometer's own noise, filtered at 50 Hz, once explained two thirds of a
residual. What no effect of the catalogue can tell from noise, what is faster than `BAND` and what the mains add, is
taken out of residual and columns alike.
"""

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from slipwise.arrays import Array
from slipwise.estimation.objective import Objective
from slipwise.relations.sample_masks import LEAST_SAMPLES
from slipwise.short_repr import short_repr

#: Rows a second at most [Hz]: above it a girder's relations tell of resonances of gauges and cards.
BAND = 70.0
#: Rows of a run of one slider at most: its test may last a millisecond or a year.
_MOST = 5000
#: Frequencies of the mains [Hz].
_MAINS = (50.0, 60.0)
#: A record of fewer periods of them would lose motion with the hum.
_PERIODS = 50


@short_repr
@dataclass(frozen=True)
class _Series:
    """One pad's, or one balance's, samples in one run.

    Attributes:
        rows: (n,) places of its judged samples among the stacked residuals.
        edges: (q,) where each average begins.
        weight: (q,) one over the square root of how many samples are averaged: white noise keeps its deviation.
        hum: (n, 4) orthonormal waves of the mains; empty where sampling is too slow to show them.
    """

    rows: NDArray[np.int64]
    edges: NDArray[np.int64]
    weight: Array
    hum: Array


@short_repr
@dataclass(frozen=True)
class AveragedRows:
    """How stacked residuals of the fitted runs are averaged.

    Attributes:
        series: in the order in which they are stacked.
        relations: names, in the order of their numbers.
        relation: (q,) number of the relation of every averaged row.
        run: (q,) place of its run.
        sigma: (q,) noise of its samples in the relation's unit, as what a residual of one stands for.
        samples: (r,) judged samples of each relation before they were averaged.
    """

    series: tuple[_Series, ...]
    relations: tuple[str, ...]
    relation: NDArray[np.int64]
    run: NDArray[np.int64]
    sigma: Array
    samples: Array

    def average(self, stacked: Array) -> Array:
        """Average stacked residuals or slopes of the fitted runs, (m, ...) -> (q, ...)."""
        out: list[Array] = [np.zeros((0, *stacked.shape[1:]))]
        for each in self.series:
            part = np.asarray(stacked[each.rows], dtype=float)
            if each.hum.size:
                part = part - each.hum @ (each.hum.T @ part)
            sums = np.add.reduceat(part, each.edges, axis=0)
            out.append(sums * each.weight.reshape(-1, *([1] * (part.ndim - 1))))
        return np.concatenate(out)

    def average_sparse(self, relation: str, stacked: csr_array, start: int) -> Array:
        """Average sparse samples of one relation alone as `average` does, (m, k) -> (q, k).

        Args:
            relation: which.
            stacked: its samples.
            start: place of the first of them among those of all relations.
        """
        number, first, samples = self.relations.index(relation), 0, cast("Any", stacked)
        out: list[Array] = [np.zeros((0, samples.shape[1]))]
        for each in self.series:
            here, first = first, first + len(each.edges)
            if self.relation[here] != number:
                continue
            part = samples[each.rows - start]
            # rows that are averaged follow each other: what they hold is summed as one row's
            ends = part.indptr[np.r_[each.edges, len(each.rows)]]
            sums = csr_array((part.data, part.indices, ends), shape=(len(each.edges), part.shape[1])).toarray()
            if each.hum.size:
                sums = sums - np.add.reduceat(each.hum, each.edges, axis=0) @ (part.T @ each.hum).T
            out.append(sums * each.weight[:, None])
        return np.concatenate(out)


def make_averaged_rows(objective: Objective) -> AveragedRows:
    """Return how the stacked residuals of an objective's fitted runs are averaged."""
    relations = objective.relations
    series: list[_Series] = []
    relation: list[NDArray[np.int64]] = []
    run: list[NDArray[np.int64]] = []
    sigma: list[Array] = []
    samples = np.zeros(len(relations))
    for at, block in objective.layout.rows(objective.fitted):
        width = block.columns.shape[1]
        mask = np.broadcast_to(block.mask.reshape(len(block.time), -1), block.columns.shape)
        noise = block.noise.reshape(len(block.time), -1)
        number = relations.index(block.relation)
        samples[number] += np.count_nonzero(mask)
        each = max(1, round(1.0 / (BAND * block.dt)) if objective.balanced else len(block.time) // _MOST)
        for column in range(width):
            judged = np.flatnonzero(mask[:, column])
            if len(judged) < LEAST_SAMPLES:
                continue
            edges = np.flatnonzero(np.r_[True, np.diff(judged // each) > 0])
            counts = np.diff(np.r_[edges, len(judged)])
            weight = 1.0 / np.sqrt(counts)
            rows = at.start + judged * width + column
            series.append(_Series(rows, edges, weight, _hum(block.dt * judged.astype(float), block.dt)))
            relation.append(np.full(len(edges), number))
            run.append(np.full(len(edges), block.run))
            sigma.append(np.add.reduceat(noise[judged, column], edges) / counts)
    numbers, runs = (np.concatenate([np.zeros(0, np.int64), *parts]) for parts in (relation, run))
    return AveragedRows(tuple(series), relations, numbers, runs, np.concatenate([np.zeros(0), *sigma]), samples)


def _hum(time: Array, dt: float) -> Array:
    """Return waves of the mains (n, 4), orthonormal; (0, 0) where sampling or a record's length does not show them."""
    if dt * 2.0 * max(_MAINS) > 0.95 or float(np.ptp(time)) * min(_MAINS) < _PERIODS:
        return np.zeros((0, 0))
    waves = [wave(2.0 * np.pi * hertz * time) for hertz in _MAINS for wave in (np.sin, np.cos)]
    return np.linalg.qr(np.stack(waves, axis=1))[0]
