"""The answer of a test of a single slider: what the force would be without each thing that it has."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slipwise_benchmarks.bearing import FINE, TURNS, Bearing, Force
from slipwise_benchmarks.importance import MATERIAL
from slipwise_benchmarks.slider_friction import Drive

Array = NDArray[np.float64]
#: Every n-th sample of a record decides [1].
_EVERY = 4


def slider_key(bearing: Bearing, drives: Sequence[Drive], force_of: Force) -> dict[str, dict[str, Any]]:
    """Give name -> importance in limits of materiality and floors.

    Args:
        bearing: that is tested.
        drives: the tests that decide.
        force_of: what gives the force.
    """
    there = [force_of(bearing, drive) for drive in drives]
    return {name: _entry(bearing, drives, there, force_of, gone) for name, gone in _without(bearing).items()}


def _without(bearing: Bearing) -> dict[str, Bearing]:
    """Give name -> the bearing without it; a spring through the middle is a restrainer without a gap."""
    gone = {
        name: replace(bearing, hidden=tuple(h for h in bearing.hidden if h[0] != name)) for name, _ in bearing.hidden
    }
    if np.isfinite(bearing.radius):
        gone["slide_curvature"] = replace(bearing, radius=np.inf)
    if bearing.wall or bearing.stiffness:
        gone["restrainer"] = replace(bearing, wall=0.0, stiffness=0.0, gap=np.inf)
    if bearing.turning > TURNS:
        gone["presliding"] = replace(bearing, turning=TURNS)
    return gone


def _entry(
    bearing: Bearing, drives: Sequence[Drive], there: Sequence[Array], force_of: Force, gone: Bearing
) -> dict[str, Any]:
    other = [force_of(gone, drive) for drive in drives]
    taken = slice(None, None, FINE * _EVERY)
    moved = [(float(np.sqrt(np.mean((a - b) ** 2))), float(np.std(a))) for a, b in zip(there, other, strict=True)]
    changes = [change / of for change, of in moved if of > 0.0]  # a test that never meets the wall has no force
    work = [[float(np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(d.slip))) for f, d in zip(of, drives, strict=True)]
            for of in (there, other)]  # fmt: skip
    energy = (work[1][-1] - work[0][-1]) / work[0][-1] if abs(work[0][-1]) > 0.0 else 0.0
    if bearing.mu_fast == 0.0:  # a spring gives back all of it
        energy = 0.0
    most = max(float(np.abs(f).max()) for f in there)
    noise = [bearing.noise[0] * (float(np.abs(f).max()) or most) for f in there]
    residual = np.concatenate([(a - b)[taken] / n for a, b, n in zip(there, other, noise, strict=True)])
    columns = np.concatenate([_base(bearing, d)[taken] / n for d, n in zip(drives, noise, strict=True)])
    scale = np.sqrt((columns**2).mean(axis=0))
    columns = columns[:, scale > 0.0] / scale[scale > 0.0]
    left = residual - columns @ np.linalg.lstsq(columns, residual, rcond=None)[0]
    of_limit = max(*changes, abs(energy)) / MATERIAL
    return {
        "of_limit": of_limit,
        "importance": {"energy": energy, "channels": {"pad_A_Fx": max(changes)}},
        "floors": {"raw": float(np.sqrt((residual**2).mean())), "after_fit": float(np.sqrt((left**2).mean()))},
    }


def _base(bearing: Bearing, drive: Drive) -> Array:
    """Give what base numbers can do to the force (n, 4): level, rate, slow friction, and a zero."""
    way, speed = np.sign(drive.velocity), np.abs(drive.velocity)
    fading = np.exp(-bearing.rate * speed)
    on = drive.load * way
    return np.stack([on, on * fading, on * speed * fading, np.ones_like(on)], axis=1)
